#include "benchmark/support/result_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "concave_distance/base/error.h"

namespace concave_distance::benchmark {
namespace {

constexpr std::size_t kNarrowest = 9;
constexpr std::size_t kNameWidth = 20;  // of the first column

}  // namespace

ResultTable::ResultTable(const std::string& file, const std::string& columns) {
  std::vector<std::string> names;
  std::istringstream list(columns);
  for (std::string name; std::getline(list, name, ',');) {
    widths_.push_back(static_cast<int>(std::max(name.size(), names.empty() ? kNameWidth : kNarrowest)));
    names.push_back(name);
  }
  if (!file.empty()) {
    csv_.open(file);
    if (!csv_) throw Error(file, "cannot be written", "name a file in a folder that is there");
  }
  write(names);
}

std::string ResultTable::cell(double number) {
  if (!std::isfinite(number)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

void ResultTable::write(const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::printf("%s%*s", i > 0 ? " " : "", i > 0 ? widths_[i] : -widths_[i], cells[i].c_str());
    const bool is_quoted = cells[i].find(',') != std::string::npos;
    if (csv_.is_open()) csv_ << (i > 0 ? "," : "") << (is_quoted ? '"' + cells[i] + '"' : cells[i]);
  }
  std::printf("\n");
  std::fflush(stdout);
  if (csv_.is_open()) csv_ << std::endl;
}

}  // namespace concave_distance::benchmark

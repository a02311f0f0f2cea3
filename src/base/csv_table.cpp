#include "csv_table.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "concave_distance/base/error.h"
#include "number_text.h"
#include "short_text.h"

namespace concave_distance {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

void splitLine(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

double readNumber(std::string_view cell, const std::string& column, const std::string& where) {
  const std::optional<double> value = parseNumber(cell);
  if (!value) {
    throw Error(where, "column " + shortText(column) + " is '" + shortText(std::string(cell)) + "'",
                "write a number with a point, such as -0.25 or 1e-3");
  }
  return *value;
}

void readHeader(std::string_view line, const std::string& header, const std::string& other_header,
                const std::string& where, CsvTable& table) {
  std::vector<std::string_view> names;
  splitLine(line, names);
  table.columns.assign(names.begin(), names.end());
  const std::string seen = joinedText(table.columns, ",");
  if (!header.empty() && seen != header && (other_header.empty() || seen != other_header)) {
    throw Error(where, "the header is '" + shortText(std::string(trimmed(line))) + "'",
                "the first line has to be " + header);
  }
}

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
  return text;
}

}  // namespace

void requireReadableFile(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  const bool opened_by_the_shell = path == "/dev/stdin" || path.rfind("/dev/fd/", 0) == 0;
  if (!fs::exists(status) || fs::is_regular_file(status) || (fs::is_fifo(status) && opened_by_the_shell)) {
    return;
  }
  throw Error(path, "it is not a regular file", "name a file, not a folder, a device or a pipe");
}

CsvTable readCsv(const std::string& path, const std::string& header, const std::string& other_header) {
  requireReadableFile(path);
  std::ifstream stream(path);
  if (!stream) throw Error(path, "the file cannot be read", "check the path and its permissions");
  CsvTable table;
  std::string line;
  std::vector<std::string_view> cells;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const std::string_view text = number == 1 ? withoutByteOrderMark(line) : std::string_view(line);
    if (trimmed(text).empty()) continue;
    const std::string where = path + ":" + std::to_string(number);
    if (table.columns.empty()) {
      readHeader(text, header, other_header, where, table);
      continue;
    }
    splitLine(text, cells);
    if (cells.size() != table.columns.size()) {
      throw Error(
          where, "it has " + std::to_string(cells.size()) + " cells",
          "write " + std::to_string(table.columns.size()) + ": " + shortText(joinedText(table.columns, ",")));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      table.values.push_back(readNumber(cells[i], table.columns[i], where));
    }
    table.lines.push_back(number);
  }
  if (stream.bad()) throw Error(path, "reading stopped before the end", "check the disk");
  if (table.columns.empty()) {
    throw Error(
        path, "the file is empty",
        header.empty() ? "give a line of column names and rows" : "the first line has to be " + header);
  }
  return table;
}

}  // namespace concave_distance

#include "csv_table.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "concave_distance/base/error.h"

namespace concave_distance::demo {
namespace {

std::vector<std::string> splitLine(std::string line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

CsvTable readCsv(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) throw Error(path, "cannot be opened", "check the path");
  CsvTable table;
  std::string line;
  if (std::getline(stream, line)) table.columns = splitLine(line);
  for (std::size_t number = 2; std::getline(stream, line); ++number) {
    const std::vector<std::string> cells = splitLine(line);
    if (cells.empty()) continue;
    const std::string where = path + ":" + std::to_string(number);
    if (cells.size() != table.columns.size()) {
      throw Error(where,
                  std::to_string(cells.size()) + " cells under " + std::to_string(table.columns.size()) +
                      " column names",
                  "give one number for each column");
    }
    std::vector<double> row;
    for (const std::string& cell : cells) {
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      if (end == cell.c_str() || *end != '\0' || !std::isfinite(value)) {
        throw Error(where, "'" + cell + "' is no finite number", "correct the cell");
      }
      row.push_back(value);
    }
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) throw Error(path, "holds no rows of numbers", "give column names and rows");
  return table;
}

std::vector<double> readRisingTimes(const CsvTable& table, const std::string& path) {
  std::vector<double> times;
  for (const std::vector<double>& row : table.rows) {
    if (!times.empty() && !(row.front() > times.back())) {
      throw Error(
          path,
          "time " + std::to_string(row.front()) + " s does not follow " + std::to_string(times.back()) + " s",
          "sort the rows by time");
    }
    times.push_back(row.front());
  }
  return times;
}

}  // namespace concave_distance::demo

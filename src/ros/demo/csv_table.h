#pragma once

#include <string>
#include <vector>

namespace concave_distance::demo {

/// A file of numbers separated by commas under one line of column names.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< each as long as `columns`
};

/// @throws Error naming file and line for a file that cannot be read, a cell that is no finite number, a row
///         that is too short or too long, or a table without rows
CsvTable readCsv(const std::string& path);

/// The first column as seconds. @throws Error naming `path` unless they rise strictly
std::vector<double> readRisingTimes(const CsvTable& table, const std::string& path);

}  // namespace concave_distance::demo

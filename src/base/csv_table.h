#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace concave_distance {

/// A file of numbers separated by commas below one line of column names.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<double> values;      ///< row by row
  std::vector<std::size_t> lines;  ///< of each row, from 1

  std::size_t rowCount() const { return lines.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
};

/// Refuses a device, which may never end, and a pipe, which blocks without a writer. Pipes that the shell has
/// opened (/dev/stdin, /dev/fd/63 of <(...)) are allowed, and so is a file that is missing. @throws Error
void requireReadableFile(const std::string& path);

/// Empty lines are passed over, spaces around a cell and a byte order mark too. Numbers need not be finite.
/// @param header what the first line has to be, e.g. "t,x,y,z"; empty: any names
/// @param other_header what it may be instead; empty: nothing
/// @throws Error naming file and line: not a readable file, another header, a cell that is no number, a row
///         of another length
CsvTable readCsv(const std::string& path, const std::string& header = "",
                 const std::string& other_header = "");

}  // namespace concave_distance

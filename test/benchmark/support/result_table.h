#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace concave_distance::benchmark {

/// A table of results: each row is printed in aligned columns, and written as a line of CSV where a file is
/// named.
class ResultTable {
 public:
  /// @param file to write; empty: none
  /// @param columns their names, a comma between two
  /// @throws Error where the file cannot be written
  ResultTable(const std::string& file, const std::string& columns);

  /// A value for each column: texts, whole numbers, or doubles, of which NaN and infinity leave the cell
  /// empty.
  template <typename... Values>
  void add(const Values&... values) {
    write({cell(values)...});
  }

 private:
  static std::string cell(const std::string& text) { return text; }
  static std::string cell(const char* text) { return text; }
  static std::string cell(double number);
  template <typename Integer>
  static std::string cell(Integer number) {
    return std::to_string(number);
  }
  void write(const std::vector<std::string>& cells);

  std::vector<int> widths_;
  std::ofstream csv_;
};

}  // namespace concave_distance::benchmark

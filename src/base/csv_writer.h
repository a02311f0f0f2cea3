#pragma once

#include <Eigen/Core>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

#include "output_file.h"

namespace concave_distance {

/// Writes the cells of a table of numbers, line by line. Numbers have 17 digits and read back as
/// the same double; NaN is an empty cell: not computed. Texts are written as they are, so they must
/// not contain commas.
class CsvWriter {
 public:
  explicit CsvWriter(std::ostream& stream) : stream_(&stream) {}

  CsvWriter& operator<<(double value);
  CsvWriter& operator<<(std::string_view text);
  CsvWriter& operator<<(const Eigen::Vector3d& vector);
  template <typename Integer, typename = std::enable_if_t<std::is_integral_v<Integer>>>
  CsvWriter& operator<<(Integer value) {
    separate();
    *stream_ << +value;
    return *this;
  }
  void skipCells(int count);  ///< leaves them empty
  void endLine();

 private:
  void separate();

  std::ostream* stream_;
  bool line_begun_ = false;
};

/// A table in a file that is complete or missing.
class CsvFile {
 public:
  /// @param header the column names, such as "t,x,y,z" @throws Error when the file cannot be written
  CsvFile(const std::string& path, const std::string& header);

  CsvWriter& cells() { return cells_; }
  void check() { file_.check(); }        ///< as OutputFile::check
  void complete() { file_.complete(); }  ///< as OutputFile::complete
  void finish() { file_.finish(); }      ///< as OutputFile::finish

 private:
  OutputFile file_;
  CsvWriter cells_;
};

}  // namespace concave_distance

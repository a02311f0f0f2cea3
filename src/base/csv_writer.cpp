#include "csv_writer.h"

#include <array>
#include <cmath>

#include "number_characters.h"

namespace concave_distance {

CsvWriter& CsvWriter::operator<<(double value) {
  separate();
  if (std::isnan(value)) return *this;
  constexpr int kDigits = 17;
  std::array<char, 32> text{};
  const char* end = writeGeneral(text.data(), text.data() + text.size(), value, kDigits);
  stream_->write(text.data(), end - text.data());
  return *this;
}

CsvWriter& CsvWriter::operator<<(std::string_view text) {
  separate();
  *stream_ << text;
  return *this;
}

CsvWriter& CsvWriter::operator<<(const Eigen::Vector3d& vector) {
  return *this << vector.x() << vector.y() << vector.z();
}

void CsvWriter::skipCells(int count) {
  for (int i = 0; i < count; ++i) separate();
}

void CsvWriter::endLine() {
  *stream_ << '\n';
  line_begun_ = false;
}

void CsvWriter::separate() {
  if (line_begun_) *stream_ << ',';
  line_begun_ = true;
}

CsvFile::CsvFile(const std::string& path, const std::string& header) : file_(path), cells_(file_.stream()) {
  file_.stream() << header << '\n';
}

}  // namespace concave_distance

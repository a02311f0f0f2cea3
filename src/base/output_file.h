#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace concave_distance {

/// Writes a file that is complete or missing: to a temporary file beside it, which finish() renames. A link,
/// a device or a pipe is written directly.
class OutputFile {
 public:
  /// @throws Error when it cannot be written
  explicit OutputFile(const std::string& path);
  /// Without finish() nothing of it remains.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Writes in the classic locale, numbers with 17 digits.
  std::ostream& stream() { return stream_; }
  /// @throws Error when something could not be written so far; for long runs
  void check() const;
  /// Writes buffered data; with several files, call it for each before the first finish().
  /// @throws Error when something could not be written
  void complete();
  /// complete(), then renames the temporary file.
  void finish();

 private:
  std::string path_;
  std::string written_;  ///< path_ where it is written directly, or finished
  std::ofstream stream_;
};

/// A path and its name in messages, such as "--output".
struct NamedPath {
  std::string name;
  std::string path;  ///< empty: none
};

/// @throws Error when an output is an input or another output. Devices and pipes may be.
void requireDistinctFiles(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs);

}  // namespace concave_distance

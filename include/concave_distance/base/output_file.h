#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace concave_distance {

/// A file that is complete or not there: what is written goes to a file beside it, which takes its place in
/// finish(). What is no regular file (a device, a pipe, anything below /dev and /proc) is written directly.
class OutputFile {
 public:
  /// @throws Error when it cannot be written
  explicit OutputFile(const std::string& path);
  /// Without finish() nothing of it stays behind.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Text of the classic locale, numbers with 17 digits.
  std::ostream& stream() { return stream_; }
  /// Writes out what is left; with several files, each before the first finish().
  /// @throws Error when something could not be written
  void complete();
  /// complete(), and the file is in its place.
  void finish();

 private:
  std::string path_;       ///< as the user names it
  std::string target_;     ///< behind symbolic links
  std::string temporary_;  ///< empty: written directly, or finished
  std::ofstream stream_;
};

/// A path and what names it, as "--output".
struct NamedPath {
  std::string name;
  std::string path;  ///< empty: none
};

/// @throws Error when an output is an input or another output, be it by a link. Devices and pipes may be.
void requireDistinctFiles(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs);

/// For command-line tools: a reader that goes away ends a write with an error and not the program.
void ignoreClosedPipes();

/// Writes out what is left for standard output. @throws Error when something could not be written
void finishStandardOutput();

}  // namespace concave_distance

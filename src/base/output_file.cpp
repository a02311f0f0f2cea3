#include "output_file.h"

#include <unistd.h>

#include <filesystem>
#include <iomanip>
#include <limits>
#include <locale>

#include "concave_distance/base/error.h"

namespace concave_distance {

namespace fs = std::filesystem;

OutputFile::OutputFile(const std::string& path) : path_(path), written_(path) {
  std::error_code failure;
  const bool is_there = fs::exists(fs::symlink_status(path, failure));
  const bool is_file = fs::is_regular_file(fs::symlink_status(path, failure));
  if (is_file || !is_there) written_ += "." + std::to_string(getpid()) + ".part";
  if (!path.empty() && !(is_there && access(path.c_str(), W_OK) != 0))
    stream_.open(written_, std::ios::binary);
  if (!stream_.is_open())
    throw Error(path, "the file cannot be written", "check that its folder is writable");
  if (is_file) fs::permissions(written_, fs::status(path, failure).permissions(), failure);
  stream_.imbue(std::locale::classic());
  stream_ << std::setprecision(std::numeric_limits<double>::max_digits10);
}

OutputFile::~OutputFile() {
  stream_.close();
  std::error_code failure;
  if (written_ != path_) fs::remove(written_, failure);
}

void OutputFile::complete() {
  if (stream_.is_open()) stream_.close();
  check();
}

void OutputFile::check() const {
  if (!stream_) throw Error(path_, "not everything could be written", "check the space on the device");
}

void OutputFile::finish() {
  complete();
  std::error_code failure;
  if (written_ != path_) fs::rename(written_, path_, failure);
  if (failure) throw Error(path_, failure.message(), "check the permissions of its folder");
  written_ = path_;
}

void requireDistinctFiles(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs) {
  std::vector<NamedPath> others = inputs;
  std::error_code failure;
  const auto canonical = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path), failure);
  };
  for (const NamedPath& output : outputs) {
    const fs::file_status status = fs::status(output.path, failure);
    if (output.path.empty() || (fs::exists(status) && !fs::is_regular_file(status))) continue;
    for (const NamedPath& other : others) {
      if (other.path.empty() || (canonical(output.path) != canonical(other.path) &&
                                 !fs::equivalent(output.path, other.path, failure))) {
        continue;
      }
      throw Error(output.path, output.name + " is the same file as " + other.name,
                  "name another file; nothing was written");
    }
    others.push_back(output);
  }
}

}  // namespace concave_distance

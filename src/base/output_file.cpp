#include "output_file.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <limits>
#include <locale>
#include <system_error>

#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as in the kernel

fs::path behindLinks(fs::path path) {
  std::error_code failure;
  for (int links = 0; links < kMostLinks && fs::is_symlink(path, failure); ++links) {
    const fs::path next = fs::read_symlink(path, failure);
    if (failure) break;
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

// Replacing the file of a shell's redirection such as >> would lose its content.
bool isOpenedElsewhere(const std::string& path) {
  return path.rfind("/dev/", 0) == 0 || path.rfind("/proc/", 0) == 0;
}

bool isDirect(const std::string& path) {
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  return isOpenedElsewhere(path) || (fs::exists(status) && !fs::is_regular_file(status));
}

bool areSameFile(const std::string& left, const std::string& right) {
  std::error_code failure;
  const fs::file_status status = fs::status(left, failure);
  if (fs::exists(status) && !fs::is_regular_file(status)) return false;
  if (fs::equivalent(left, right, failure)) return true;
  const auto canonical = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(behindLinks(path), failure), failure);
  };
  const fs::path canonical_left = canonical(left);
  return !failure && canonical_left == canonical(right) && !failure;
}

[[noreturn]] void throwUnwritable(const std::string& path) {
  throw Error(path, "the file cannot be written", "check that its folder exists and is writable");
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(path) {
  stream_.imbue(std::locale::classic());
  stream_ << std::setprecision(std::numeric_limits<double>::max_digits10);
  if (path.empty()) throw Error("output file", "its name is empty", "name a file");
  if (isDirect(path)) {
    stream_.open(path, std::ios::binary);
    if (!stream_) throwUnwritable(path);
    return;
  }
  const fs::path target = behindLinks(path);
  target_ = target.string();
  std::error_code failure;
  if (fs::exists(target, failure) && access(target_.c_str(), W_OK) != 0) throwUnwritable(path);
  temporary_ =
      (target.parent_path() / ("." + target.filename().string() + "." + std::to_string(getpid()) + ".part"))
          .string();
  stream_.open(temporary_, std::ios::binary);
  if (!stream_) {
    temporary_.clear();
    throwUnwritable(path);
  }
}

OutputFile::~OutputFile() {
  if (stream_.is_open()) stream_.close();
  std::error_code failure;
  if (!temporary_.empty()) fs::remove(temporary_, failure);
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
  if (temporary_.empty()) return;
  std::error_code failure;
  const fs::file_status before = fs::status(target_, failure);
  if (fs::exists(before)) fs::permissions(temporary_, before.permissions(), failure);
  fs::rename(temporary_, target_, failure);
  if (failure) {
    throw Error(path_, "the finished file cannot replace it: " + failure.message(),
                "check the permissions of its folder");
  }
  temporary_.clear();
}

void requireDistinctFiles(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].path.empty()) continue;
    const auto refuse_same = [&](const NamedPath& other) {
      if (other.path.empty() || !areSameFile(outputs[i].path, other.path)) return;
      throw Error(outputs[i].path, outputs[i].name + " is the same file as " + other.name,
                  "name another file; nothing was written");
    };
    for (const NamedPath& input : inputs) refuse_same(input);
    for (std::size_t j = 0; j < i; ++j) refuse_same(outputs[j]);
  }
}

void ignoreClosedPipes() {
  std::signal(SIGPIPE, SIG_IGN);
}

void finishStandardOutput() {
  std::cout.flush();
  if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw Error("standard output", "not everything could be written",
                "check the space on the device, and that its reader still runs");
  }
}

}  // namespace concave_distance

#include "query_poses.h"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "base/coordinate_limit.h"
#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

constexpr std::array<std::string_view, 8> kColumns = {"t", "x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr const char* kHeader = "t,x,y,z,qx,qy,qz,qw";
constexpr double kNormTolerance = 1e-3;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Splits at commas; `count` is how many cells there are, also beyond those that fit.
std::array<std::string_view, kColumns.size()> splitLine(std::string_view line, std::size_t& count) {
  std::array<std::string_view, kColumns.size()> cells;
  count = 0;
  while (true) {
    const std::size_t comma = line.find(',');
    if (count < cells.size()) cells[count] = trimmed(line.substr(0, comma));
    ++count;
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

double parseNumber(std::string_view cell, std::string_view column, const std::string& where) {
  std::string_view digits = cell;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    throw Error(where, "column " + std::string(column) + " is '" + std::string(cell) + "'",
                "write a number with a point, such as -0.25 or 1e-3");
  }
  return value;
}

QueryPose parseLine(std::string_view line, const std::string& where) {
  std::size_t count = 0;
  const auto cells = splitLine(line, count);
  if (count != kColumns.size()) {
    throw Error(where, "it has " + std::to_string(count) + " cells", std::string("write 8: ") + kHeader);
  }
  std::array<double, kColumns.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = parseNumber(cells[i], kColumns[i], where);
  }
  if (!std::isfinite(values[0])) {
    throw Error(where, "column t is '" + std::string(cells[0]) + "'", "give each line a time in seconds");
  }
  return {values[0], {values[1], values[2], values[3]}, {values[4], values[5], values[6], values[7]}};
}

// A device may never end, and opening a pipe without a writer blocks. Pipes that the shell has opened
// (/dev/stdin, /dev/fd/63 of <(...)) are allowed.
void requireReadableFile(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  const bool opened_by_the_shell = path == "/dev/stdin" || path.rfind("/dev/fd/", 0) == 0;
  if (!fs::exists(status) || fs::is_regular_file(status) || (fs::is_fifo(status) && opened_by_the_shell)) {
    return;
  }
  throw Error(path, "it is not a regular file", "name a file, not a folder, a device or a pipe");
}

}  // namespace

std::vector<QueryPose> readQueryPoses(const std::string& path) {
  requireReadableFile(path);
  std::ifstream stream(path);
  if (!stream) throw Error(path, "the file cannot be read", "check the path and the rights on it");
  std::vector<QueryPose> poses;
  std::string line;
  bool header_seen = false;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    std::string_view text = line;
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (number == 1 && text.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
      text.remove_prefix(kByteOrderMark.size());
    }
    if (trimmed(text).empty()) continue;
    const std::string where = path + ":" + std::to_string(number);
    if (header_seen) {
      poses.push_back(parseLine(text, where));
      continue;
    }
    std::size_t count = 0;
    if (splitLine(text, count) != kColumns || count != kColumns.size()) {
      throw Error(where, "the header is '" + std::string(trimmed(text)) + "'",
                  std::string("the first line has to be ") + kHeader);
    }
    header_seen = true;
  }
  if (stream.bad()) throw Error(path, "reading stopped before the end", "check the disk");
  if (!header_seen)
    throw Error(path, "the file is empty", std::string("the first line has to be ") + kHeader);
  return poses;
}

std::optional<Eigen::Isometry3d> poseOf(const QueryPose& query) {
  const double norm = query.quaternion.norm();
  if (!query.position.allFinite() || query.position.cwiseAbs().maxCoeff() > kLargestCoordinate ||
      !(std::abs(norm - 1.0) <= kNormTolerance))
    return std::nullopt;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(Eigen::Vector4d(query.quaternion / norm)).toRotationMatrix();
  pose.translation() = query.position;
  return pose;
}

}  // namespace concave_distance

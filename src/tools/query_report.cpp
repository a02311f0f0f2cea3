#include "query_report.h"

#include <array>
#include <charconv>
#include <cmath>

#include "concave_distance/base/error.h"

namespace concave_distance::tools {
namespace {

std::ofstream opened(const std::string& path) {
  std::ofstream stream(path);
  if (!stream)
    throw Error(path, "the file cannot be written", "check that its folder exists and may be written");
  return stream;
}

void closeChecked(std::ofstream& stream, const std::string& path) {
  stream.close();
  if (!stream) throw Error(path, "not everything could be written", "check the space on the disk");
}

/// A comma and the number; the comma alone for what was not computed. Reads back as the same double.
void writeCell(std::ofstream& stream, double value) {
  stream << ',';
  if (std::isnan(value)) return;
  std::array<char, 32> digits{};
  constexpr int kDigits = 17;
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, kDigits);
  if (error == std::errc()) stream.write(digits.data(), end - digits.data());
}

void writePoint(std::ofstream& stream, const Eigen::Vector3d& point) {
  writeCell(stream, point.x());
  writeCell(stream, point.y());
  writeCell(stream, point.z());
}

const char* kindName(NicheKind kind) {
  switch (kind) {
    case NicheKind::Point:
      return "point";
    case NicheKind::Segment:
      return "segment";
    case NicheKind::Patch:
      return "patch";
  }
  return "";
}

const char* outwardName(Outwardness outward) {
  switch (outward) {
    case Outwardness::Outward:
      return "outward";
    case Outwardness::ThroughMaterial:
      return "through_material";
    case Outwardness::Unknown:
      return "unknown";
  }
  return "";
}

}  // namespace

AnswerWriter::AnswerWriter(const std::string& path) : path_(path), stream_(opened(path)) {
  stream_
      << "index,distance,lower_bound,ax,ay,az,bx,by,bz,niche_count,status,time_us,triangle_a,triangle_b\n";
}

void AnswerWriter::write(std::size_t index, const QueryAnswer& answer) {
  stream_ << index;
  writeCell(stream_, answer.distance);
  writeCell(stream_, answer.lower_bound);
  writePoint(stream_, answer.point_a_in_a);
  writePoint(stream_, answer.point_b_in_a);
  stream_ << ',';
  if (answer.niche_count) stream_ << *answer.niche_count;
  stream_ << ',' << answer.status;
  writeCell(stream_, answer.time_us);
  if (answer.meeting_triangles) {
    stream_ << ',' << answer.meeting_triangles->a.value << ',' << answer.meeting_triangles->b.value << '\n';
  } else {
    stream_ << ",,\n";
  }
}

void AnswerWriter::finish() {
  closeChecked(stream_, path_);
}

NicheWriter::NicheWriter(const std::string& path) : path_(path), stream_(opened(path)) {
  stream_ << "index,niche,distance,ax,ay,az,bx,by,bz,kind,extent,outward,visible,prominence\n";
}

void NicheWriter::write(std::size_t index, std::uint64_t number, const TrackedNiche& niche, bool described) {
  stream_ << index << ',' << number;
  writeCell(stream_, niche.distance);
  writePoint(stream_, niche.point_a_in_a);
  writePoint(stream_, niche.point_b_in_a);
  if (!described) {
    stream_ << ",,,,,\n";
    return;
  }
  stream_ << ',' << kindName(niche.kind);
  writeCell(stream_, niche.extent);
  stream_ << ',' << outwardName(niche.outward) << ',' << (niche.visible ? 1 : 0);
  writeCell(stream_, niche.prominence);
  stream_ << '\n';
}

void NicheWriter::finish() {
  closeChecked(stream_, path_);
}

}  // namespace concave_distance::tools

#include "query_report.h"

#include <array>
#include <charconv>
#include <cmath>
#include <ostream>

namespace concave_distance::tools {
namespace {

/// A comma and the number; the comma alone for what was not computed. Reads back as the same double.
void writeCell(std::ostream& stream, double value) {
  stream << ',';
  if (std::isnan(value)) return;
  std::array<char, 32> digits{};
  constexpr int kDigits = 17;
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, kDigits);
  if (error == std::errc()) stream.write(digits.data(), end - digits.data());
}

void writePoint(std::ostream& stream, const Eigen::Vector3d& point) {
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

AnswerWriter::AnswerWriter(const std::string& path) : file_(path) {
  file_.stream()
      << "index,distance,lower_bound,ax,ay,az,bx,by,bz,niche_count,status,time_us,triangle_a,triangle_b\n";
}

void AnswerWriter::write(std::size_t index, const QueryAnswer& answer) {
  std::ostream& stream = file_.stream();
  stream << index;
  writeCell(stream, answer.distance);
  writeCell(stream, answer.lower_bound);
  writePoint(stream, answer.point_a_in_a);
  writePoint(stream, answer.point_b_in_a);
  stream << ',';
  if (answer.niche_count) stream << *answer.niche_count;
  stream << ',' << answer.status;
  writeCell(stream, answer.time_us);
  if (answer.meeting_triangles) {
    stream << ',' << answer.meeting_triangles->a.value << ',' << answer.meeting_triangles->b.value << '\n';
  } else {
    stream << ",,\n";
  }
}

NicheWriter::NicheWriter(const std::string& path) : file_(path) {
  file_.stream() << "index,niche,distance,ax,ay,az,bx,by,bz,kind,extent,outward,visible,prominence\n";
}

void NicheWriter::write(std::size_t index, std::uint64_t number, const TrackedNiche& niche, bool described) {
  std::ostream& stream = file_.stream();
  stream << index << ',' << number;
  writeCell(stream, niche.distance);
  writePoint(stream, niche.point_a_in_a);
  writePoint(stream, niche.point_b_in_a);
  if (!described) {
    stream << ",,,,,\n";
    return;
  }
  stream << ',' << kindName(niche.kind);
  writeCell(stream, niche.extent);
  stream << ',' << outwardName(niche.outward) << ',' << (niche.visible ? 1 : 0);
  writeCell(stream, niche.prominence);
  stream << '\n';
}

}  // namespace concave_distance::tools

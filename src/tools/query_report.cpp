#include "query_report.h"

namespace concave_distance::tools {
namespace {

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

AnswerWriter::AnswerWriter(const std::string& path)
    : file_(path,
            "index,distance,lower_bound,ax,ay,az,bx,by,bz,niche_count,status,time_us,triangle_a,triangle_b") {
}

void AnswerWriter::write(std::size_t index, const QueryAnswer& answer) {
  CsvWriter& cells = file_.cells();
  cells << index << answer.distance << answer.lower_bound << answer.point_a_in_a << answer.point_b_in_a;
  if (answer.niche_count) {
    cells << *answer.niche_count;
  } else {
    cells.skipCells(1);
  }
  cells << answer.status << answer.time_us;
  if (answer.meeting_triangles) {
    cells << answer.meeting_triangles->a.value << answer.meeting_triangles->b.value;
  } else {
    cells.skipCells(2);
  }
  cells.endLine();
}

NicheWriter::NicheWriter(const std::string& path)
    : file_(path, "index,niche,distance,ax,ay,az,bx,by,bz,kind,extent,outward,visible,prominence,origin") {}

void NicheWriter::write(std::size_t index, std::uint64_t number, const TrackedNiche& niche, bool described) {
  CsvWriter& cells = file_.cells();
  cells << index << number << niche.distance << niche.point_a_in_a << niche.point_b_in_a;
  if (described) {
    cells << kindName(niche.kind) << niche.extent << outwardName(niche.outward) << (niche.visible ? 1 : 0)
          << niche.prominence << toString(niche.origin);
  } else {
    cells.skipCells(6);
  }
  cells.endLine();
}

}  // namespace concave_distance::tools

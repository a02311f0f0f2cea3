#include "query_report.h"

namespace concave_distance::tools {
namespace {

std::string columnsOfMargins(bool with_margins) {
  return with_margins ? ",signed_distance" : "";
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

std::string answerColumns(bool with_margins) {
  return "index,distance,lower_bound,ax,ay,az,bx,by,bz,niche_count,status,time_us,triangle_a,triangle_b" +
         columnsOfMargins(with_margins);
}

std::string nicheColumns(bool with_margins) {
  return "index,niche,distance,ax,ay,az,bx,by,bz,kind,extent,outward,visible,prominence,origin" +
         columnsOfMargins(with_margins);
}

}  // namespace

QueryAnswer answerOf(const PairSolution& solution, bool with_niches) {
  QueryAnswer answer;
  answer.distance = solution.distance;
  answer.lower_bound = solution.lower_bound;
  answer.point_a_in_a = solution.point_a_in_a;
  answer.point_b_in_a = solution.point_b_in_a;
  answer.status = toString(solution.status);
  answer.meeting_triangles = solution.meeting_triangles;
  answer.signed_distance = solution.signed_distance;
  if (with_niches && solution.status != SolveStatus::InvalidPose) answer.niche_count = solution.niches.size();
  return answer;
}

AnswerWriter::AnswerWriter(const std::string& path, bool with_margins)
    : CsvFile(path, answerColumns(with_margins)), with_margins_(with_margins) {}

void AnswerWriter::write(std::size_t index, const QueryAnswer& answer) {
  CsvWriter& line = cells();
  line << index << answer.distance << answer.lower_bound << answer.point_a_in_a << answer.point_b_in_a;
  if (answer.niche_count) {
    line << *answer.niche_count;
  } else {
    line.skipCells(1);
  }
  line << answer.status << answer.time_us;
  if (answer.meeting_triangles) {
    line << answer.meeting_triangles->a.value << answer.meeting_triangles->b.value;
  } else {
    line.skipCells(2);
  }
  if (with_margins_) line << answer.signed_distance;
  line.endLine();
}

NicheWriter::NicheWriter(const std::string& path, bool with_margins)
    : CsvFile(path, nicheColumns(with_margins)), with_margins_(with_margins) {}

void NicheWriter::write(std::size_t index, std::uint64_t number, const TrackedNiche& niche, bool described) {
  CsvWriter& line = cells();
  line << index << number << niche.distance << niche.point_a_in_a << niche.point_b_in_a;
  if (described) {
    line << kindName(niche.kind) << niche.extent << outwardName(niche.outward) << (niche.visible ? 1 : 0)
         << niche.prominence << toString(niche.origin);
  } else {
    line.skipCells(6);
  }
  if (with_margins_) line << niche.signed_distance;
  line.endLine();
}

}  // namespace concave_distance::tools

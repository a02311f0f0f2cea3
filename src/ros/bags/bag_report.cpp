#include "bag_report.h"

#include <array>
#include <cstdio>

#include "concave_distance/base/not_computed.h"
#include "concave_distance/distance/niche_kind.h"
#include "concave_distance/tracking/pair_solution.h"
#include "loading/answer_lines.h"
#include "tools/option_names.h"

namespace concave_distance {
namespace {

std::string_view statusWord(std::uint8_t code) {
  switch (code) {
    case PairStatus::OK:
      return "ok";
    case PairStatus::PENETRATING:
      return "penetrating";
    case PairStatus::INVALID_POSE:
      return "invalid_pose";
    case PairStatus::BUDGET_EXHAUSTED:
      return "budget";
    case PairStatus::BEYOND_CUTOFF:
      return "beyond_cutoff";
    case PairStatus::MISSING_TRANSFORM:
      return "missing_transform";
    case PairStatus::STALE_TRANSFORM:
      return "stale_transform";
    case PairStatus::NOT_FOUND:
      return "not_found";
    case PairStatus::WITHIN_TOLERANCE:
      return "tolerance";
    case PairStatus::MEMORY_EXHAUSTED:
      return "memory";
    default:
      return "";
  }
}

// A double has too few digits for nanoseconds since 1970.
std::string secondsText(ros::Time time) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%u.%09u", time.sec, time.nsec);
  return text.data();
}

// As RFC 4180 has it.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string(2, c) : std::string(1, c);
  return cell + '"';
}

double valueOf(bool has_value, double value) {
  return has_value ? value : kNotComputed;
}

template <typename Vector>
Eigen::Vector3d toEigen(const Vector& vector) {
  return {vector.x, vector.y, vector.z};
}

void writeNumber(CsvWriter& line, bool has_number, std::uint64_t number) {
  if (has_number) {
    line << number;
  } else {
    line.skipCells(1);
  }
}

}  // namespace

BagReport::BagReport(const std::string& path, const std::string& niches_path) : answers_(path, kColumns) {
  if (!niches_path.empty()) niches_ = std::make_unique<CsvFile>(niches_path, kNicheColumns);
}

void BagReport::write(const BagAnswer& answer) {
  const PairDistance& nearest = answer.message.nearest;
  const bool with_niches = niches_ != nullptr && nearest.has_distance != 0;
  CsvWriter& line = answers_.cells();
  line << secondsText(answer.recorded) << secondsText(nearest.header.stamp) << quoted(nearest.pair)
       << quoted(nearest.body_a) << quoted(nearest.body_b) << statusWord(nearest.status.code)
       << valueOf(nearest.has_distance != 0, nearest.distance)
       << valueOf(nearest.has_lower_bound != 0, nearest.lower_bound) << toEigen(nearest.point_a)
       << toEigen(nearest.point_b) << toEigen(nearest.normal)
       << valueOf(nearest.has_closing_speed != 0, nearest.closing_speed)
       << valueOf(nearest.has_signed_distance != 0, nearest.signed_distance);
  writeNumber(line, with_niches, answer.message.niches.size());
  writeNumber(line, nearest.nearest_niche_id != 0, nearest.nearest_niche_id);
  line << (nearest.warning != 0 ? 1 : 0);
  writeNumber(line, nearest.has_meeting_triangles != 0, nearest.triangle_a);
  writeNumber(line, nearest.has_meeting_triangles != 0, nearest.triangle_b);
  line << quoted(tools::inOptions(nearest.status.message));
  line.endLine();
  if (with_niches) writeNiches(answer);
}

void BagReport::writeNiches(const BagAnswer& answer) {
  const PairNiches& message = answer.message;
  const bool is_described = message.nearest.accuracy != PairDistance::ACCURACY_NODES;
  CsvWriter& line = niches_->cells();
  for (const Niche& niche : message.niches) {
    line << secondsText(answer.recorded) << secondsText(message.header.stamp) << quoted(message.nearest.pair)
         << niche.id << niche.distance << toEigen(niche.point_a) << toEigen(niche.point_b)
         << toEigen(niche.normal) << valueOf(niche.has_closing_speed != 0, niche.closing_speed);
    if (is_described) {
      line << kindName(static_cast<NicheKind>(niche.kind)) << niche.extent
           << outwardName(static_cast<Outwardness>(niche.outwardness)) << (niche.visible != 0 ? 1 : 0)
           << valueOf(niche.has_prominence != 0, niche.prominence)
           << toString(static_cast<NicheOrigin>(niche.origin));
    } else {
      line.skipCells(6);
    }
    line << valueOf(niche.has_signed_distance != 0, niche.signed_distance);
    line.endLine();
  }
}

void BagReport::check() {
  answers_.check();
  if (niches_) niches_->check();
}

void BagReport::finish() {
  answers_.complete();
  if (niches_) niches_->complete();
  answers_.finish();
  if (niches_) niches_->finish();
}

}  // namespace concave_distance

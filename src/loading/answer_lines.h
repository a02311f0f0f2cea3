#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "base/csv_writer.h"
#include "concave_distance/base/not_computed.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance {

/// The status of a pose at which boxes prove that the pair is beyond its cutoff.
inline constexpr const char* kBeyondCutoff = "beyond_cutoff";

/// A line of out.csv; NaN and empty optionals are cells left empty: not computed.
struct QueryAnswer {
  double distance = kNotComputed;     ///< metres
  double lower_bound = kNotComputed;  ///< metres
  Eigen::Vector3d point_a_in_a = Eigen::Vector3d::Constant(kNotComputed);
  Eigen::Vector3d point_b_in_a = Eigen::Vector3d::Constant(kNotComputed);
  std::optional<std::size_t> niche_count;
  std::string status;
  std::optional<TrianglePair> meeting_triangles;
  double time_us = kNotComputed;          ///< of the query alone
  double signed_distance = kNotComputed;  ///< metres, less the margins
};

/// The words that files have for what a niche is.
const char* kindName(NicheKind kind);
const char* outwardName(Outwardness outward);

/// @param with_niches their count is given, except for an invalid pose
QueryAnswer answerOf(const PairSolution& solution, bool with_niches);

/// Column names of out.csv. @param with_margins the lines end with the signed distance
std::string answerColumns(bool with_margins);
void writeAnswer(std::size_t index, const QueryAnswer& answer, bool with_margins, CsvWriter& line);

/// Returns the column names of niches.csv.
std::string nicheColumns(bool with_margins);
/// @param number the niche's persistent id or its rank
/// @param described kind, extent, sides and prominence were computed: else their cells stay empty
void writeNiche(std::size_t index, std::uint64_t number, const TrackedNiche& niche, bool described,
                bool with_margins, CsvWriter& line);

}  // namespace concave_distance

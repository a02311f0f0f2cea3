#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "base/csv_writer.h"
#include "concave_distance/base/not_computed.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance::tools {

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

/// @param with_niches their count is given, except for an invalid pose
QueryAnswer answerOf(const PairSolution& solution, bool with_niches);

/// Writes out.csv, 17 digits, a line per query.
class AnswerWriter : public CsvFile {
 public:
  /// @param with_margins the lines end with the signed distance
  /// @throws Error when the file cannot be written
  explicit AnswerWriter(const std::string& path, bool with_margins = false);
  void write(std::size_t index, const QueryAnswer& answer);

 private:
  bool with_margins_;
};

/// Writes niches.csv, 17 digits, a line per niche.
class NicheWriter : public CsvFile {
 public:
  /// The parameters are those of AnswerWriter.
  explicit NicheWriter(const std::string& path, bool with_margins = false);
  /// @param number the niche's persistent id or its rank
  /// @param described kind, extent, sides and prominence were computed: else their cells stay empty
  void write(std::size_t index, std::uint64_t number, const TrackedNiche& niche, bool described);

 private:
  bool with_margins_;
};

}  // namespace concave_distance::tools

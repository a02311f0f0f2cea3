#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "distance/niches/local_minima.h"
#include "support/body_pairs.h"
#include "support/brute_force_minima.h"

namespace concave_distance::test {

using Body = std::shared_ptr<const BodyMesh>;

/// The scenes of these tests have coordinates of a few metres: kernel and oracle differ by less than that.
inline constexpr double kMinimaRounding = 1e-12;

inline LocalMinima minimaOf(const Body& a, const Body& b, const Eigen::Isometry3d& pose,
                            const LocalMinimaRequest& request) {
  return findLocalMinima(*a, *b, pose, request);
}

/// Distances and passes side by side, where equal distances may come in any order.
inline std::vector<std::pair<double, double>> sortedPasses(std::vector<std::pair<double, double>> passes,
                                                           double resolution) {
  std::sort(passes.begin(), passes.end(), [&](const auto& l, const auto& r) {
    return std::abs(l.first - r.first) > resolution ? l.first < r.first : l.second < r.second;
  });
  return passes;
}

/// All minima, dark side included, against brute force: one for one, with the same distance, pass, kind and
/// extent.
inline void expectSameAsBruteForce(const Body& a, const Body& b, const Eigen::Isometry3d& pose, double cutoff,
                                   double least_prominence, double margin = 0.0) {
  LocalMinimaRequest request;
  request.cutoff = cutoff;
  request.rule.least_prominence = least_prominence;
  request.rule.prominence_limit = std::numeric_limits<double>::infinity();
  request.rule.margin = margin;
  request.through_material = true;
  const LocalMinima found = minimaOf(a, b, pose, request);
  const double plateau = 1e-9 * (a->diameter() + b->diameter());
  const auto truth =
      bruteForceMinima(*a, *b, pose, cutoff, least_prominence, 10.0 * kMinimaRounding, plateau, margin);
  EXPECT_EQ(found.cost.met_by_search, 0U);
  ASSERT_EQ(found.niches.size(), truth.size());
  // Measuring passes changes no decision.
  request.rule.prominence_limit = 0.0;
  const LocalMinima decided = minimaOf(a, b, pose, request);
  EXPECT_EQ(decided.cost.met_by_search, 0U);
  ASSERT_EQ(decided.niches.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(decided.niches[i].distance, truth[i].distance, 10.0 * kMinimaRounding);
  }
  std::vector<std::pair<double, double>> found_passes;
  std::vector<std::pair<double, double>> true_passes;
  std::vector<std::pair<double, double>> found_extents;
  std::vector<std::pair<double, double>> true_extents;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto pass = [&](double distance, double prominence) {
      const double padded = distance - margin;
      const double level = padded > 0.0 ? margin + padded * (1.0 + prominence) : cutoff;
      return std::min(level, cutoff);  // beyond it either may say infinite
    };
    found_passes.emplace_back(found.niches[i].distance,
                              pass(found.niches[i].distance, found.niches[i].prominence));
    true_passes.emplace_back(truth[i].distance, pass(truth[i].distance, truth[i].prominence));
    if (truth[i].distance < 10.0 * kMinimaRounding) continue;
    const double reach = std::sqrt(2.0 * truth[i].distance * plateau);
    found_extents.emplace_back(found.niches[i].distance, found.niches[i].extent);
    true_extents.emplace_back(truth[i].distance, truth[i].length > 2.0 * reach ? truth[i].length : 0.0);
    const NicheKind kind = truth[i].length <= 2.0 * reach  ? NicheKind::Point
                           : truth[i].width <= 2.0 * reach ? NicheKind::Segment
                                                           : NicheKind::Patch;
    const bool clear = std::abs(truth[i].length - 2.0 * reach) > reach &&
                       (truth[i].length < reach || std::abs(truth[i].width - 2.0 * reach) > reach);
    const bool alone = (i == 0 || truth[i].distance > truth[i - 1].distance + 1e-9) &&
                       (i + 1 == truth.size() || truth[i + 1].distance > truth[i].distance + 1e-9);
    if (clear && alone) {
      EXPECT_EQ(found.niches[i].kind, kind) << "at " << truth[i].distance;
    }
  }
  found_passes = sortedPasses(found_passes, 10.0 * kMinimaRounding);
  true_passes = sortedPasses(true_passes, 10.0 * kMinimaRounding);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(found_passes[i].first, true_passes[i].first, kMinimaRounding);
    EXPECT_NEAR(found_passes[i].second, true_passes[i].second, 10.0 * kMinimaRounding);
  }
  found_extents = sortedPasses(found_extents, 10.0 * kMinimaRounding);
  true_extents = sortedPasses(true_extents, 10.0 * kMinimaRounding);
  for (std::size_t i = 0; i < true_extents.size(); ++i) {
    EXPECT_NEAR(found_extents[i].second, true_extents[i].second, 1e-3 * a->diameter());
  }
}

}  // namespace concave_distance::test

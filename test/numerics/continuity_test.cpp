// Along a motion the distance, and every niche's while it lives, changes by no more than any point of B has
// moved; what falls by more is a death or a merge, and reported as such.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "concave_distance/tracking/pair_tracker.h"
#include "distance/bound/certificate.h"
#include "support/body_pairs.h"
#include "support/query_bound.h"

namespace concave_distance::continuity_test {
namespace {

struct Track {
  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  Eigen::Vector3d axis;
  Eigen::Vector3d start;
  Eigen::Vector3d displacement;

  Eigen::Isometry3d pose(double t) const {
    Eigen::Isometry3d pose(Eigen::AngleAxisd(1.5 * std::sin(3.0 * t), axis));
    pose.translation() = start + std::sin(2.0 * t) * displacement;
    return pose;
  }
};

Track randomTrack(std::uint32_t number) {
  RandomEngine engine(number);
  Track track;
  const SurfaceMesh a = test::concaveShape(number);
  const SurfaceMesh b = test::concaveShape(number / 2);
  track.a = test::makeBody(a, a.diameter() / 12.0);
  track.b = test::makeBody(b, b.diameter() / 12.0);
  track.axis = test::randomRotation(engine).col(0);
  const double reach = 0.5 * (a.diameter() + b.diameter());
  track.start = test::uniformIn(engine, 0.5, 1.2) * reach * test::randomRotation(engine).col(0);
  track.displacement = 0.6 * reach * test::randomRotation(engine).col(0);
  return track;
}

/// The farthest that a vertex of B, hence a point of B, has come: exact but for rounding.
double displacement(const SurfaceMesh& b, const Eigen::Isometry3d& before, const Eigen::Isometry3d& after) {
  double largest = 0.0;
  for (const Eigen::Vector3d& v : b.vertices()) {
    largest = std::max(largest, (after * v - before * v).norm());
  }
  return largest;
}

double boundOf(const Track& track, const Eigen::Isometry3d& pose, double distance) {
  return 2.0 * test::queryBound(track.a->surface(), track.b->surface(), pose.translation(), distance);
}

constexpr int kSteps = 150;
constexpr std::uint32_t kTracks = 12;

TEST(Continuity, TheProvenDistanceChangesByNoMoreThanBHasMoved) {
  CertificateWorkspace workspace;
  for (std::uint32_t number = 0; number < kTracks; ++number) {
    const Track track = randomTrack(number);
    TrianglePair seed{};
    std::size_t seeds = 0;
    double last = 0.0;
    for (int step = 0; step <= kSteps; ++step) {
      const Eigen::Isometry3d pose = track.pose(0.02 * step);
      const DistanceCertificate found =
          certifyDistance(*track.a, *track.b, pose, &seed, seeds, CertificateRequest(), workspace);
      if (step > 0) {
        const double moved = displacement(track.b->surface(), track.pose(0.02 * (step - 1)), pose);
        EXPECT_LE(std::abs(found.distance - last), moved + boundOf(track, pose, found.distance))
            << "track " << number << " step " << step;
      }
      last = found.distance;
      seed = {found.witness.triangle_a, found.witness.triangle_b};
      seeds = 1;
    }
  }
}

void expectContinuousNiches(const PairSolution& before, const PairSolution& now, double most,
                            std::uint32_t number, int step) {
  std::set<std::uint64_t> born;
  std::set<std::uint64_t> gone;
  for (const NicheEvent& event : now.events)
    (event.kind == NicheEvent::Kind::Birth ? born : gone).insert(event.id);
  for (const TrackedNiche& niche : now.niches) {
    const auto same = std::find_if(before.niches.begin(), before.niches.end(),
                                   [&](const TrackedNiche& other) { return other.id == niche.id; });
    if (same == before.niches.end()) {
      EXPECT_EQ(born.count(niche.id), 1U) << "track " << number << " step " << step;
      continue;
    }
    EXPECT_LE(std::abs(niche.distance - same->distance), most)
        << same->distance << " -> " << niche.distance << ", niche " << niche.id << " of track " << number
        << " at step " << step;
  }
  for (const TrackedNiche& niche : before.niches) {
    const bool lives = std::any_of(now.niches.begin(), now.niches.end(),
                                   [&](const TrackedNiche& other) { return other.id == niche.id; });
    EXPECT_NE(lives, gone.count(niche.id) == 1U) << "track " << number << " step " << step;
  }
}

class ContinuityOfLevel : public testing::TestWithParam<AccuracyLevel> {};

TEST_P(ContinuityOfLevel, NichesFallAndRiseNoFasterThanBMoves) {
  int jumps = 0;
  int steps = 0;
  for (std::uint32_t number = 0; number < kTracks; ++number) {
    const Track track = randomTrack(number);
    TrackerParameters parameters;
    parameters.accuracy = GetParam();
    PairTracker tracker("continuity", track.a, track.b, parameters);
    PairSolution before;
    PairSolution now;
    for (int step = 0; step <= kSteps; ++step) {
      const Eigen::Isometry3d pose = track.pose(0.02 * step);
      tracker.update(pose, 0.02 * step, now);
      if (step > 0) {
        const double moved = displacement(track.b->surface(), track.pose(0.02 * (step - 1)), pose);
        const double most = moved + boundOf(track, pose, now.distance);
        expectContinuousNiches(before, now, most, number, step);
        // A search that misses the nearest niche for a while lets the distance jump; a proof does not.
        ++steps;
        if (before.surface_distance == before.surface_distance ||
            now.surface_distance == now.surface_distance)
          continue;  // swallowed: the distance is 0 by decree
        if (std::abs(now.distance - before.distance) > most) ++jumps;
      }
      std::swap(before, now);
    }
  }
  std::cout << "jumps of the distance: " << jumps << " of " << steps << " steps\n";
  EXPECT_LE(jumps, GetParam() == AccuracyLevel::Certified ? 0 : steps / 100);
}

INSTANTIATE_TEST_SUITE_P(Continuity, ContinuityOfLevel,
                         testing::Values(AccuracyLevel::Refined, AccuracyLevel::Certified),
                         [](const auto& info) { return std::string(toString(info.param)); });

}  // namespace
}  // namespace concave_distance::continuity_test

#include "benchmark/support/interference_trials.h"

#include <array>
#include <cmath>

#include "support/cgal_overlap.h"
#include "support/mesh_variants.h"
#include "support/random_solids.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kRelative = 1e-9;
constexpr double kAbsolute = 1e-12;

double off(double value, double reference, double unit) {
  return std::abs(value - reference) / std::max(kRelative * std::abs(reference), kAbsolute * unit);
}

std::vector<InterferenceRegion> byVolume(const Interference& found) {
  std::vector<InterferenceRegion> regions;
  for (const InterferenceRegion& region : found.regions) {
    if (!region.touching) regions.push_back(region);
  }
  std::sort(regions.begin(), regions.end(),
            [](const InterferenceRegion& l, const InterferenceRegion& r) { return l.volume > r.volume; });
  return regions;
}

void countRegions(std::size_t expected, std::size_t found, std::uint64_t seed, InterferenceErrors& errors) {
  errors.pairs += expected > 0 ? 1U : 0U;
  errors.regions += expected;
  errors.several += expected > 1 ? 1U : 0U;
  if (found == expected) return;
  ++errors.miscounted;
  errors.worst_seed = seed;
}

void note(double error, std::uint64_t seed, double& worst, InterferenceErrors& errors) {
  if (error <= worst) return;
  worst = error;
  if (errors.miscounted == 0) errors.worst_seed = seed;
}

/// An outline of stairs up and down, or of a comb, on a lattice of eighths.
SurfaceMesh latticeSolid(RandomEngine& engine) {
  const auto eighths = [&](std::uint32_t least, std::uint32_t choices) {
    return 0.125 * (least + uniformIndex(engine, choices));
  };
  const double width = eighths(1, 3);
  const double gap = eighths(1, 3);
  const double length = eighths(1, 4);
  const double height = 2.0 * eighths(1, 3);
  const int count = 2 + static_cast<int>(uniformIndex(engine, 3));
  if (uniformIndex(engine, 2) == 0) return test::makeComb(count, width, gap, length, 0.125, height);
  return test::makeStairs(count, width, length, height);
}

Eigen::Matrix3d rightAngles(RandomEngine& engine) {
  std::array<int, 3> axes = {0, 1, 2};
  for (std::uint32_t i = 3; i > 1; --i) std::swap(axes[i - 1], axes[uniformIndex(engine, i)]);
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    rotation(i, axes[static_cast<std::size_t>(i)]) = uniformIndex(engine, 2) == 0 ? 1.0 : -1.0;
  if (rotation.determinant() < 0.0) rotation.row(0) *= -1.0;
  return rotation;
}

}  // namespace

InterferencePair randomInterferencePair(std::uint64_t seed) {
  RandomEngine engine(seed);
  InterferencePair pair{test::randomSolid(engine), test::randomSolid(engine), Eigen::Isometry3d::Identity()};
  pair.a_from_b = test::randomOverlappingPose(pair.a, pair.b, engine);
  return pair;
}

InterferencePair latticeInterferencePair(std::uint64_t seed) {
  RandomEngine engine(seed);
  InterferencePair pair{latticeSolid(engine), latticeSolid(engine), Eigen::Isometry3d::Identity()};
  pair.a_from_b.linear() = rightAngles(engine);
  const Eigen::Vector3d displacement =
      pair.a.boundingBox().center() - pair.a_from_b.linear() * pair.b.boundingBox().center() +
      test::uniformInCube(engine, 0.15 * (pair.a.diameter() + pair.b.diameter()));
  pair.a_from_b.translation() = 0.125 * (8.0 * displacement).array().round().matrix();
  return pair;
}

void compareWithCgal(const InterferencePair& pair, const Interference& found, bool flush, std::uint64_t seed,
                     InterferenceErrors& errors) {
  const test::OverlapTruth truth = test::cgalOverlap(pair.a, test::movedSurface(pair.b, pair.a_from_b));
  if (!truth.known) {
    ++errors.unknown;
    return;
  }
  const std::vector<InterferenceRegion> regions = byVolume(found);
  countRegions(truth.parts.size(), regions.size(), seed, errors);
  const double size = pair.size();
  double area_a = 0.0;
  double area_b = 0.0;
  double volume = 0.0;
  for (const InterferenceRegion& region : regions) {
    area_a += region.surface_area_a;
    area_b += region.surface_area_b;
    volume += region.volume;
  }
  note(off(volume, truth.volume, size * size * size), seed, errors.volume, errors);
  note(off(area_a + area_b, truth.surface, size * size), seed, errors.area, errors);
  if (!flush) {
    note(off(area_a, truth.area_a, size * size), seed, errors.area, errors);
    note(off(area_b, truth.area_b, size * size), seed, errors.area, errors);
  }
  for (std::size_t i = 0; i < truth.parts.size() && regions.size() == truth.parts.size(); ++i)
    note(off(regions[i].volume, truth.parts[i].volume, size * size * size), seed, errors.volume, errors);
}

void compareAnswers(const InterferencePair& pair, const Interference& one, const Interference& other,
                    bool swapped, bool flush, double factor, std::uint64_t seed, InterferenceErrors& errors) {
  const std::vector<InterferenceRegion> expected = byVolume(one);
  const std::vector<InterferenceRegion> regions = byVolume(other);
  countRegions(expected.size(), regions.size(), seed, errors);
  const double size = pair.size();
  const double area = factor * factor;
  double sums[4] = {0.0, 0.0, 0.0, 0.0};
  double volumes[2] = {0.0, 0.0};
  for (const InterferenceRegion& e : expected) {
    volumes[0] += e.volume;
    sums[0] += e.surface_area_a;
    sums[1] += e.surface_area_b;
  }
  for (const InterferenceRegion& r : regions) {
    volumes[1] += area * factor * r.volume;
    sums[2] += area * (swapped ? r.surface_area_b : r.surface_area_a);
    sums[3] += area * (swapped ? r.surface_area_a : r.surface_area_b);
  }
  note(off(volumes[1], volumes[0], size * size * size), seed, errors.volume, errors);
  note(off(sums[2] + sums[3], sums[0] + sums[1], size * size), seed, errors.area, errors);
  if (flush) return;
  note(off(sums[2], sums[0], size * size), seed, errors.area, errors);
  note(off(sums[3], sums[1], size * size), seed, errors.area, errors);
  for (std::size_t i = 0; i < expected.size() && regions.size() == expected.size(); ++i) {
    const InterferenceRegion& e = expected[i];
    const InterferenceRegion& r = regions[i];
    note(off(area * factor * r.volume, e.volume, size * size * size), seed, errors.volume, errors);
    if (e.normal_is_fallback || r.normal_is_fallback) continue;
    note(std::abs(factor * r.depth_along_normal - e.depth_along_normal) / (kRelative * size), seed,
         errors.depth, errors);
  }
}

}  // namespace concave_distance::benchmark

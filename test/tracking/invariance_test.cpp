#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>

#include "base/random_engine.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "support/concave_shapes.h"
#include "support/mesh_variants.h"

namespace concave_distance::invariance_test {
namespace {

// What should not change an answer does not: the distance of a cold `refined` solve of two concave bodies.
// Bound: the kernel's error and the rounding of the transformed input are some ten units in the last place of
// the largest coordinate.
constexpr double kUnits = 64.0 * 0x1.0p-52;

struct Draw {
  RandomEngine engine;
  double real(double least, double most) { return least + (most - least) * uniformUnit(engine); }
  Eigen::Isometry3d pose(double least, double most) {
    const Eigen::Vector3d axis(real(-1.0, 1.0), real(-1.0, 1.0), real(0.1, 1.0));
    Eigen::Isometry3d pose(Eigen::AngleAxisd(real(0.0, 3.1), axis.normalized()));
    const Eigen::Vector3d displacement(real(-1.0, 1.0), real(-1.0, 1.0), real(0.1, 1.0));
    pose.translation() = real(least, most) * displacement.normalized();
    return pose;
  }
};

std::shared_ptr<const BodyMesh> body(const std::string& name, SurfaceMesh surface) {
  BodyMeshOptions options;
  options.max_edge_length = surface.diameter() / 12.0;
  return std::make_shared<BodyMesh>(name, std::move(surface), options);
}

double distanceOf(const std::shared_ptr<const BodyMesh>& a, const std::shared_ptr<const BodyMesh>& b,
                  const Eigen::Isometry3d& a_from_b) {
  return solveOnce("invariance", a, b, TrackerParameters(), a_from_b).distance;
}

struct ConcavePair {
  SurfaceMesh comb = test::makeComb(3);
  SurfaceMesh channel = test::makeComb(2, 0.3, 0.2, 0.6, 0.4);
  std::shared_ptr<const BodyMesh> a = body("comb", comb);
  std::shared_ptr<const BodyMesh> b = body("channel", channel);
  static const ConcavePair& get() {
    static const ConcavePair kPair;
    return kPair;
  }
  double size() const { return a->diameter() + b->diameter(); }
};

RC_GTEST_PROP(Invariance, SwappingTheBodies, (std::uint64_t seed)) {
  const ConcavePair& pair = ConcavePair::get();
  Draw draw{RandomEngine(seed)};
  const Eigen::Isometry3d pose = draw.pose(0.0, 4.0);
  const double there = distanceOf(pair.a, pair.b, pose);
  const double back = distanceOf(pair.b, pair.a, pose.inverse());
  RC_ASSERT(std::abs(there - back) <= kUnits * (pair.size() + pose.translation().norm()));
}

RC_GTEST_PROP(Invariance, ARigidMotionOfBoth, (std::uint64_t seed)) {
  const ConcavePair& pair = ConcavePair::get();
  Draw draw{RandomEngine(seed)};
  const Eigen::Isometry3d pose = draw.pose(0.0, 4.0);
  // Both bodies' own frames are moved: other coordinates for the same thing.
  const Eigen::Isometry3d frame_a = draw.pose(0.0, 10.0);
  const Eigen::Isometry3d frame_b = draw.pose(0.0, 10.0);
  const double plain = distanceOf(pair.a, pair.b, pose);
  const double elsewhere = distanceOf(body("comb", test::movedSurface(pair.comb, frame_a)),
                                      body("channel", test::movedSurface(pair.channel, frame_b)),
                                      frame_a * pose * frame_b.inverse());
  RC_ASSERT(std::abs(plain - elsewhere) <= kUnits * (pair.size() + 30.0));
}

RC_GTEST_PROP(Invariance, RelabelledNodesAndTriangles, (std::uint64_t seed)) {
  const ConcavePair& pair = ConcavePair::get();
  Draw draw{RandomEngine(seed)};
  const Eigen::Isometry3d pose = draw.pose(0.0, 4.0);
  const double plain = distanceOf(pair.a, pair.b, pose);
  const double other = distanceOf(body("comb", test::relabelledSurface(pair.comb, draw.engine)),
                                  body("channel", test::relabelledSurface(pair.channel, draw.engine)), pose);
  RC_ASSERT(std::abs(plain - other) <= kUnits * (pair.size() + pose.translation().norm()));
}

RC_GTEST_PROP(Invariance, Scale, (std::uint64_t seed)) {
  const ConcavePair& pair = ConcavePair::get();
  Draw draw{RandomEngine(seed)};
  const Eigen::Isometry3d pose = draw.pose(0.0, 4.0);
  const double factor = std::pow(10.0, draw.real(-6.0, 6.0));
  Eigen::Isometry3d far = pose;
  far.translation() *= factor;
  const double plain = distanceOf(pair.a, pair.b, pose);
  const double large = distanceOf(body("comb", test::scaledSurface(pair.comb, factor)),
                                  body("channel", test::scaledSurface(pair.channel, factor)), far);
  RC_ASSERT(std::abs(large - factor * plain) <= kUnits * factor * (pair.size() + pose.translation().norm()));
}

}  // namespace
}  // namespace concave_distance::invariance_test

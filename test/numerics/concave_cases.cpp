#include <cmath>

#include "numerics/numeric_cases.h"
#include "support/concave_shapes.h"
#include "support/plain_shapes.h"

namespace concave_distance::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

SurfaceMesh makeCube(double half) {
  return makeCuboid(Vector3d::Constant(-half), Vector3d::Constant(half));
}

/// A solid cube of half side `outer` with a hollow of half side `inner`.
SurfaceMesh makeHollow(double outer, double inner) {
  return makeJoined(makeCube(outer), makeTurned(makeCube(inner)));
}

/// A closed ring about z: `count` square cross-sections of side `thickness` on a circle of `radius`, flat
/// towards x.
SurfaceMesh makeSquareRing(double radius, double thickness, std::uint32_t count) {
  const double half = 0.5 * thickness;
  return makeRingThrough(count, 4, [&](std::uint32_t i, std::uint32_t j) {
    const double angle = 2.0 * M_PI * (i + 0.5) / count;
    const Vector3d outwards(std::cos(angle), std::sin(angle), 0.0);
    const double r = radius + (j == 1 || j == 2 ? half : -half);
    return Vector3d(r * outwards + (j < 2 ? -half : half) * Vector3d::UnitZ());
  });
}

/// A block with a square blind hole of half side `half` from the top (z = 0), 0.5 deep.
SurfaceMesh makeSocket(double half) {
  const double outer = 0.5;
  std::vector<Vector3d> v;
  for (const double r : {outer, half}) {
    for (const double z : {r == outer ? -0.6 : -0.5, 0.0}) {
      v.insert(v.end(), {{-r, -r, z}, {r, -r, z}, {r, r, z}, {-r, r, z}});
    }
  }
  // 0-3 outer bottom, 4-7 outer top, 8-11 floor of the hole, 12-15 its rim.
  std::vector<TriangleNodes> triangles;
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({NodeIndex{a}, NodeIndex{b}, NodeIndex{c}});
    triangles.push_back({NodeIndex{a}, NodeIndex{c}, NodeIndex{d}});
  };
  quad(3, 2, 1, 0);
  quad(8, 9, 10, 11);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t l = (k + 1) % 4;
    quad(k, l, 4 + l, 4 + k);
    quad(8 + l, 8 + k, 12 + k, 12 + l);
    quad(4 + k, 4 + l, 12 + l, 12 + k);
  }
  return SurfaceMesh(std::move(v), std::move(triangles), "socket");
}

SurfaceMesh makePeg(double half) {
  return makeCuboid({-half, -half, 0.0}, {half, half, 0.8});
}

}  // namespace

std::vector<NumericCase> concaveCases() {
  std::vector<NumericCase> cases;
  const auto add = [&](const std::string& name, const SurfaceMesh& a, const SurfaceMesh& b,
                       const GivenPose& pose, Relation relation,
                       std::optional<double> closed_form = std::nullopt) {
    cases.push_back({name, a, b, pose, relation, closed_form});
  };
  const SurfaceMesh hollow = makeHollow(1.0, 0.5);
  const SurfaceMesh grain = makeCube(0.1);
  add("InTheHollow", hollow, grain, at(0.05, 0.1, -0.02), Relation::Apart, 0.3);
  add("InTheHollowTurned", hollow, grain, givenPose(turn(0.8, {1, 2, 3}), {0.1, 0.05, 0.15}),
      Relation::Apart);
  add("AroundTheOther", grain, hollow, givenPose(turn(0.8, {1, 2, 3}), {0.1, 0.05, 0.15}), Relation::Apart);
  add("HollowInHollow", makeHollow(1.0, 0.8), makeHollow(0.5, 0.3),
      givenPose(turn(0.4, {1, 0, 2}), {0.02, 0, 0}), Relation::Apart);
  add("SwallowedByMaterial", makeCube(1.0), grain, at(0.3, 0.2, 0.1), Relation::Swallowed, 0.6);
  add("SwallowedByTheWallOfAHollow", hollow, grain, at(0.75, 0.1, 0.05), Relation::Swallowed, 0.15);
  add("Swallowing", grain, makeCube(1.0), givenPose(turn(0.8, {1, 2, 3}), {0.3, 0.2, 0.1}),
      Relation::Swallowed);
  add("SwallowedConcave", makeCube(1.0), makeComb(3), givenPose(turn(0.8, {1, 2, 3}), {0.3, 0.2, 0.1}),
      Relation::Swallowed);
  add("CrossingSurfaces", makeCube(1.0), makeComb(3), at(0.8, 0.0, 0.0), Relation::Meeting, 0.0);

  const SurfaceMesh ring = makeSquareRing(1.0, 0.2, 24);
  add("LinkedRings", ring, ring, givenPose(turn(M_PI_2, Vector3d::UnitX()), {1.0, 0, 0}), Relation::Apart);
  add("LinkedRingsAskew", ring, ring, givenPose(turn(1.2, {1, 0.2, 0.1}), {0.85, 0.1, 0.05}),
      Relation::Apart);
  add("LinkedRingsNearlyTouching", ring, ring,
      givenPose(turn(M_PI_2, Vector3d::UnitX()), {1.8 * std::cos(M_PI / 24.0) - 1e-7, 0, 0}),
      Relation::Apart);

  // Teeth 0.1 wide in gaps of 0.15: walls in parallel, 0.025 apart on both sides, then off the middle.
  const SurfaceMesh comb = makeComb(6);
  const GivenPose opposite = givenPose(Quaterniond(0, 0, 0, 1), {1.475, 0.5, 0.0});
  for (const double off : {0.0, 0.02, 0.025 - 1e-9}) {
    GivenPose pose = opposite;
    pose.translation.x() += off;
    add("CombInComb" + std::to_string(cases.size()), comb, comb, pose, Relation::Apart);
  }
  add("CombInCombTurned", comb, comb, givenPose(turn(M_PI + 0.01, Vector3d::UnitZ()), {1.47, 0.5, 0.0}),
      Relation::Apart);
  const SurfaceMesh socket = makeSocket(0.2);
  const SurfaceMesh peg = makePeg(0.2 - 1e-4);
  add("PegInHole", socket, peg, at(0, 0, -0.3), Relation::Apart, 1e-4);
  add("PegInHoleOffCentre", socket, peg, at(0.9e-4, -0.5e-4, -0.3), Relation::Apart, 1e-5);
  add("PegInHoleTilted", socket, peg, givenPose(turn(2e-4, {1, 0.3, 0.1}), {0, 0, -0.3}), Relation::Apart);
  add("PegAtTheBottom", socket, peg, at(0, 0, -0.5 + 1e-5), Relation::Apart, 1e-5);
  add("PegBesideTheHole", socket, peg, at(0.05, 0.0, 0.25), Relation::Apart, 0.25);
  return cases;
}

}  // namespace concave_distance::test

#include <cmath>

#include "numerics/numeric_cases.h"
#include "support/concave_shapes.h"
#include "support/mesh_variants.h"
#include "support/plain_shapes.h"

namespace concave_distance::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

SurfaceMesh shifted(const SurfaceMesh& mesh, const Vector3d& shift) {
  return movedSurface(mesh, Eigen::Isometry3d(Eigen::Translation3d(shift)));
}

}  // namespace

std::vector<NumericCase> poseCases() {
  const SurfaceMesh comb = makeComb(3);
  const SurfaceMesh hook = makeHook();
  const SurfaceMesh block = makeCuboid({-0.3, -0.4, -0.25}, {0.3, 0.4, 0.25});
  const Quaterniond askew = turn(1.3, {0.2, 0.9, -0.5});
  const Vector3d place(0.2, 0.9, 0.3);
  std::vector<NumericCase> cases;
  const auto add = [&](const std::string& name, const SurfaceMesh& a, const SurfaceMesh& b,
                       const GivenPose& pose) {
    cases.push_back({name, a, b, pose});
  };

  // 1e7 m from the origin: of A's frame, of both frames, of one of them with the pose to match.
  const Vector3d far(6e6, -7e6, 4e6);
  add("BothMeshesFarFromTheirOrigin", shifted(comb, far), shifted(hook, far),
      givenPose(Quaterniond::Identity(), {0.3, 0.5, 0.1}));
  add("BothMeshesFarAndTurned", shifted(comb, far), shifted(hook, far),
      givenPose(askew, far - askew * far + place));
  add("OnlyAFarFromItsOrigin", shifted(comb, far), hook, givenPose(askew, far + place));
  add("OnlyBFarFromItsOrigin", comb, shifted(hook, far), givenPose(askew, place - askew * far));
  add("FarFaceToFace", shifted(block, far), shifted(block, far),
      givenPose(Quaterniond::Identity(), {0.1, 0.1, 0.5 + 0x1p-20}));
  add("FarApart", comb, hook, givenPose(askew, far));

  for (const double size : {1e-6, 1e-3, 1e3, 1e6}) {
    const std::string name = "Size1e" + std::string(size < 1 ? "Minus" : "") +
                             std::to_string(static_cast<int>(std::abs(std::log10(size)) + 0.5));
    add(name, scaledSurface(comb, size), scaledSurface(hook, size), givenPose(askew, size * place));
    add(name + "FaceToFace", scaledSurface(block, size), scaledSurface(block, size),
        givenPose(Quaterniond::Identity(), size * Vector3d(0.1, 0.1, 0.501)));
  }
  // A grain of 1e-6 m at a body of 1e6 m, from within a grain's size to a body's size away.
  const SurfaceMesh mountain = scaledSurface(block, 1e6);
  const SurfaceMesh grain = scaledSurface(comb, 1e-6);
  for (const double gap : {1e-6, 1.0, 1e6}) {
    const std::string name = "GrainAtAMountain" + std::to_string(cases.size());
    add(name + "OverAFace", mountain, grain, givenPose(askew, {1e5, 2e5, 0.25e6 + gap}));
    add(name + "BesideACorner", mountain, grain, givenPose(askew, {0.3e6 + gap, 0.4e6 + gap, 0.25e6 + gap}));
    add(name + "Swapped", grain, scaledSurface(comb, 1e6), givenPose(askew, {gap, 2.0 * gap, 0.9e6 + gap}));
  }

  for (const double angle : {1e-9, 1e-12, 1e-15, 7.96e-4}) {
    const std::string name = "TurnedBy" + std::to_string(cases.size());
    add(name + "FaceToFace", block, block,
        givenPose(turn(angle, {1, 2, 0.5}), {0.05, 0.1, 0.5 + 2.0 * angle + 1e-3}));
    add(name + "NearlyTouching", block, block,
        givenPose(turn(angle, {1, 2, 0}), {0.05, 0.1, 0.5 + 2.0 * angle}));
    add(name + "Combs", comb, comb, givenPose(turn(angle, {0, 0, 1}), {0.125, 0.15, 0.25}));
  }
  add("TurnedByPi", comb, hook, givenPose(Quaterniond(0, 0, 0, 1), {0.45, 1.25, 0.05}));
  add("TurnedByPiInsideTheComb", comb, comb, givenPose(Quaterniond(0, 0, 0, 1), {0.475, 0.5, 0.0}));
  add("TurnedByNearlyPi", comb, hook, givenPose(turn(M_PI - 1e-9, {0, 0, 1}), {0.45, 1.25, 0.05}));
  add("TurnedByTwoPi", block, block, givenPose(turn(2.0 * M_PI, {1, 1, 1}), {0.05, 0.1, 0.75}));

  // A quaternion is normalised, not refused, within 1e-3 of unit norm.
  for (const double norm : {1.0 - 9e-4, 1.0 + 9e-4, 1.0 + 1e-9}) {
    GivenPose pose = givenPose(askew, place);
    pose.quaternion *= norm;
    add("QuaternionOfNorm" + std::to_string(cases.size()), comb, hook, pose);
  }
  for (NumericCase& numeric_case : cases) numeric_case.coarse_grid = true;
  return cases;
}

}  // namespace concave_distance::test

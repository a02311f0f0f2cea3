// The normal of a region whose loops cancel, over time.
#include <gtest/gtest.h>

#include "concave_distance/mesh/surface/primitives.h"
#include "tracking/effect_scene.h"

namespace concave_distance::fallback_normal_test {
namespace {

using test::at;
using test::body;
using test::EffectScene;

constexpr int kPoses = 200;
constexpr double kTurn = 5e-3;  // from pose to pose, radians

using Body = std::shared_ptr<const BodyMesh>;

/// A peg of 60 mm through a plate of 20 mm: both ways along it are as long, and all ways across. Plate and
/// peg, and peg and plate.
std::vector<std::pair<Body, Body>> pegThroughPlate() {
  const Body plate = body("plate", makeBox({0.2, 0.2, 0.02}));
  const Body peg = body("peg", makeCylinder(0.01, 0.06, 1e-4));
  return {{plate, peg}, {peg, plate}};
}

const Eigen::Vector3d kTurns[] = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(),
                                  Eigen::Vector3d(0.36, 0.48, 0.8)};

/// How often the normal turns over while B turns about `axis`.
template <typename NormalAt>
int flips(const Eigen::Vector3d& axis, const NormalAt& normal_at) {
  int count = 0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (int i = 0; i < kPoses; ++i) {
    const Eigen::Vector3d normal = normal_at(Eigen::Isometry3d(Eigen::AngleAxisd(kTurn * i, axis)));
    if (normal.dot(before) < 0.0) ++count;
    before = normal;
  }
  return count;
}

EffectScene regionsOf(const Body& a, const Body& b) {
  EffectSettings settings;
  settings.interference = true;
  EffectScene scene(a, b, settings);
  TrackerParameters alone;
  alone.niches_wanted = false;
  scene.tracker.setParameters(alone);
  return scene;
}

TEST(FallbackNormal, NeverTurnsOverWhileItIsTracked) {
  for (const auto& [a, b] : pegThroughPlate()) {
    for (const Eigen::Vector3d& axis : kTurns) {
      EffectScene scene = regionsOf(a, b);
      const auto normal_at = [&](const Eigen::Isometry3d& pose) {
        scene.update(pose);
        EXPECT_TRUE(scene.contacts.regions.at(0).overlap.normal_is_fallback);
        return scene.contacts.regions.at(0).overlap.normal_in_a;
      };
      EXPECT_EQ(flips(axis, normal_at), 0) << a->name() << ", " << axis.transpose();
    }
  }
}

// At most where it crosses the plane across the preferred direction.
TEST(FallbackNormal, TurnsOverOnceAtMostWithoutAMemory) {
  InterferenceWorkspace workspace;
  Interference interference;
  for (const auto& [a, b] : pegThroughPlate()) {
    for (const Eigen::Vector3d& axis : kTurns) {
      const auto normal_at = [&, &a = a, &b = b](const Eigen::Isometry3d& pose) {
        findInterference(*a, *b, pose, workspace, interference);
        return interference.regions.at(0).normal_in_a;
      };
      EXPECT_LE(flips(axis, normal_at), 1) << a->name() << ", " << axis.transpose();
    }
  }
}

TEST(FallbackNormal, OfWhatIsPushedThroughFromBelowStaysDownwards) {
  const auto [plate, peg] = pegThroughPlate()[0];
  EffectScene scene = regionsOf(plate, peg);
  for (double height = -0.0395; height < 0.0; height += 1e-3) {
    scene.update(at(0.0, 0.0, height));
    EXPECT_LT(scene.contacts.regions.at(0).overlap.normal_in_a.z(), -0.99) << height;
  }
  EXPECT_TRUE(scene.contacts.regions.at(0).overlap.normal_is_fallback);
}

}  // namespace
}  // namespace concave_distance::fallback_normal_test

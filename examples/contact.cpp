// A ball pressed into a plate: where they overlap, and the force of Hunt and Crossley's model.
#include <concave_distance/mesh/body_mesh.h>
#include <concave_distance/mesh/surface/primitives.h>
#include <concave_distance/tracking/pair_effects.h>
#include <concave_distance/tracking/pair_tracker.h>

#include <cstdio>

int main() {
  using namespace concave_distance;
  const auto plate = std::make_shared<const BodyMesh>("plate", makeBox({1, 1, 0.1}));
  const auto ball = std::make_shared<const BodyMesh>("ball", makeSphere(0.1, 1e-5));

  EffectSettings settings;
  settings.normal_force = NormalForceSettings();  // Hunt and Crossley
  Material rubber;
  rubber.youngs_modulus = 1e7;
  PairTracker tracker("plate/ball", plate, ball, TrackerParameters());
  PairEffects effects(plate, ball, settings, inContact(rubber, rubber));

  PairSolution solution;
  PairContacts contacts;
  for (int step = 0; step < 5; ++step) {
    const double depth = 0.001 * step - 0.002;
    const Eigen::Isometry3d pose(Eigen::Translation3d(0, 0, 0.15 - depth));
    tracker.update(pose, 0.01 * step, solution);
    effects.update(solution, RelativeTwist(), 0.01, contacts);
    std::printf("%s, %.4f m", toString(solution.status).data(), solution.distance);
    for (const ContactRegion& region : contacts.regions) {
      std::printf(", %.1f mm deep, %.1f N", 1e3 * region.overlap.depth, region.normal_force);
    }
    std::printf("\n");
  }
}

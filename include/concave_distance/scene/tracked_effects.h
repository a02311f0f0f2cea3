#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "concave_distance/tracking/pair_effects.h"

namespace concave_distance {

/// The effects of a pair while it is tracked. They exist only while the pair's settings ask for some and
/// somebody wants them.
class TrackedEffects {
 public:
  TrackedEffects(std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
                 const ContactMaterial& material);

  /// Takes effect with the next update(). Settings other than the last ones forget the bristles.
  /// @return true when what was found last does not answer what is asked now
  bool prepare(const EffectSettings& settings, bool wanted);
  /// Does nothing while no effects are wanted.
  /// @param step seconds since the last call, for velocities; 0: the same time once more
  /// @param b_in_a velocity of B relative to A; empty: from this pose, the last one and the step
  void update(const PairSolution& solution, double step, const std::optional<RelativeTwist>& b_in_a,
              WorkLimit& limit);
  /// Empties contacts(): the pair has no answer in this cycle.
  void forgetAnswer();
  /// Forgets regions, bristles and the last pose.
  void reset();

  /// These call PairEffects::keep() and goBack(), and do nothing while no effects are wanted.
  void keep();
  void goBack();

  /// Returns the contacts of the last update(), unless forgotten; nullptr while no effects are wanted.
  const PairContacts* contacts() const { return effects_ ? &contacts_ : nullptr; }
  /// Returns the effects with the surfaces and pressures of contacts(); nullptr while none are wanted.
  const PairEffects* effects() const { return effects_.get(); }
  /// Returns what the stages did since the last call.
  EffectCounts takeCounts();

 private:
  std::shared_ptr<const BodyMesh> mesh_a_;
  std::shared_ptr<const BodyMesh> mesh_b_;
  ContactMaterial material_;
  std::unique_ptr<PairEffects> effects_;
  PairContacts contacts_;
  EffectCounts reported_;  ///< by takeCounts()
  bool has_pose_ = false;
  Eigen::Isometry3d last_a_from_b_ = Eigen::Isometry3d::Identity();
  RelativeTwist b_in_a_;
};

}  // namespace concave_distance

#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/contact/effect_settings.h"
#include "concave_distance/contact/pressure_field.h"
#include "concave_distance/contact/wrench.h"
#include "concave_distance/interference/interference.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance {

/// A region of overlap over time, with the force that acts there. What was not asked for is NaN.
struct ContactRegion {
  /// The id is that of the niche that became it, and of the niche that it becomes again when the bodies part;
  /// 0 where the pair follows no niches.
  std::uint64_t id = 0;
  InterferenceRegion overlap;
  Eigen::Vector3d point_in_a = Eigen::Vector3d::Constant(kNotComputed);    ///< where the force acts
  double depth_rate = kNotComputed;                                        ///< m/s, positive while it deepens
  Eigen::Vector3d sliding_in_a = Eigen::Vector3d::Constant(kNotComputed);  ///< of B against A, m/s
  /// N, >= 0: of all pressures together, along force_direction_in_a.
  double normal_force = kNotComputed;
  Eigen::Vector3d force_direction_in_a = Eigen::Vector3d::Constant(kNotComputed);  ///< unit, on B
  double largest_pressure = kNotComputed;  ///< Pa; NaN for a lumped force
  Eigen::Vector3d friction_on_b_in_a = Eigen::Vector3d::Constant(kNotComputed);  ///< N
  /// About A's origin: of the pressures, of friction, and both.
  Wrench normal_on_b_in_a{Eigen::Vector3d::Constant(kNotComputed), Eigen::Vector3d::Constant(kNotComputed)};
  Wrench rubbing_on_b_in_a{Eigen::Vector3d::Constant(kNotComputed), Eigen::Vector3d::Constant(kNotComputed)};
  Wrench on_b_in_a{Eigen::Vector3d::Constant(kNotComputed), Eigen::Vector3d::Constant(kNotComputed)};
};

/// Holds what the effects of a pair come to at one time.
struct PairContacts {
  bool possible = false;               ///< the certificate allows contact: the regions were looked for
  bool cut = false;                    ///< not found within the time and memory allowed
  std::vector<ContactRegion> regions;  ///< deepest first; capacity is kept
  bool a_inside_b = false;             ///< swallowed without a crossing of the surfaces
  bool b_inside_a = false;
  /// The wrench is that of all regions, about A's origin, on B; A gets the opposite. NaN where no force was
  /// asked for.
  Wrench on_b_in_a{Eigen::Vector3d::Constant(kNotComputed), Eigen::Vector3d::Constant(kNotComputed)};
  ContactLinearisation linearisation;  ///< of on_b_in_a
};

/// The effects that one pair asks for, run after each of its solves. What the settings do not ask for is not
/// in the plan; what they ask for runs when its trigger holds. Not thread-safe; pairs run in parallel. A
/// warm cycle allocates nothing.
class PairEffects {
 public:
  /// @throws Error for settings out of range
  PairEffects(std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
              const EffectSettings& settings, const ContactMaterial& material);
  ~PairEffects();
  PairEffects(PairEffects&&) noexcept;
  PairEffects& operator=(PairEffects&&) noexcept;

  /// Regions and forces at the solution's pose.
  /// @param solution of this pair; its certificate decides whether contact is possible: a lower bound
  ///        above 0 excludes it. Without a certificate (`nodes`, `refined`) the distance found does, which is
  ///        why the scene file refuses effects there.
  /// @param b_in_a velocity of B relative to A; zero where it is not known
  /// @param step seconds since the last call; 0 leaves the bristles as they are, else they follow the
  ///        displacement since then, or `b_in_a` where the bodies did not touch
  /// @param limit when it is reached there are no regions and no forces; known ones are kept for the next
  ///        call; nullptr: none
  void update(const PairSolution& solution, const RelativeTwist& b_in_a, double step, PairContacts& contacts,
              WorkLimit* limit = nullptr);

  /// The surfaces that the regions of the last update() are made of: what `overlap.first_facet` and
  /// `overlap.first_sample` of its regions count in. Good until the next update().
  const Interference& surfaces() const;
  /// Returns how the pressure of the last update()'s region `index` follows from the place, good until the
  /// next one; nullptr where it has none: a lumped force, surfaces that touch or are open, no force.
  const PressureField* pressure(std::size_t index) const;

  /// Forgets regions and bristles.
  void reset();

  /// Keeps the regions and bristles of the last update(), for goBack() to return to. Allocates nothing once
  /// it has been called with as many regions.
  void keep();
  /// Undoes every update() since keep(): the next one goes on from there.
  void goBack();

  /// Another plan from the next cycle on; regions keep their ids, bristles are forgotten.
  /// @throws Error for settings out of range
  void setSettings(const EffectSettings& settings, const ContactMaterial& material);
  const EffectSettings& settings() const;
  const EffectPlan& plan() const;
  const EffectCounts& counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace concave_distance

#pragma once

#include <vector>

#include "concave_distance/contact/effect_settings.h"
#include "concave_distance/interference/interference.h"
#include "concave_distance/tracking/pair_effects.h"
#include "contact/contact_patch.h"
#include "region_identity.h"

namespace concave_distance {

/// Computes the forces at a pair's regions, and how they change with its motion. Keeps buffers only; what
/// lasts is in RegionMemory, by region.
class RegionForces {
 public:
  /// @param turning_arm see TurningContact
  explicit RegionForces(double turning_arm) : turning_arm_(turning_arm) {}
  void setSettings(const EffectSettings& settings, const ContactMaterial& material);

  /// Sets pressures or lumped forces.
  void push(const Interference& interference, const RelativeTwist& b_in_a, std::vector<RegionMemory>& memory,
            PairContacts& contacts);
  /// Returns those of the last push() at the region of this index; nullptr for a lumped force.
  const PressureField* pressure(const InterferenceRegion& region, std::size_t index) const {
    return isPatch(region) ? &patches_[index].field() : nullptr;
  }
  /// Adds the friction of what push() has set. @param loose bristles of regions that split or became one
  void rub(const PatchMotion& motion, const std::vector<UnmatchedBristles>& loose,
           std::vector<RegionMemory>& memory, PairContacts& contacts);
  /// Adds the lumped forces' share of the linearisation and finishes it.
  void linearise(const PatchMotion& motion, const std::vector<RegionMemory>& memory,
                 PairContacts& contacts) const;

 private:
  bool isPatch(const InterferenceRegion& region) const;
  void pushPatch(const PatchSurfaces& surfaces, const RelativeTwist& b_in_a, std::size_t r,
                 PatchMemory& memory, PairContacts& contacts);
  void pushLumped(const RelativeTwist& b_in_a, ContactRegion& region) const;
  Wrench rubLumped(const RelativeTwist& displacement, const ContactRegion& region,
                   BristleState& bristles) const;
  void addTurning(const PatchMotion& motion, TurningBristles& bristles, ContactRegion& region,
                  ContactLinearisation& linearisation) const;

  EffectSettings settings_;
  ContactMaterial material_{};
  double turning_arm_;
  std::vector<ContactPatch> patches_;  ///< by region
};

}  // namespace concave_distance

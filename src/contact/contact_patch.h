#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/refill.h"
#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/contact/effect_settings.h"
#include "concave_distance/contact/pressure_field.h"
#include "concave_distance/contact/wrench.h"
#include "concave_distance/interference/interference.h"
#include "pressure_law.h"

namespace concave_distance {

/// A small part of a patch, with the pressure on it added up.
struct PatchSite {
  std::uint64_t cell;          ///< of space, in A's frame, and the direction of the push
  Eigen::Vector3d point_in_a;  ///< centre of the pressure
  Eigen::Vector3d push_in_a;   ///< unit, on B
  double force;                ///< N, > 0
  double stiffness;            ///< N/m
  double damping;              ///< N s/m
};

/// Bristles of one site.
struct SiteBristles {
  std::uint64_t cell;
  Eigen::Vector3d point_in_a;
  BristleState bristles;
};

/// Bristles that may belong to any region.
struct LooseBristles {
  SiteBristles site;
  double cell_size;  ///< metres, of the cells that it was gathered in
};

/// The surfaces of one region (Interference).
struct PatchSurfaces {
  const OverlapSample* first_sample;
  const OverlapSample* last_sample;
  const Eigen::Vector3d* first_loop;
  const Eigen::Vector3d* last_loop;
  double depth;
  Eigen::Vector3d deepest_in_a;  ///< where the depth is attained, and the way for B on which it decreases
  Eigen::Vector3d exit_in_a;
};

/// What is kept of a patch from cycle to cycle.
struct PatchMemory {
  double cell_size = 0.0;              ///< of the sites, metres; 0: none yet
  std::vector<SiteBristles> bristles;  ///< by cell, ascending
  /// Unit, on B, while the patch pushed one way; zero: it never did.
  Eigen::Vector3d entered_in_a = Eigen::Vector3d::Zero();

  PatchMemory() = default;
  ~PatchMemory() = default;
  PatchMemory(const PatchMemory&) = default;
  PatchMemory(PatchMemory&&) = default;
  PatchMemory& operator=(PatchMemory&&) = default;
  PatchMemory& operator=(const PatchMemory& other) {
    if (this == &other) return *this;
    cell_size = other.cell_size;
    refill(bristles, other.bristles);
    entered_in_a = other.entered_in_a;
    return *this;
  }
  void clear() {
    cell_size = 0.0;
    bristles.clear();
    entered_in_a.setZero();
  }
};

/// Of B against A, about A's origin.
struct PatchMotion {
  const RelativeTwist& b_in_a;
  const RelativeTwist& displacement;  ///< since the last call, metres and radians
  double step;                        ///< seconds since then
};

/// The pressure of one region, sampled.
struct PatchPressure {
  Wrench on_b_in_a;                                       ///< about A's origin
  Eigen::Vector3d centre_in_a = Eigen::Vector3d::Zero();  ///< of pressure
  double force = 0.0;                                     ///< sum of the sizes of the pressures' forces, N
  double largest_pressure = 0.0;                          ///< Pa
  double depth_rate = 0.0;                                ///< mean by pressure, m/s
};

/// Pressure and friction over the surfaces of one region of overlap, with torque, and their linearisation.
/// Keeps buffers only; what lasts is in PatchMemory.
class ContactPatch {
 public:
  /// Sets the pressure, its wrench and its share of the linearisation.
  PatchPressure press(const PatchSurfaces& surfaces, const NormalForceSettings& settings,
                      const ContactMaterial& material, const RelativeTwist& b_in_a, PatchMemory& memory,
                      ContactLinearisation& linearisation);
  /// Friction of what press() has set, on B, about A's origin.
  /// @param loose where the patch's own memory has no bristles of a cell, these may
  Wrench rub(const FrictionSettings& settings, const ContactMaterial& material, const PatchMotion& motion,
             const std::vector<LooseBristles>& loose, PatchMemory& memory,
             ContactLinearisation& linearisation);
  /// Of the last press().
  const PressureField& field() const { return field_; }

 private:
  void addShare(const PatchSite& share);
  void gatherSites();

  std::vector<PatchSite> shares_;                               ///< of samples, with sums instead of means
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order_;  ///< of the shares, by cell
  std::vector<PatchSite> sites_;
  std::vector<SiteBristles> next_;
  double last_cell_size_ = 0.0;  ///< of the memory that press() has met
  PressureField field_;
};

}  // namespace concave_distance

#pragma once

#include <cstdint>
#include <vector>

#include "base/refill.h"
#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/contact/effect_settings.h"
#include "concave_distance/contact/pressure_field.h"
#include "concave_distance/contact/wrench.h"
#include "concave_distance/interference/interference.h"
#include "friction_sites.h"
#include "patch_cells.h"
#include "pressure_law.h"
#include "site_friction.h"

namespace concave_distance {

/// Bristles that may belong to any region.
struct UnmatchedBristles {
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

/// Holds what is kept of a patch from cycle to cycle.
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
  /// Friction of what press() has set, on B, about A's origin. The surfaces given to press() must still
  /// exist.
  /// @param loose where the patch's own memory has no bristles of a cell, these may
  Wrench rub(const FrictionSettings& settings, const ContactMaterial& material, const PatchMotion& motion,
             const std::vector<UnmatchedBristles>& loose, PatchMemory& memory,
             ContactLinearisation& linearisation);
  /// Returns the field of the last press().
  const PressureField& field() const { return field_; }

 private:
  /// Part of the pressure's linearisation.
  struct Spring {
    std::uint64_t cell;
    double force;
    Eigen::Vector3d place;  ///< times the force
    Eigen::Vector3d push;   ///< times the force
    double stiffness;       ///< N/m
    double damping;         ///< N s/m

    void join(const Spring& other) {
      force += other.force;
      place += other.place;
      push += other.push;
      stiffness += other.stiffness;
      damping += other.damping;
    }
  };
  static void addSpring(const Spring& sum, ContactLinearisation& linearisation);

  const OverlapSample* first_sample_ = nullptr;  ///< of the last press()
  const OverlapSample* last_sample_ = nullptr;
  std::vector<double> forces_;  ///< of these samples
  CellSums<Spring> springs_;
  FrictionSites sites_;
  std::vector<SiteBristles> next_;
  double last_cell_size_ = 0.0;  ///< of the memory that press() has met
  PressureField field_;
};

}  // namespace concave_distance

#include "region_forces.h"

#include <algorithm>
#include <cmath>

#include "base/across_normal.h"
#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/tracking/pair_effects.h"
#include "contact/contact_point.h"
#include "contact/friction_laws.h"

namespace concave_distance {
namespace {

// Second moment over area of a square is reach^2 / 6 with the reach to its corners, of a disc reach^2 / 4, of
// a narrow strip reach^2 / 3 about its short axis. Too stiff is stable, too soft is not.
constexpr double kSquaredSpread = 2.0 / 3.0;

/// Adds a region with one force. The stiffness along the normal is spread
/// over the region's width: where flat faces rock, the centroid moves, and with it the force.
void addLumpedContact(const EffectSettings& settings, const ContactMaterial& material,
                      const ContactRegion& region, const RecentSliding& recent,
                      ContactLinearisation& linearisation) {
  const Eigen::Vector3d& normal = region.overlap.normal_in_a;
  const NormalForce force = normalForce(*settings.normal_force, material,
                                        {region.overlap.depth_along_normal, region.depth_rate,
                                         region.overlap.contact_area, region.overlap.volume});
  const FrictionTangent friction =
      frictionTangent(settings.friction, material, region.normal_force, normal, region.sliding_in_a, recent);
  const double spread = std::sqrt(kSquaredSpread) * region.overlap.reach;
  for (const Eigen::Vector3d& side : {friction.along, friction.across}) {
    for (const double sign : {-spread, spread}) {
      const Eigen::Vector3d point = region.point_in_a + sign * side;
      addDirection(0.25 * force.stiffness, normal, point, linearisation.stiffness);
    }
  }
  const Eigen::Vector3d& point = region.point_in_a;
  addDirection(force.damping, normal, point, linearisation.damping);
  addFriction(friction, point, linearisation);
}

PatchSurfaces surfacesOf(const Interference& interference, const InterferenceRegion& region) {
  const OverlapSample* samples = interference.samples.data() + region.first_sample;
  const Eigen::Vector3d* loops = interference.loop_areas_in_a.data() + region.first_loop;
  return {samples,
          samples + region.sample_count,
          loops,
          loops + region.loop_count,
          region.depth,
          region.point_a_in_a,
          (region.point_a_in_a - region.point_b_in_a).normalized()};
}

ContactPoint at(const ContactRegion& region) {
  ContactPoint contact;
  contact.point_in_a = region.point_in_a;
  contact.normal_in_a = region.overlap.normal_in_a;
  contact.geometry.depth = region.overlap.depth_along_normal;
  contact.geometry.contact_area = region.overlap.contact_area;
  contact.geometry.volume = region.overlap.volume;
  return contact;
}

Eigen::Vector3d shiftAcross(const RelativeTwist& displacement, const ContactRegion& region) {
  return acrossNormal(region.overlap.normal_in_a, displacement.at(region.point_in_a));
}

}  // namespace

void RegionForces::setSettings(const EffectSettings& settings, const ContactMaterial& material) {
  settings_ = settings;
  material_ = material;
}

bool RegionForces::isPatch(const InterferenceRegion& region) const {
  return settings_.normal_force->distribution == ForceDistribution::Pressure &&
         (region.facet_count > 0 || region.sample_count > 0);
}

void RegionForces::push(const Interference& interference, const RelativeTwist& b_in_a,
                        std::vector<RegionMemory>& memory, PairContacts& contacts) {
  patches_.resize(std::max(patches_.size(), contacts.regions.size()));
  for (std::size_t r = 0; r < contacts.regions.size(); ++r) {
    ContactRegion& region = contacts.regions[r];
    if (isPatch(region.overlap)) {
      pushPatch(surfacesOf(interference, region.overlap), b_in_a, r, memory[r].patch, contacts);
    } else {
      pushLumped(b_in_a, region);
    }
    if (std::isnan(region.normal_force)) continue;
    region.on_b_in_a = region.normal_on_b_in_a;
  }
}

void RegionForces::pushPatch(const PatchSurfaces& surfaces, const RelativeTwist& b_in_a, std::size_t r,
                             PatchMemory& memory, PairContacts& contacts) {
  ContactRegion& region = contacts.regions[r];
  const PatchPressure pressure =
      patches_[r].press(surfaces, *settings_.normal_force, material_, b_in_a, memory, contacts.linearisation);
  if (region.overlap.normal_is_fallback && !memory.entered_in_a.isZero())
    region.overlap.normal_in_a = memory.entered_in_a;
  region.normal_on_b_in_a = pressure.on_b_in_a;
  region.normal_force = pressure.on_b_in_a.force.norm();
  region.force_direction_in_a = region.normal_force > 0.0
                                    ? Eigen::Vector3d(pressure.on_b_in_a.force / region.normal_force)
                                    : region.overlap.normal_in_a;
  region.largest_pressure = pressure.largest_pressure;
  region.depth_rate = pressure.depth_rate;
  if (pressure.force > 0.0) region.point_in_a = pressure.centre_in_a;
  region.sliding_in_a = acrossNormal(region.force_direction_in_a, b_in_a.at(region.point_in_a));
}

void RegionForces::pushLumped(const RelativeTwist& b_in_a, ContactRegion& region) const {
  ContactPoint contact = at(region);
  setRelativeMotion(b_in_a, contact);
  region.depth_rate = contact.geometry.depth_rate;
  region.sliding_in_a = contact.sliding_in_a;
  if (std::isnan(contact.geometry.depth)) return;  // an open surface: no depth, no force
  region.normal_force = normalForce(*settings_.normal_force, material_, contact.geometry).force;
  region.force_direction_in_a = contact.normal_in_a;
  region.normal_on_b_in_a =
      wrenchAbout(region.normal_force * contact.normal_in_a, contact.point_in_a, Eigen::Vector3d::Zero());
}

void RegionForces::rub(const PatchMotion& motion, const std::vector<UnmatchedBristles>& loose,
                       std::vector<RegionMemory>& memory, PairContacts& contacts) {
  for (std::size_t r = 0; r < contacts.regions.size(); ++r) {
    ContactRegion& region = contacts.regions[r];
    if (!(region.normal_force >= 0.0)) continue;
    if (isPatch(region.overlap)) {
      region.rubbing_on_b_in_a = patches_[r].rub(settings_.friction, material_, motion, loose,
                                                 memory[r].patch, contacts.linearisation);
    } else if (region.normal_force > 0.0) {
      region.rubbing_on_b_in_a = rubLumped(motion.displacement, region, memory[r].bristles);
    } else {
      continue;
    }
    if (resistsTurning(material_)) addTurning(motion, memory[r].turning, region, contacts.linearisation);
    region.friction_on_b_in_a = region.rubbing_on_b_in_a.force;
    region.on_b_in_a += region.rubbing_on_b_in_a;
  }
}

Wrench RegionForces::rubLumped(const RelativeTwist& displacement, const ContactRegion& region,
                               BristleState& bristles) const {
  const Eigen::Vector3d force =
      frictionForce(settings_.friction, material_, region.normal_force, region.overlap.normal_in_a,
                    region.sliding_in_a, shiftAcross(displacement, region), bristles);
  return wrenchAbout(force, region.point_in_a, Eigen::Vector3d::Zero());
}

// The bodies turn as a whole: of a region that bends the pressures' sum counts, along its direction.
void RegionForces::addTurning(const PatchMotion& motion, TurningBristles& bristles, ContactRegion& region,
                              ContactLinearisation& linearisation) const {
  if (!(region.normal_force > 0.0)) {
    bristles = {};
    return;
  }
  const TurningContact contact{region.force_direction_in_a, region.normal_force, turning_arm_};
  const TurningMotion turning{motion.b_in_a.angular, motion.displacement.angular, motion.step};
  region.rubbing_on_b_in_a.torque +=
      resistTurning(settings_.friction, material_, contact, turning, bristles, linearisation);
}

void RegionForces::linearise(const PatchMotion& motion, const std::vector<RegionMemory>& memory,
                             PairContacts& contacts) const {
  for (std::size_t r = 0; r < contacts.regions.size(); ++r) {
    const ContactRegion& region = contacts.regions[r];
    if (isPatch(region.overlap) || !(region.normal_force > 0.0)) continue;
    addLumpedContact(settings_, material_, region,
                     {shiftAcross(motion.displacement, region), motion.step, memory[r].bristles},
                     contacts.linearisation);
  }
  mirrorUpper(contacts.linearisation.stiffness);
  mirrorUpper(contacts.linearisation.damping);
}

}  // namespace concave_distance

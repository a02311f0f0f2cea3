#include "concave_distance/tracking/pair_effects.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "contact/contact_patch.h"
#include "contact/contact_point.h"
#include "contact/motion_between.h"
#include "lumped_linearisation.h"
#include "region_identity.h"
#include "relative_motion.h"
#include "require_bodies.h"

namespace concave_distance {
namespace {

bool contactIsPossible(const PairSolution& solution) {
  if (solution.status == SolveStatus::InvalidPose) return false;
  if (solution.status == SolveStatus::Penetrating) return true;
  return std::isnan(solution.lower_bound) ? !(solution.distance > 0.0) : !(solution.lower_bound > 0.0);
}

Wrench notComputed() {
  return {Eigen::Vector3d::Constant(kNotComputed), Eigen::Vector3d::Constant(kNotComputed)};
}

}  // namespace

struct PairEffects::State {
  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  EffectSettings settings;
  ContactMaterial material;
  EffectPlan plan;
  EffectCounts counts;
  InterferenceWorkspace workspace;
  Interference interference;
  RegionIdentity identity;
  std::vector<ContactPatch> patches;  ///< by region
  Eigen::Isometry3d last_pose = Eigen::Isometry3d::Identity();
  bool in_contact = false;  ///< in the last cycle, at last_pose

  struct Kept {
    std::vector<RegionMemory> regions;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    bool in_contact = false;
  };
  Kept kept;

  void findRegions(const Eigen::Isometry3d& a_from_b, WorkLimit* limit, PairContacts& contacts) {
    findInterference(*a, *b, a_from_b, workspace, interference, limit);
    contacts.cut = interference.status == InterferenceStatus::Cut;
    contacts.a_inside_b = interference.a_inside_b;
    contacts.b_inside_a = interference.b_inside_a;
    contacts.regions.resize(interference.regions.size());
    for (std::size_t r = 0; r < contacts.regions.size(); ++r) {
      contacts.regions[r] = {};
      contacts.regions[r].overlap = interference.regions[r];
      contacts.regions[r].point_in_a = interference.regions[r].centroid_in_a;
    }
  }

  void identify(const PairSolution& solution, PairContacts& contacts) {
    const double displacement =
        in_contact ? largestDisplacement(b->bounds(), last_pose, solution.a_from_b) : 0.0;
    identity.update(solution.niches, displacement, contacts.regions);
  }

  bool isPatch(const ContactRegion& region) const {
    return settings.normal_force->distribution == ForceDistribution::Pressure &&
           (region.overlap.facet_count > 0 || region.overlap.sample_count > 0);
  }

  void push(const RelativeTwist& b_in_a, PairContacts& contacts) {
    patches.resize(std::max(patches.size(), contacts.regions.size()));
    for (std::size_t r = 0; r < contacts.regions.size(); ++r) {
      ContactRegion& region = contacts.regions[r];
      if (isPatch(region)) {
        pushPatch(r, b_in_a, contacts);
      } else {
        pushLumped(b_in_a, region);
      }
      if (std::isnan(region.normal_force)) continue;
      region.on_b_in_a = region.normal_on_b_in_a;
    }
  }

  void pushPatch(std::size_t r, const RelativeTwist& b_in_a, PairContacts& contacts) {
    ContactRegion& region = contacts.regions[r];
    PatchMemory& memory = identity.memory()[r].patch;
    const PatchPressure pressure = patches[r].press(surfacesOf(region.overlap), *settings.normal_force,
                                                    material, b_in_a, memory, contacts.linearisation);
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
    const Eigen::Vector3d velocity = b_in_a.at(region.point_in_a);
    const Eigen::Vector3d& along = region.force_direction_in_a;
    region.sliding_in_a = velocity - along.dot(velocity) * along;
  }

  PatchSurfaces surfacesOf(const InterferenceRegion& region) const {
    const OverlapSample* samples = interference.samples.data() + region.first_sample;
    const Eigen::Vector3d* loops = interference.loop_areas_in_a.data() + region.first_loop;
    return {samples, samples + region.sample_count, loops, loops + region.loop_count, region.depth};
  }

  void pushLumped(const RelativeTwist& b_in_a, ContactRegion& region) const {
    ContactPoint contact = at(region);
    setRelativeMotion(b_in_a, contact);
    region.depth_rate = contact.geometry.depth_rate;
    region.sliding_in_a = contact.sliding_in_a;
    if (std::isnan(contact.geometry.depth)) return;  // an open surface: no depth, no force
    region.normal_force = normalForce(*settings.normal_force, material, contact.geometry).force;
    region.force_direction_in_a = contact.normal_in_a;
    region.normal_on_b_in_a =
        wrenchAbout(region.normal_force * contact.normal_in_a, contact.point_in_a, Eigen::Vector3d::Zero());
  }

  /// Of B against A since the last cycle; `b_in_a` where it is not known.
  RelativeTwist displacement(const Eigen::Isometry3d& a_from_b, const RelativeTwist& b_in_a,
                             double step) const {
    const RelativeTwist twist = in_contact && step > 0.0 ? motionBetween(last_pose, a_from_b, step) : b_in_a;
    return {step * twist.linear, step * twist.angular};
  }

  void rub(const RelativeTwist& b_in_a, const RelativeTwist& displacement, double step,
           PairContacts& contacts) {
    for (std::size_t r = 0; r < contacts.regions.size(); ++r) {
      ContactRegion& region = contacts.regions[r];
      if (!(region.normal_force >= 0.0)) continue;
      if (isPatch(region)) {
        region.rubbing_on_b_in_a = patches[r].rub(settings.friction, material, {b_in_a, displacement, step},
                                                  identity.memory()[r].patch, contacts.linearisation);
      } else if (region.normal_force > 0.0) {
        region.rubbing_on_b_in_a = rubLumped(displacement, region, identity.memory()[r].bristles);
      } else {
        continue;
      }
      region.friction_on_b_in_a = region.rubbing_on_b_in_a.force;
      region.on_b_in_a += region.rubbing_on_b_in_a;
    }
  }

  static Eigen::Vector3d acrossNormal(const RelativeTwist& displacement, const ContactRegion& region) {
    const Eigen::Vector3d& normal = region.overlap.normal_in_a;
    const Eigen::Vector3d shift = displacement.at(region.point_in_a);
    return shift - normal.dot(shift) * normal;
  }

  Wrench rubLumped(const RelativeTwist& displacement, const ContactRegion& region,
                   BristleState& bristles) const {
    const Eigen::Vector3d force =
        frictionForce(settings.friction, material, region.normal_force, region.overlap.normal_in_a,
                      region.sliding_in_a, acrossNormal(displacement, region), bristles);
    return wrenchAbout(force, region.point_in_a, Eigen::Vector3d::Zero());
  }

  void linearise(const RelativeTwist& displacement, double step, PairContacts& contacts) {
    for (std::size_t r = 0; r < contacts.regions.size(); ++r) {
      const ContactRegion& region = contacts.regions[r];
      if (isPatch(region) || !(region.normal_force > 0.0)) continue;
      addLumpedContact(settings, material, region,
                       {acrossNormal(displacement, region), step, identity.memory()[r].bristles},
                       contacts.linearisation);
    }
    mirrorUpper(contacts.linearisation.stiffness);
    mirrorUpper(contacts.linearisation.damping);
  }

  static ContactPoint at(const ContactRegion& region) {
    ContactPoint contact;
    contact.point_in_a = region.point_in_a;
    contact.normal_in_a = region.overlap.normal_in_a;
    contact.geometry.depth = region.overlap.depth_along_normal;
    contact.geometry.contact_area = region.overlap.contact_area;
    contact.geometry.volume = region.overlap.volume;
    return contact;
  }

  bool isDue(EffectStage stage, const PairContacts& contacts) const {
    switch (stage) {
      case EffectStage::Interference:
        return contacts.possible;
      case EffectStage::Identity:
      case EffectStage::NormalForce:
        return !contacts.regions.empty();
      case EffectStage::Friction:
        return std::any_of(contacts.regions.begin(), contacts.regions.end(),
                           [](const ContactRegion& region) { return region.normal_force > 0.0; });
    }
    return false;
  }
};

PairEffects::PairEffects(std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
                         const EffectSettings& settings, const ContactMaterial& material)
    : state_(std::make_unique<State>()) {
  requireBodies("PairEffects", a, b);
  state_->a = std::move(a);
  state_->b = std::move(b);
  setSettings(settings, material);
}
PairEffects::~PairEffects() = default;
PairEffects::PairEffects(PairEffects&&) noexcept = default;
PairEffects& PairEffects::operator=(PairEffects&&) noexcept = default;

void PairEffects::update(const PairSolution& solution, const RelativeTwist& b_in_a, double step,
                         PairContacts& contacts, WorkLimit* limit) {
  State& state = *state_;
  contacts.possible = !state.plan.empty() && contactIsPossible(solution);
  contacts.regions.clear();
  contacts.a_inside_b = contacts.b_inside_a = contacts.cut = false;
  contacts.linearisation = {};
  const RelativeTwist displacement = state.displacement(solution.a_from_b, b_in_a, step);
  for (const EffectStage stage : state.plan) {
    if (!state.isDue(stage, contacts)) continue;
    const auto start = std::chrono::steady_clock::now();
    switch (stage) {
      case EffectStage::Interference:
        state.findRegions(solution.a_from_b, limit, contacts);
        break;
      case EffectStage::Identity:
        state.identify(solution, contacts);
        break;
      case EffectStage::NormalForce:
        state.push(b_in_a, contacts);
        break;
      case EffectStage::Friction:
        state.rub(b_in_a, displacement, step, contacts);
        break;
    }
    const auto index = static_cast<std::size_t>(stage);
    ++state.counts.runs[index];
    state.counts.seconds[index] +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  if (contacts.cut) {
    contacts.on_b_in_a = notComputed();
    return;
  }
  if (contacts.regions.empty()) state.identity.clear();
  contacts.on_b_in_a = state.settings.normal_force ? Wrench{} : notComputed();
  if (state.settings.normal_force) {
    for (const ContactRegion& region : contacts.regions) {
      if (region.normal_force >= 0.0) contacts.on_b_in_a += region.on_b_in_a;
    }
    if (!contacts.regions.empty()) state.linearise(displacement, step, contacts);
  }
  state.in_contact = !contacts.regions.empty();
  state.last_pose = solution.a_from_b;
}

void PairEffects::reset() {
  state_->identity.clear();
  state_->in_contact = false;
}

void PairEffects::keep() {
  state_->kept.regions = state_->identity.memory();
  state_->kept.pose = state_->last_pose;
  state_->kept.in_contact = state_->in_contact;
}

void PairEffects::goBack() {
  state_->identity.memory() = state_->kept.regions;
  state_->last_pose = state_->kept.pose;
  state_->in_contact = state_->kept.in_contact;
}

void PairEffects::setSettings(const EffectSettings& settings, const ContactMaterial& material) {
  settings.validate(state_->a->name() + "/" + state_->b->name() + ".effects");
  state_->settings = settings;
  state_->material = material;
  state_->plan = EffectPlan(settings);
  for (RegionMemory& memory : state_->identity.memory()) {
    memory.bristles = {};
    memory.patch.bristles.clear();
  }
}

const EffectSettings& PairEffects::settings() const {
  return state_->settings;
}
const EffectPlan& PairEffects::plan() const {
  return state_->plan;
}
const EffectCounts& PairEffects::counts() const {
  return state_->counts;
}

}  // namespace concave_distance

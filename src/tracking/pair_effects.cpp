#include "concave_distance/tracking/pair_effects.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "contact/motion_between.h"
#include "distance/kernels/pair_motion.h"
#include "region_forces.h"
#include "region_identity.h"
#include "require_bodies.h"
#include "rigid_pose.h"

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

/// Half of the middle one of a body's widths: of a ball, a rod, a coin and a lying cylinder the radius.
double radiusOf(const BodyMesh& body) {
  Eigen::Vector3d widths = body.surface().boundingBox().sizes();
  std::sort(widths.data(), widths.data() + 3);
  return 0.5 * widths.y();
}

}  // namespace

struct PairEffects::State {
  State(std::shared_ptr<const BodyMesh> body_a, std::shared_ptr<const BodyMesh> body_b)
      : a(std::move(body_a)), b(std::move(body_b)), forces(std::min(radiusOf(*a), radiusOf(*b))) {}

  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  EffectSettings settings;
  EffectPlan plan;
  EffectCounts counts;
  InterferenceWorkspace workspace;
  Interference interference;
  RegionIdentity identity;
  RegionForces forces;
  std::vector<KnownNormal> known_normals;
  Eigen::Isometry3d last_pose = Eigen::Isometry3d::Identity();
  bool in_contact = false;  ///< in the last cycle, at last_pose

  struct Kept {
    std::vector<RegionMemory> regions;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    bool in_contact = false;
  };
  Kept kept;

  void findRegions(const Eigen::Isometry3d& a_from_b, WorkLimit* limit, PairContacts& contacts) {
    known_normals.clear();
    for (const RegionMemory& region : identity.memory()) {
      if (!region.normal_in_a.isZero())
        known_normals.push_back({region.point_in_a, region.reach, region.normal_in_a});
    }
    findInterference(*a, *b, a_from_b, workspace, interference, limit, known_normals);
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
        in_contact ? detail::PairMotion(last_pose, solution.a_from_b).largestIn(b->bounds()) : 0.0;
    identity.update(solution.niches, displacement, contacts.regions);
  }

  /// Returns the displacement of B against A since the last cycle; `b_in_a` where it is not known.
  RelativeTwist displacement(const Eigen::Isometry3d& a_from_b, const RelativeTwist& b_in_a,
                             double step) const {
    const RelativeTwist twist = in_contact && step > 0.0 ? motionBetween(last_pose, a_from_b, step) : b_in_a;
    return {step * twist.linear, step * twist.angular};
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
                         const EffectSettings& settings, const ContactMaterial& material) {
  requireBodies("PairEffects", a, b);
  state_ = std::make_unique<State>(std::move(a), std::move(b));
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
  state.interference.regions.clear();
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
        state.forces.push(state.interference, b_in_a, state.identity.memory(), contacts);
        break;
      case EffectStage::Friction:
        state.forces.rub({b_in_a, displacement, step}, state.identity.loose(), state.identity.memory(),
                         contacts);
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
    if (!contacts.regions.empty())
      state.forces.linearise({b_in_a, displacement, step}, state.identity.memory(), contacts);
  }
  state.identity.keepNormals(contacts.regions);
  state.in_contact = !contacts.regions.empty();
  state.last_pose = solution.a_from_b;
}

const Interference& PairEffects::surfaces() const {
  return state_->interference;
}

const PressureField* PairEffects::pressure(std::size_t index) const {
  const State& state = *state_;
  if (!state.settings.normal_force || index >= state.interference.regions.size()) return nullptr;
  return state.forces.pressure(state.interference.regions[index], index);
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
  state_->forces.setSettings(settings, material);
  state_->plan = EffectPlan(settings);
  state_->interference.regions.clear();
  for (RegionMemory& memory : state_->identity.memory()) {
    memory.bristles = {};
    memory.turning = {};
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

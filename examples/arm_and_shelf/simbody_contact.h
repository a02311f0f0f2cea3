// Contact for bodies of Simbody: the pressures and friction of this package as a force element.
#pragma once

#include <Simbody.h>
#include <concave_distance/tracking/pair_effects.h>
#include <concave_distance/tracking/pair_tracker.h>

#include <memory>
#include <vector>

/// A body of the engine with the mesh that is fixed to its frame.
struct ContactBody {
  SimTK::MobilizedBody body;
  std::shared_ptr<const concave_distance::BodyMesh> mesh;
};

/// Bristles have a state, and an integrator tries steps that it gives up again. So every evaluation begins
/// from what was kept at the last step that the integrator has accepted: the force is a function of the
/// engine's state alone, however often and in any order it is asked for. accept() ends a step.
class SimbodyContact : public SimTK::Force::Custom::Implementation {
 public:
  void add(const ContactBody& a, const ContactBody& b, const concave_distance::EffectSettings& settings,
           const concave_distance::Material& material);

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces, SimTK::Vector& mobility_forces) const override;
  /// Not known to the engine: arm_and_shelf integrates the contacts' work instead.
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

  /// The integrator's step up to this state is final: bristles go on from here.
  void accept(const SimTK::State& state);

  /// By pair, of the last evaluation.
  const concave_distance::PairContacts& contacts(std::size_t pair) const { return pairs_[pair]->contacts; }
  std::size_t pairCount() const { return pairs_.size(); }

 private:
  struct Pair {
    ContactBody a;
    ContactBody b;
    concave_distance::PairTracker tracker;
    concave_distance::PairEffects effects;
    concave_distance::PairSolution solution;
    concave_distance::PairContacts contacts;
  };
  void evaluate(const SimTK::State& state, Pair& pair) const;

  std::vector<std::unique_ptr<Pair>> pairs_;
  double accepted_time_ = 0.0;
};

#pragma once

#include <memory>
#include <string>

#include "base/constants.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "simulation/scene_builder.h"

namespace concave_distance::benchmark {

inline constexpr double kGravity = 9.81;  // m/s^2, the simulation's default

EffectSettings effectsOf(NormalForceModel normal, FrictionModel friction = FrictionModel::None);

/// A contact scene in the making: one material, one set of effects, the proven distance alone tracked. Only
/// bodies that are told to meet do.
struct ContactStage : test::SceneBuilder {
  Material material;       ///< of the bodies added next
  EffectSettings effects;  ///< of the pairs added next

  ContactStage() { settings.tracking = SimulationTracking::SingleMinimum; }

  void addFixed(const std::string& name, SurfaceMesh mesh, const Eigen::Isometry3d& pose);
  /// The settings are valid until the next body is added.
  SimulatedBodySettings& addFree(const std::string& name, SurfaceMesh mesh, double mass,
                                 const Eigen::Isometry3d& pose);
  /// The same for an exact round solid.
  SimulatedBodySettings& addFree(const std::string& name, const RoundShape& shape, double mass,
                                 const Eigen::Isometry3d& pose);
  void letMeet(const std::string& a, const std::string& b);
  /// A block 0.2 m thick whose upper face is z = 0, and `count` cubes of `side` on it, each on the one below.
  void addGround(double side = 4.0);
  void addTower(int count, double side, double mass);
  ContactMaterial contactMaterial() const { return inContact(material, material); }
};

/// With a damped bed of springs for flat faces (that of config/box_sticks.yaml), on which bodies settle soon.
ContactStage bedStage(FrictionModel friction);

/// Contacts of one pair at poses given one after the other.
class PairProbe {
 public:
  PairProbe(const SurfaceMesh& a, const SurfaceMesh& b, const EffectSettings& effects,
            const Material& material = {});
  const PairContacts& at(const Eigen::Isometry3d& a_from_b, const RelativeTwist& b_in_a = {});

 private:
  std::shared_ptr<const BodyMesh> a_;
  std::shared_ptr<const BodyMesh> b_;
  PairTracker tracker_;
  PairEffects effects_;
  PairSolution solution_;
  PairContacts contacts_;
  double time_ = 0.0;
};

/// The mean place of a body's centre over a span of time, each step by its length: what oscillates about it
/// does not count.
class MeanPlace {
 public:
  MeanPlace(double from, double until) : from_(from), until_(until) {}
  void add(double time, double step, const Eigen::Vector3d& place) {
    if (time < from_ || time > until_) return;
    sum_ += step * place;
    weight_ += step;
  }
  Eigen::Vector3d mean() const { return sum_ / weight_; }  ///< NaN before the span

 private:
  double from_;
  double until_;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  double weight_ = 0.0;
};

/// A prism over a regular polygon of `corners` corners on the circle of `radius`, about z, centred. makeTube
/// has its corners at the same angles.
SurfaceMesh makePolygonPrism(double radius, double length, int corners);
/// A block with a cavity: two shells, the inner one turned inwards.
SurfaceMesh makeHollowCube(double outer_side, double inner_side);
/// A floor 0.1 m thick and a wall 0.1 m thick in one mesh, the inner corner along y at x = z = 0.
SurfaceMesh makeInnerCorner();
/// How far below the body's origin its lowest vertex is, turned as it is.
double depthOfLowestVertex(const SurfaceMesh& mesh, const Eigen::Matrix3d& turn);

}  // namespace concave_distance::benchmark

#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "concave_distance/contact/wrench.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/simulation_settings.h"
#include "concave_distance/simulation/energy_account.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance {

struct SimulatedBody {
  std::string name;
  BodyMotion motion = BodyMotion::Fixed;
  Eigen::Isometry3d world_from_body = Eigen::Isometry3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< of mass (free), world; else the frame's origin
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of that point, world, m/s
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< world axes, rad/s
  /// The wrench is that of all contacts, drives and loads, about `centre`, world axes; on fixed and driven
  /// bodies that of the contacts.
  Wrench contact_wrench;
  Wrench drive_wrench;
  Wrench load_wrench;
  std::uint64_t held_back_by_drive = 0;  ///< steps so far that the drive's accuracy has made shorter
};

struct SimulatedPair {
  std::string name;
  std::size_t body_a = 0;  ///< index into Simulation::bodies
  std::size_t body_b = 0;
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  double lower_bound = 0.0;  ///< proven, metres; of the broad phase where the pair is beyond its cutoff
  bool solved = false;       ///< else beyond its cutoff: `solution` is of an earlier time
  PairSolution solution;
  PairContacts contacts;
  /// With SimulationTracking::SingleMinimum and Both these tell the one minimum that is followed, and whether
  /// it is not the closest; else they are NaN and false.
  double single_distance = kNotComputed;
  Eigen::Vector3d single_point_a_in_a = Eigen::Vector3d::Constant(kNotComputed);
  Eigen::Vector3d single_point_b_in_a = Eigen::Vector3d::Constant(kNotComputed);
  bool single_is_wrong = false;
  /// Steps so far that this pair has made shorter: StepLimit::Accuracy, StepLimit::Distance.
  std::uint64_t held_back_by_accuracy = 0;
  std::uint64_t held_back_by_distance = 0;
  double seconds = 0.0;  ///< so far, of wall clock, for its distance and its effects
};

/// Says what held a step back.
enum class StepLimit : std::uint8_t {
  Largest,   ///< largest_step
  Event,     ///< the time asked for, a load's begin or end, a pose of a path
  Distance,  ///< the proven distance and a share of the depth that the next contact reaches
  Accuracy,  ///< of the motion in contacts and drives
  Rotation   ///< step_fraction of a radian
};
inline constexpr std::size_t kStepLimits = 5;
std::string_view toString(StepLimit limit);

/// Names what a simulation's time goes into.
enum class SimulationStage : std::uint8_t {
  Solve,       ///< PairTracker: distance, proof, niches
  Effects,     ///< PairEffects: regions and forces
  Single,      ///< the single minimum, where it is followed
  Integration  ///< steps, external forces, energies
};
inline constexpr std::size_t kSimulationStages = 4;
std::string_view toString(SimulationStage stage);

struct SimulationCounters {
  std::uint64_t steps = 0;
  std::uint64_t shortened = 0;  ///< drifts done again since they went too far
  std::uint64_t rejected = 0;   ///< steps done again since a contact changed too much within them
  std::uint64_t solves = 0;
  std::uint64_t broad_phase_only = 0;  ///< pairs not solved since beyond their cutoff
  std::uint64_t contact_steps = 0;     ///< steps that ended with a force at some pair
  std::array<std::uint64_t, kStepLimits> limited_by{};
  double smallest_step = std::numeric_limits<double>::infinity();  ///< seconds
  double largest_depth = 0.0;                                      ///< of all regions so far, metres
  double largest_quaternion_drift = 0.0;                           ///< in one step, before it was normalised
  std::array<double, kSimulationStages> seconds{};
};

enum class SimulationStatus : std::uint8_t {
  Ok,
  Diverged  ///< a state is not finite any more, or steps have shrunk to nothing: it stands still
};

/// Rigid bodies in contact over time: kick, drift, kick with the exact splitting of RigidBody::drift, and
/// kicks that contain the stiffness and damping of contacts and drives implicitly, of all coupled bodies
/// together. Second order; one evaluation of the contacts a step, which is repeated with less where its error
/// is too large. No point of a body moves in one step against another body farther than their proven distance
/// and a share of the depth that the contact reaches: no body passes through another unseen. Deterministic.
/// Not thread-safe.
class Simulation {
 public:
  /// @throws Error when the scene has no section `simulation` or lacks what could not be loaded, for a free
  ///         body without mass, settings out of range, a pair whose level proves no distance
  explicit Simulation(const Scene& scene);
  Simulation(const Scene& scene, const SimulationSettings& settings);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// One step, never beyond `until`. Niches are listed at `until` alone (of an infinite one after
  /// every step); in between only what the step needs is solved. @return its size in seconds; 0 at
  /// `until` or when diverged
  double step(double until = std::numeric_limits<double>::infinity());
  /// Steps until `time` is reached exactly; the niches are those of that time.
  SimulationStatus advanceTo(double time);

  double time() const;
  SimulationStatus status() const;
  const SimulationSettings& settings() const;
  const std::vector<SimulatedBody>& bodies() const;  ///< in the order of the scene
  const std::vector<SimulatedPair>& pairs() const;   ///< enabled ones with a body that moves
  const EnergyAccount& energy() const;
  const SimulationCounters& counters() const;
  /// Returns what is probably a mistake in the scene, each with a remedy: free bodies that nothing can hold,
  /// that have no pair, whose mass cannot lie within them, or that begin deep in another.
  const std::vector<std::string>& warnings() const;
  /// Returns whether the error of the energy balance is within SimulationSettings::energy_tolerance.
  bool energyIsBalanced() const;
  /// Total linear and angular (about the world's origin) momentum of the free bodies, kg m/s and kg m^2/s.
  Eigen::Vector3d momentum() const;
  Eigen::Vector3d angularMomentum() const;

  /// Puts a load on a body from now on, until it is replaced, e.g. by a controller. World axes, about the
  /// centre of mass. Without effect on fixed and driven bodies.
  void setExternalWrench(std::size_t body, const Wrench& about_centre);
  /// Moves the target of a body's drive, from now on and to stay. @throws Error for a body without a drive
  void setDriveTarget(std::size_t body, const Eigen::Isometry3d& world_from_target);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace concave_distance

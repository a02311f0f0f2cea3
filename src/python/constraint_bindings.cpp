#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "concave_distance/base/error.h"
#include "concave_distance/kinematics/constraint_rows.h"
#include "joint_positions.h"
#include "python_scene_tracker.h"
#include "unlocked.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

constexpr double kPoseTolerance = 1e-6;  // metres and parts of a rotation, for positions in single precision
constexpr std::int64_t kNoBody = -1;

/// A row of Constraints.rows: ConstraintRow. Metres, world frame.
struct SlotRow {
  std::uint8_t state = 0;  ///< SlotState
  bool is_overlapping = false;
  std::int64_t body_a = kNoBody;  ///< in Scene.body_names
  std::int64_t body_b = kNoBody;
  std::uint64_t niche_id = 0;
  std::uint64_t age = 0;
  double value = kNotComputed;
  double lower_bound = kNotComputed;
  Triple normal = kUnknownPoint;
  Triple point_a = kUnknownPoint;
  Triple point_b = kUnknownPoint;
  Triple point_a_in_frame = kUnknownPoint;
  Triple point_b_in_frame = kUnknownPoint;
  double drift = kNotComputed;
  double drift_a = kNotComputed;
  double drift_b = kNotComputed;
};

/// A row of Constraints.unlisted: UnlistedPlaces.
struct UnlistedRow {
  std::uint8_t reason;  ///< UnlistedReason
  std::int64_t body_a = kNoBody;
  std::int64_t body_b = kNoBody;
  double lower_bound;
  double drift;
};

/// Python has this as Constraints: the rows of one cycle.
struct Constraints {
  explicit Constraints(const ConstraintRows& made);

  std::vector<SlotRow> rows;
  std::vector<std::string> pairs;
  std::vector<double> jacobian;  ///< row by row
  std::vector<UnlistedRow> unlisted;
  std::vector<double> reach;  ///< row by row
  std::size_t velocity_count;
  std::size_t overflow;
};

UnlistedRow unlistedRow(const UnlistedPlaces& places) {
  UnlistedRow row{static_cast<std::uint8_t>(places.reason), kNoBody, kNoBody, places.lower_bound,
                  places.drift};
  if (places.pair) {
    row.body_a = static_cast<std::int64_t>(places.pair->origin->body_a);
    row.body_b = static_cast<std::int64_t>(places.pair->origin->body_b);
  } else {
    row.body_a = static_cast<std::int64_t>(places.body);
  }
  return row;
}

SlotRow slotRow(const ConstraintRow& row) {
  SlotRow copied;
  copied.state = static_cast<std::uint8_t>(row.state);
  copied.is_overlapping = row.is_overlapping;
  if (row.pair) {
    copied.body_a = static_cast<std::int64_t>(row.pair->origin->body_a);
    copied.body_b = static_cast<std::int64_t>(row.pair->origin->body_b);
  }
  copied.niche_id = row.niche_id;
  copied.age = row.age;
  copied.value = row.value;
  copied.lower_bound = row.lower_bound;
  copied.normal = tripleOf(row.normal);
  copied.point_a = tripleOf(row.point_a);
  copied.point_b = tripleOf(row.point_b);
  copied.point_a_in_frame = tripleOf(row.point_a_in_frame);
  copied.point_b_in_frame = tripleOf(row.point_b_in_frame);
  copied.drift = row.drift;
  copied.drift_a = row.drift_a;
  copied.drift_b = row.drift_b;
  return copied;
}

Constraints::Constraints(const ConstraintRows& made)
    : jacobian(made.jacobian().data(), made.jacobian().data() + made.jacobian().size()),
      reach(made.reach().data(), made.reach().data() + made.reach().size()),
      velocity_count(static_cast<std::size_t>(made.jacobian().cols())),
      overflow(made.overflow()) {
  for (const ConstraintRow& row : made.rows()) {
    rows.push_back(slotRow(row));
    pairs.push_back(row.pair ? row.pair->origin->name : std::string());
  }
  for (const UnlistedPlaces& places : made.unlisted()) unlisted.push_back(unlistedRow(places));
}

/// Python has this as ConstraintRows: usable from any thread, one at a time.
class PythonRows {
 public:
  PythonRows(ScenePointer scene, double distance, std::uint32_t capacity, double tilt)
      : scene_(std::move(scene)),
        rows_(scene_->joints, {distance, capacity, tilt}),
        state_(scene_->joints->startState()) {}

  Constraints update(PythonSceneTracker& tracker, const py::object& positions, const py::object& roots) {
    if (tracker.scene() != scene_)
      throw Error("tracker", "it tracks another scene than that of the rows", "make both of one Scene");
    const JointPositions given(*scene_, positions, roots);
    if (given.isArray())
      throw Error("positions", "there are several rows of them", "give (p,): those of the cycle");
    const Unlocked unlocked;
    const std::lock_guard<std::mutex> turn(mutex_);
    tracker.withLastCycle([&](const SceneTracker::Pairs& pairs, const PythonSceneTracker::Cycle& cycle) {
      if (cycle.world_from_body.empty())
        throw Error("tracker", "it has had no cycle yet", "call SceneTracker.update() first");
      SceneState state = state_;
      given.placeRoots(state);
      for (std::size_t body = 0; body < state.world_from_body.size(); ++body)
        state.world_from_body[body] = cycle.world_from_body[body];
      scene_->joints->evaluate(given.row(0), state);
      requireSame(cycle, state);
      rows_.update(pairs, state, cycle.time);
    });
    return Constraints(rows_);
  }
  void reset() {
    const Unlocked unlocked;
    const std::lock_guard<std::mutex> turn(mutex_);
    rows_.reset();
  }
  const ScenePointer& scene() const { return scene_; }

 private:
  // Rows of other positions than those of the cycle would have wrong gradients.
  void requireSame(const PythonSceneTracker::Cycle& cycle, const SceneState& state) const {
    for (std::size_t body = 0; body < state.world_from_body.size(); ++body) {
      const auto& there = cycle.world_from_body[body];
      const auto& here = state.world_from_body[body];
      if (!there || !here) continue;
      if (!((there->matrix() - here->matrix()).cwiseAbs().maxCoeff() <= kPoseTolerance))
        throw Error(
            "positions",
            "they put body '" + scene_->scene.bodies[body].name + "' elsewhere than the tracker's last cycle",
            "give the positions and roots that the poses of the cycle were made of");
    }
  }

  ScenePointer scene_;
  std::mutex mutex_;
  ConstraintRows rows_;
  SceneState state_;
};

const Constraints& constraintsIn(const py::object& self) {
  return *self.cast<const Constraints*>();
}

// A matrix with a column for each velocity.
py::array_t<double> matrixOf(const std::vector<double>& numbers, std::size_t rows, const py::object& self) {
  const std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(rows),
                                          static_cast<py::ssize_t>(constraintsIn(self).velocity_count)};
  return py::array_t<double>(shape, numbers.data(), self);
}

void bindConstraints(py::module& module) {
  PYBIND11_NUMPY_DTYPE(SlotRow, state, is_overlapping, body_a, body_b, niche_id, age, value, lower_bound,
                       normal, point_a, point_b, point_a_in_frame, point_b_in_frame, drift, drift_a, drift_b);
  PYBIND11_NUMPY_DTYPE(UnlistedRow, reason, body_a, body_b, lower_bound, drift);
  py::class_<Constraints>(
      module, "Constraints",
      "The rows of one cycle. A velocity of the joints changes the values of the used ones by "
      "`jacobian @ velocities - drift`, m/s. What was not computed is NaN.")
      .def("__len__", [](const Constraints& made) { return made.rows.size(); })
      .def_property_readonly(
          "rows", [](const py::object& self) { return viewOf(constraintsIn(self).rows, self); },
          "(capacity,) with the columns state (SlotState; the others hold where it is USED), is_overlapping "
          "(value "
          "is 0 and in truth less), body_a, body_b (places in Scene.body_names), niche_id (of the pair), age "
          "(cycles "
          "since the row has its slot, or its signed value has jumped), value (signed distance, metres), "
          "lower_bound "
          "(proven: no place of the pair is nearer), normal (3; from A to B), point_a (3), point_b (3) in "
          "the world, point_a_in_frame (3), point_b_in_frame (3) in the frames of the bodies: their links, "
          "drift (m/s, "
          "positive when approaching: what no joint does), drift_a, drift_b (its parts, of A's and B's "
          "carriers).")
      .def_property_readonly(
          "jacobian",
          [](const py::object& self) {
            return matrixOf(constraintsIn(self).jacobian, constraintsIn(self).rows.size(), self);
          },
          "(capacity, v) metres per rad or m: rate of each value by Scene.velocity_names; zero "
          "where the slot is not USED.")
      .def_readonly("pairs", &Constraints::pairs, "Name of the pair of each slot, '' where it is not USED.")
      .def_property_readonly(
          "unlisted", [](const py::object& self) { return viewOf(constraintsIn(self).unlisted, self); },
          "(u,) pairs of which places within the distance may have no row, with the columns reason "
          "(UnlistedReason), "
          "body_a, body_b (-1 with NO_POSE: all pairs of body_a), lower_bound (metres: none of them is "
          "nearer; NaN: "
          "they can be anywhere), drift (m/s, at most; NaN: not known).")
      .def_property_readonly(
          "reach",
          [](const py::object& self) {
            return matrixOf(constraintsIn(self).reach, constraintsIn(self).unlisted.size(), self);
          },
          "(u, v): a place of `unlisted` comes nearer by at most reach @ abs(velocities) + drift, m/s.")
      .def_readonly("overflow", &Constraints::overflow, "How many rows have no slot: the farthest.");
}

}  // namespace

void bindRows(py::module& module) {
  bindConstraints(module);
  py::class_<PythonRows>(module, "ConstraintRows",
                         "Rows for controllers: for every niche within a distance, of pairs that a joint can "
                         "move, how its distance "
                         "changes with the joints of all robots. A row keeps its slot while its niche lives. "
                         "It may be used from any "
                         "thread; calls wait for each other.")
      .def(py::init<ScenePointer, double, std::uint32_t, double>(), py::arg("scene").none(false),
           py::arg("distance") = ConstraintSettings().distance,
           py::arg("capacity") = ConstraintSettings().capacity, py::arg("tilt") = ConstraintSettings().tilt,
           "distance: metres; niches within it have rows\n"
           "capacity: number of slots; with more rows than that the farthest have none\n"
           "tilt: radians; edges and faces tilted by less have rows for their corners\n"
           "Raises Error for values that are not positive.")
      .def("update", &PythonRows::update, py::arg("tracker"), py::arg("positions"),
           py::arg("roots") = py::none(),
           "Makes the rows of the tracker's last cycle.\n\n"
           "tracker: a SceneTracker of the same scene, after an update with niches\n"
           "positions: (p,) rad or m, those of the cycle, in the order of Scene.position_names\n"
           "roots: as of Scene.poses_of_bodies\n"
           "Returns Constraints. Raises Error, also when the cycle had a link elsewhere.")
      .def("reset", &PythonRows::reset,
           "Frees all slots. The next rows get them in the order of their distance.")
      .def_property_readonly("scene", &PythonRows::scene);
}

}  // namespace concave_distance::python

#include "answers.h"

#include <pybind11/stl.h>

#include "bindings.h"
#include "concave_distance/base/error.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

const Answers& answersIn(const py::object& self) {
  return *self.cast<const Answers*>();
}

py::object nichesOf(const py::object& self, py::ssize_t row) {
  const Answers& answers = answersIn(self);
  const auto count = static_cast<py::ssize_t>(answers.rows.size());
  const py::ssize_t place = row < 0 ? row + count : row;
  if (place < 0 || place >= count)
    throw py::index_error("there are " + std::to_string(count) + " rows, and none is number " +
                          std::to_string(row));
  const auto at = static_cast<std::size_t>(place);
  return viewOf(answers.niches, self)[py::slice(answers.niche_offsets[at], answers.niche_offsets[at + 1], 1)];
}

}  // namespace

void Answers::append(const PairSolution& solution) {
  const auto& meeting = solution.meeting_triangles;
  rows.push_back({solution.distance, solution.lower_bound, solution.signed_distance,
                  tripleOf(solution.point_a_in_a), tripleOf(solution.point_b_in_a),
                  tripleOf(solution.normal_in_a), solution.closing_speed, solution.solve_seconds,
                  meeting ? static_cast<std::int64_t>(meeting->a.value) : -1,
                  meeting ? static_cast<std::int64_t>(meeting->b.value) : -1,
                  static_cast<std::uint8_t>(solution.accuracy), static_cast<std::uint8_t>(solution.status),
                  solution.niches_complete, solution.niches_cut});
  for (const TrackedNiche& niche : solution.niches) {
    const SignedPlace& place = niche.signed_place;
    niches.push_back({niche.id,
                      niche.distance,
                      niche.signed_distance,
                      tripleOf(niche.point_a_in_a),
                      tripleOf(niche.point_b_in_a),
                      tripleOf(niche.normal_in_a),
                      niche.closing_speed,
                      niche.extent,
                      niche.prominence,
                      tripleOf(place.point_a_in_a),
                      tripleOf(place.point_b_in_a),
                      tripleOf(place.pivot_in_a),
                      tripleOf(place.gradient_in_a),
                      place.since_cycle,
                      niche.birth_cycle,
                      static_cast<std::uint8_t>(place.state),
                      static_cast<std::uint8_t>(niche.kind),
                      static_cast<std::uint8_t>(niche.outward),
                      static_cast<std::uint8_t>(niche.origin),
                      niche.visible,
                      niche.proven_local_minimum});
  }
  niche_offsets.push_back(static_cast<std::int64_t>(niches.size()));
}

SceneAnswers::SceneAnswers(const SceneTracker& tracker, bool due_alone) : beyond(tracker.others().beyond) {
  for (const auto& pair : tracker.pairs()) {
    if (due_alone && !pair->demand.due) continue;
    append(pair->solution);
    pairs.push_back(pair->origin->name);
    bodies.push_back(static_cast<std::int64_t>(pair->origin->body_a));
    bodies.push_back(static_cast<std::int64_t>(pair->origin->body_b));
    states.push_back(static_cast<std::uint8_t>(pair->state));
    bounds.push_back(pair->box_bound.value_or(kNotComputed));
    warnings.push_back(pair->warning.state() == WarningState::Warning ? 1 : 0);
  }
}

void bindAnswers(py::module& module) {
  PYBIND11_NUMPY_DTYPE(AnswerRow, distance, lower_bound, signed_distance, point_a, point_b, normal,
                       closing_speed, solve_seconds, triangle_a, triangle_b, accuracy, status,
                       niches_complete, niches_cut);
  PYBIND11_NUMPY_DTYPE(NicheRow, id, distance, signed_distance, point_a, point_b, normal, closing_speed,
                       extent, prominence, signed_point_a, signed_point_b, signed_pivot, signed_gradient,
                       signed_since_cycle, birth_cycle, signed_state, kind, outward, origin, visible,
                       proven_local_minimum);
  py::class_<Answers>(
      module, "Answers",
      "Answers as structured arrays. What was not computed is NaN. Metres, seconds; points and "
      "normals in A's frame.")
      .def("__len__", [](const Answers& answers) { return answers.rows.size(); })
      .def_property_readonly(
          "rows", [](const py::object& self) { return viewOf(answersIn(self).rows, self); },
          "(n,) with the columns distance, lower_bound (proven: the true distance is not smaller), "
          "signed_distance "
          "(with margins; NaN where the bare bodies overlap), point_a (3), point_b (3), normal (3; unit, "
          "from A to "
          "B), closing_speed (m/s, positive when approaching), solve_seconds, triangle_a, triangle_b (that "
          "meet, "
          "where surfaces do, else -1), accuracy (0 nodes, 1 refined, 2 "
          "certified: reached), status (Status), "
          "niches_complete "
          "(proven), niches_cut (more were known than are listed).")
      .def_property_readonly(
          "niches", [](const py::object& self) { return viewOf(answersIn(self).niches, self); },
          "(m,) niches of all rows, ascending by distance within each, with the columns id (persistent while "
          "the niche lives), distance, signed_distance, point_a (3), point_b (3), normal (3), closing_speed, "
          "extent, prominence, kind (NicheKind), outward (Outwardness), origin (NicheOrigin), visible, "
          "birth_cycle, proven_local_minimum; with the parameter signed_values also signed_state "
          "(SignedState), "
          "signed_point_a "
          "(3), signed_point_b (3), signed_pivot (3), signed_gradient (3; rate of signed_distance by the "
          "velocity of "
          "B less that of A at the pivot), signed_since_cycle.")
      .def_property_readonly(
          "niche_offsets", [](const py::object& self) { return viewOf(answersIn(self).niche_offsets, self); },
          "(n + 1,) int64: the niches of row i are niches[niche_offsets[i]:niche_offsets[i + 1]].")
      .def("niches_of", &nichesOf, py::arg("row"), "The niches of one row, a view of `niches`.");
  py::class_<SceneAnswers, Answers>(module, "SceneAnswers",
                                    "Answers of the pairs of a scene in one cycle, a row for each pair.")
      .def_readonly("pairs", &SceneAnswers::pairs, "Names of the pairs, one for each row.")
      .def_property_readonly(
          "bodies",
          [](const py::object& self) {
            return viewOf(self.cast<const SceneAnswers*>()->bodies, self).attr("reshape")(-1, 2);
          },
          "(n, 2) int64: places of A and B in Scene.body_names.")
      .def_property_readonly(
          "states",
          [](const py::object& self) { return viewOf(self.cast<const SceneAnswers*>()->states, self); },
          "(n,) uint8, PairState: only where it is SOLVED the row is an answer.")
      .def_property_readonly(
          "bounds",
          [](const py::object& self) { return viewOf(self.cast<const SceneAnswers*>()->bounds, self); },
          "(n,) metres: proven distances of pairs that are BEYOND_CUTOFF, NaN elsewhere.")
      .def_property_readonly(
          "warnings",
          [](const py::object& self) { return viewOf(self.cast<const SceneAnswers*>()->warnings, self); },
          "(n,) uint8: 1 below the warning distance, with its hysteresis.")
      .def_readonly("beyond", &SceneAnswers::beyond,
                    "Number of pairs that have no row because they were never near, or no longer are.");
}

}  // namespace concave_distance::python

#include "clearance_result.h"

#include <pybind11/stl.h>

#include <cmath>
#include <utility>

#include "bindings.h"
#include "pose_arrays.h"
#include "text.h"

namespace concave_distance::python {

namespace py = pybind11;

PythonClearance::PythonClearance(const Scene& scene, ClearanceResult found) : result(std::move(found)) {
  for (const PairClearance& pair : result.pairs)
    pairs.push_back({static_cast<std::int64_t>(pair.body_a), static_cast<std::int64_t>(pair.body_b),
                     pair.lower_bound, pair.distance, pair.time});
  if (result.solution) {
    solution.emplace();
    solution->append(*result.solution);
  }
  for (const SceneBody& body : scene.bodies) body_names.push_back(body.name);
}

namespace {

py::object namesOf(const PythonClearance& found, const std::vector<std::size_t>& bodies) {
  py::list names;
  for (const std::size_t body : bodies) names.append(toPython(found.body_names[body]));
  return std::move(names);
}

// The names of a pair; None where there is none.
py::object pairOf(const PythonClearance& found, bool is_there, std::size_t a, std::size_t b) {
  if (!is_there) return py::none();
  return py::make_tuple(toPython(found.body_names[a]), toPython(found.body_names[b]));
}

py::array_t<double> pointOf(const Eigen::Vector3d& point) {
  return py::array_t<double>(3, point.data());
}

double firstBelow(const PythonClearance& found, double FirstBelow::*value) {
  return found.result.first_below ? (*found.result.first_below).*value : kNotComputed;
}

const PythonClearance& clearanceIn(const py::object& self) {
  return *self.cast<const PythonClearance*>();
}

}  // namespace

void bindClearanceResult(py::module& module) {
  using Found = const PythonClearance&;
  const auto of = [](auto member) { return [member](Found found) { return found.result.*member; }; };
  PYBIND11_NUMPY_DTYPE(ClearanceRow, body_a, body_b, lower_bound, distance, time);
  py::class_<PythonClearance>(
      module, "Clearance",
      "The least distance over a whole motion, between the waypoints too. Metres, seconds, "
      "world frame; what was not computed is NaN.")
      .def_property_readonly(
          "status",
          [](Found found) {
            return py::module::import("concave_distance")
                .attr("ClearanceStatus")(static_cast<int>(found.result.status));
          },
          "ClearanceStatus.")
      .def_property_readonly("distance", of(&ClearanceResult::distance), "Of the pair `bodies`, at `time`.")
      .def_property_readonly("lower_bound", of(&ClearanceResult::lower_bound),
                             "Proven: at no time of the motion is any pair nearer.")
      .def_property_readonly("time", of(&ClearanceResult::time))
      .def_property_readonly(
          "bodies",
          [](Found found) {
            return pairOf(found, !std::isnan(found.result.distance), found.result.body_a,
                          found.result.body_b);
          },
          "Names of the nearest pair, or None.")
      .def_property_readonly(
          "point_a", [](Found found) { return pointOf(found.result.point_a); }, "(3,), at `time`.")
      .def_property_readonly(
          "point_b", [](Found found) { return pointOf(found.result.point_b); }, "(3,), at `time`.")
      .def_property_readonly(
          "world_from_a",
          [](Found found) {
            py::array_t<double> matrix(std::vector<py::ssize_t>{4, 4});
            writeMatrix(found.result.world_from_a, matrix.mutable_data());
            return matrix;
          },
          "(4, 4), at `time`.")
      .def_property_readonly(
          "solution", [](Found found) { return found.solution; },
          "Answers with one row: the nearest pair at `time`, with its niches, in A's frame; None unless "
          "niches=True.")
      .def_property_readonly(
          "first_below", [](Found found) { return firstBelow(found, &FirstBelow::time); },
          "Seconds: when a pair is first seen below the threshold, or in contact; NaN: never.")
      .def_property_readonly(
          "first_below_bodies",
          [](Found found) {
            const auto& first = found.result.first_below;
            const bool is_there = first && !std::isnan(first->time);
            return pairOf(found, is_there, is_there ? first->body_a : 0, is_there ? first->body_b : 0);
          },
          "Names of that pair, or None.")
      .def_property_readonly(
          "proven_until", [](Found found) { return firstBelow(found, &FirstBelow::proven_until); },
          "Seconds: before it no pair is below the threshold; NaN without a threshold and contact.")
      .def_property_readonly(
          "pairs", [](const py::object& self) { return viewOf(clearanceIn(self).pairs, self); },
          "(k,) all pairs that the motion moves against each other, with the columns body_a, body_b (places "
          "in Scene.body_names), lower_bound (proven for the whole motion), distance (at `time`; NaN where "
          "it was not computed), time.")
      .def_property_readonly(
          "not_located", [](Found found) { return namesOf(found, found.result.not_located); },
          "Names of bodies whose poses are not known: nothing is proven of their pairs.")
      .def_property_readonly("outside_limits", of(&ClearanceResult::outside_limits),
                             "Names of positions that leave the range that the URDF gives them.")
      .def_property_readonly("velocities_ignored", of(&ClearanceResult::velocities_ignored),
                             "Velocities were given and not used for a floating joint.")
      .def_property_readonly("queries", of(&ClearanceResult::queries), "Number of certified distances.")
      .def_property_readonly("box_queries", of(&ClearanceResult::box_queries),
                             "Number of bounds by boxes alone.")
      .def_property_readonly("seconds", of(&ClearanceResult::seconds), "That the computation took.");
}

}  // namespace concave_distance::python

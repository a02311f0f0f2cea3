#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <string>
#include <vector>

#include "bindings.h"
#include "python_scene_tracker.h"

namespace concave_distance::python {

namespace py = pybind11;

void bindSceneTracker(py::module& module) {
  PYBIND11_NUMPY_DTYPE(NearestRow, distance, lower_bound, is_minimum, status, body_a, body_b, point_a,
                       point_b, normal);
  py::class_<PythonSceneTracker>(
      module, "SceneTracker",
      "A scene over time: finds the near pairs and solves them in parallel. It may be used "
      "from any thread; calls wait for each other.")
      .def(py::init<ScenePointer, std::uint32_t, std::vector<std::string>, bool>(),
           py::arg("scene").none(false), py::arg("threads") = 0,
           py::arg("pairs") = std::vector<std::string>(), py::arg("time_budgets") = true,
           "threads: that solve pairs; 0: one per core\n"
           "pairs: names or patterns of the pairs that are solved, as 'gripper/*'; empty: all\n"
           "time_budgets: False: those that the scene gives to pairs do not count")
      .def("update", &PythonSceneTracker::update, py::arg("poses"), py::arg("time"),
           py::arg("niches_wanted") = true, py::arg("moved") = py::none(),
           "One cycle.\n\n"
           "poses: of the bodies in the world, (b, 4, 4) or (b, 7) with x, y, z, qx, qy, qz, qw, metres; NaN "
           "where one is not known\n"
           "time: seconds, later than that of the last cycle\n"
           "moved: (b,) truth values; only pairs of a body that moved are solved, and have rows; one "
           "whose other body has no pose and did not move waits\n"
           "Returns SceneAnswers with a row for each named pair and each pair that is near. Raises Error.")
      .def(
          "nearest",
          [](PythonSceneTracker& tracker, const py::object& poses) {
            const std::vector<NearestRow> rows = tracker.nearest(poses);
            return py::array_t<NearestRow>(static_cast<py::ssize_t>(rows.size()), rows.data());
          },
          py::arg("poses"),
          "The nearest pair at each of many states, as of Scene.poses_of_bodies at many joint positions. "
          "Beside what "
          "is tracked, which goes on.\n\n"
          "poses: of the bodies in the world, (n, b, 4, 4) or (n, b, 7), as of update\n"
          "Returns (n,) with the columns distance (metres; 0 where bodies overlap, NaN where no pair is "
          "within its "
          "cutoff), lower_bound (proven: no pair is nearer; NaN where a pose is not known), is_minimum (no "
          "pair can be "
          "nearer than distance), status (Status), body_a, body_b (places in Scene.body_names, -1: none), "
          "point_a "
          "(3), point_b (3), normal (3; in the world). Raises Error.")
      .def("restart", &PythonSceneTracker::restart, "Every pair starts cold in its next cycle.")
      .def_property_readonly("scene", &PythonSceneTracker::scene);
}

}  // namespace concave_distance::python

#include <pybind11/stl.h>

#include <cstdint>

#include "bindings.h"
#include "python_scene_tracker.h"

namespace concave_distance::python {

namespace py = pybind11;

void bindSceneTracker(py::module_& module) {
  py::class_<PythonSceneTracker>(
      module, "SceneTracker",
      "A scene over time: finds the near pairs and solves them in parallel. It may be used "
      "from any thread; calls wait for each other.")
      .def(py::init<ScenePointer, std::uint32_t>(), py::arg("scene"), py::arg("threads") = 0,
           "threads: that solve pairs; 0: one per core.")
      .def("update", &PythonSceneTracker::update, py::arg("poses"), py::arg("time"), py::kw_only(),
           py::arg("niches_wanted") = true,
           "One cycle.\n\n"
           "poses: of the bodies in the world, (b, 4, 4) or (b, 7) with x, y, z, qx, qy, qz, qw, metres; NaN "
           "where one is not known\n"
           "time: seconds, later than that of the last cycle\n"
           "Returns SceneAnswers with a row for each named pair and each pair that is near. Raises Error.")
      .def("restart", &PythonSceneTracker::restart, "Every pair starts cold in its next cycle.")
      .def_property_readonly("scene", &PythonSceneTracker::scene);
}

}  // namespace concave_distance::python

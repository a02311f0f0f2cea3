#include "base/versions.h"
#include "bindings.h"
#include "unlocked.h"

PYBIND11_MODULE(_concave_distance, module) {
  namespace py = pybind11;
  using namespace concave_distance::python;
  module.doc() = "What the package concave_distance gives its users; import that.";
  module.attr("__version__") = concave_distance::packageVersion();
  watchEndOfInterpreter();
  bindError(module);
  bindEnums(module);
  bindAnswers(module);
  bindBodies(module);
  bindPairs(module);
  bindScenes(module);
  bindSceneTracker(module);
  bindRows(module);
  bindClearanceResult(module);
  bindClearance(module);
  for (const auto& entry : py::dict(module.attr("__dict__"))) {
    if (PyType_Check(entry.second.ptr()) != 0) entry.second.attr("__module__") = "concave_distance";
  }
}

#include <exception>

#include "bindings.h"
#include "concave_distance/base/error.h"
#include "text.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

// It lives as long as the process, as all classes of an extension module.
PyObject* error_class = nullptr;

// pybind11 calls it with a copy. NOLINTNEXTLINE(performance-unnecessary-value-param)
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error& problem) {
    py::object error = py::handle(error_class)(toPython(inKeywords(problem.what())));
    error.attr("where") = toPython(problem.where());
    error.attr("what") = toPython(inKeywords(problem.whatIsWrong()));
    error.attr("remedy") = toPython(inKeywords(problem.remedy()));
    PyErr_SetObject(error_class, error.ptr());
  }
}

}  // namespace

void bindError(py::module& module) {
  error_class = PyErr_NewExceptionWithDoc(
      "concave_distance.Error",
      "The one exception of this package, raised by loading and for wrong arguments; a solve raises none.\n\n"
      "where: file, argument or element the problem was found in\n"
      "what: the problem, with the value seen\n"
      "remedy: what can be done about it",
      PyExc_RuntimeError, nullptr);
  if (error_class == nullptr) throw py::error_already_set();
  module.add_object("Error", py::handle(error_class));
  py::register_exception_translator(translate);
}

}  // namespace concave_distance::python

#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace concave_distance::python {

/// Returns a text for Python; bytes that are not UTF-8, as file names may have them, are replaced.
inline pybind11::str toPython(const std::string& text) {
  return pybind11::reinterpret_steal<pybind11::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

}  // namespace concave_distance::python

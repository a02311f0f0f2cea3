#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

namespace concave_distance::python {

/// Returns a text for Python; bytes that are not UTF-8, as file names may have them, are replaced.
inline pybind11::str toPython(const std::string& text) {
  return pybind11::reinterpret_steal<pybind11::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

/// Returns the bytes of a Python text, nothing where it has surrogates, which UTF-8 does not.
inline std::optional<std::string> toUtf8(pybind11::handle text) {
  Py_ssize_t size = 0;
  const char* bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
  if (bytes != nullptr) return std::string(bytes, static_cast<std::size_t>(size));
  PyErr_Clear();
  return std::nullopt;
}

}  // namespace concave_distance::python

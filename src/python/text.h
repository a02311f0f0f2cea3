#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <string_view>

namespace concave_distance::python {

/// Returns a text for Python; bytes that are not UTF-8, as file names may have them, are replaced.
inline pybind11::str toPython(const std::string& text) {
  return pybind11::reinterpret_steal<pybind11::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

/// Returns whether the tilde begins a parameter of the node, as in `~geometry` and `~limits/import_seconds`,
/// and no path, as in `~ann/robot.urdf`.
inline bool beginsParameter(std::string_view text, std::size_t tilde) {
  if (tilde > 0 && text[tilde - 1] != ' ' && text[tilde - 1] != '(') return false;
  const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", tilde + 1);
  if (end == tilde + 1 || tilde + 1 == text.size()) return false;
  return end == std::string_view::npos || text[end] != '/' || text.substr(tilde, end - tilde) == "~limits";
}

/// Returns a message of the library in Python's words: `~geometry`, a parameter of the node, is the keyword
/// `geometry`, and the folders of `~mesh_search_path` are `mesh_folders`.
inline std::string inKeywords(const std::string& message) {
  constexpr std::string_view kSearchPath = "~mesh_search_path";
  std::string text = message;
  for (std::size_t at = text.find(kSearchPath); at != std::string::npos; at = text.find(kSearchPath, at))
    text.replace(at, kSearchPath.size(), "mesh_folders");
  for (std::size_t at = text.find('~'); at != std::string::npos; at = text.find('~', at + 1)) {
    if (beginsParameter(text, at)) text.erase(at, 1);
  }
  return text;
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

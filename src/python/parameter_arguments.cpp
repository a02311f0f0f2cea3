#include "parameter_arguments.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "base/number_text.h"
#include "base/parameter.h"
#include "base/short_text.h"
#include "concave_distance/base/error.h"
#include "scene/pair_parameters.h"
#include "text.h"
#include "tracking/tracker_parameter_table.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

const ParameterTable<TrackerParameters>& parametersOfPair() {
  static const ParameterTable<TrackerParameters> table =
      joined<TrackerParameters>({trackerParameters(),
                                 marginParameters(),
                                 {flag<TrackerParameters>(
                                     "niches_wanted", [](auto& t) -> auto& { return t.niches_wanted; },
                                     "false: only the distance is computed")}});
  return table;
}

[[noreturn]] void refuse(const ParameterInfo& info, py::handle value, const std::string& where) {
  throw Error(where + "." + info.name, "the value is " + shortText(py::repr(value).cast<std::string>()),
              "allowed: " + allowedValues(info));
}

bool isWhole(py::handle value) {
  return PyIndex_Check(value.ptr()) != 0;
}

ParameterValue countOf(const ParameterInfo& info, py::handle value, const std::string& where) {
  const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  const unsigned long long count = whole ? PyLong_AsUnsignedLongLong(whole.ptr()) : 0;
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(info, value, where);
  }
  return std::uint64_t{count};
}

ParameterValue valueOf(const ParameterInfo& info, py::handle value, const std::string& where) {
  if (value.is_none() && info.type == ParameterType::Number && !info.word.empty()) return info.word;
  if (py::isinstance<py::str>(value)) {
    const std::optional<std::string> text = toUtf8(value);
    if (!text) refuse(info, value, where);
    return *text;
  }
  const bool is_flag = info.type == ParameterType::Flag;
  if (PyBool_Check(value.ptr()) != 0 || py::str(value.get_type().attr("__name__")).equal(py::str("bool_"))) {
    if (!is_flag) refuse(info, value, where);
    return value.cast<bool>();
  }
  if (info.type == ParameterType::Count && isWhole(value)) return countOf(info, value, where);
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(info, value, where);
  }
  if (info.type != ParameterType::Number) refuse(info, value, where);
  if (number > 0.0 && std::isinf(number) && info.word == "none") return info.word;
  return number;
}

py::object toPythonValue(const ParameterInfo& info, const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return py::float_(*number);
  if (const auto* count = std::get_if<std::uint64_t>(&value)) return py::int_(*count);
  if (const auto* is_set = std::get_if<bool>(&value)) return py::bool_(*is_set);
  const std::string text = toText(value);
  if (info.type == ParameterType::Number) return py::none();
  return py::str(text);
}

template <typename Owner>
void setAll(const py::kwargs& keywords, const ParameterTable<Owner>& table, const std::string& where,
            Owner& owner) {
  for (const auto& [key, value] : keywords) {
    const std::string name = toUtf8(key).value_or("?");
    const Parameter<Owner>* parameter = findParameter(table, name);
    if (parameter == nullptr) {
      std::vector<std::string> names;
      for (const auto& known : table) names.push_back(known.info.name);
      throw Error(where, "there is no parameter '" + name + "'", "there are: " + joinedText(names, ", "));
    }
    parameter->assign(owner, valueOf(parameter->info, value, where), where + ".");
  }
}

template <typename Owner>
py::list describeAll(const ParameterTable<Owner>& table) {
  const Owner defaults;
  py::list descriptions;
  for (const auto& parameter : table) {
    const ParameterInfo& info = parameter.info;
    py::dict one;
    one["name"] = info.name;
    one["unit"] = info.unit;
    one["default"] = toPythonValue(info, parameter.get(defaults));
    one["allowed"] = allowedValues(info);
    one["description"] = info.sentence;
    one["is_expert"] = info.is_expert;
    descriptions.append(one);
  }
  return descriptions;
}

}  // namespace

void setParameters(const py::kwargs& keywords, const std::string& where, TrackerParameters& parameters) {
  setAll(keywords, parametersOfPair(), where, parameters);
}

void setParameters(const py::kwargs& keywords, const std::string& where, PairSettings& settings) {
  setAll(keywords, pairParameters(), where, settings);
}

py::dict valuesOf(const TrackerParameters& parameters) {
  py::dict values;
  for (const auto& parameter : parametersOfPair())
    values[py::str(parameter.info.name)] = toPythonValue(parameter.info, parameter.get(parameters));
  return values;
}

py::list describeParameters(bool of_scene) {
  return of_scene ? describeAll(pairParameters()) : describeAll(parametersOfPair());
}

}  // namespace concave_distance::python

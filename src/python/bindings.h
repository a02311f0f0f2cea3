#pragma once

#include <pybind11/pybind11.h>

namespace concave_distance::python {

// Each puts its part of the C++ library into the Python module: thin, without geometry. Arrays come in as
// numpy has them and go out as structured arrays; the interpreter's lock is released while something is
// solved.

/// Translates Error to concave_distance.Error with `where`, `what` and `remedy`.
void bindError(pybind11::module& module);
/// The enumerations of answers, as IntEnum, so that numpy compares them with columns of codes.
void bindEnums(pybind11::module& module);
/// Answers and SceneAnswers.
void bindAnswers(pybind11::module& module);
/// BodyMesh and what makes one.
void bindBodies(pybind11::module& module);
/// PairTracker, solve_each, parameters. After bindBodies() and bindAnswers().
void bindPairs(pybind11::module& module);
/// Scene and what loads one.
void bindScenes(pybind11::module& module);
/// SceneTracker. After bindScenes() and bindAnswers().
void bindSceneTracker(pybind11::module& module);
/// ConstraintRows and Constraints. After bindSceneTracker().
void bindRows(pybind11::module& module);
/// Clearance. After bindAnswers().
void bindClearanceResult(pybind11::module& module);
/// find_clearance, find_clearance_of_body. After bindScenes() and bindClearanceResult().
void bindClearance(pybind11::module& module);

}  // namespace concave_distance::python

#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "concave_distance/base/not_computed.h"

namespace concave_distance::python {

using Triple = std::array<double, 3>;
inline constexpr Triple kUnknownPoint = {kNotComputed, kNotComputed, kNotComputed};

inline Triple tripleOf(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// Returns an array of the vector's elements, which have to live as long as `owner`.
template <typename Element>
pybind11::array_t<Element> viewOf(const std::vector<Element>& elements, const pybind11::object& owner) {
  return pybind11::array_t<Element>(static_cast<pybind11::ssize_t>(elements.size()), elements.data(), owner);
}

}  // namespace concave_distance::python

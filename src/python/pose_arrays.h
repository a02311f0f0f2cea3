#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace concave_distance::python {

using DoubleArray = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// A pose as an array has it.
struct GivenPose {
  /// NaN where the numbers are no pose: a quaternion that is not a unit one, a matrix with another last row.
  Eigen::Isometry3d pose;
  bool is_missing = false;  ///< every number of it is NaN
};

/// Reads numbers. @throws Error naming the argument when it is no array of real numbers
DoubleArray readNumbers(const pybind11::object& given, const std::string& where);

/// Returns an array's shape as numpy prints it.
std::string shapeOf(const pybind11::array& array);

/// Poses of an array.
struct GivenPoses {
  std::vector<GivenPose> poses;    ///< one after the other
  std::vector<std::size_t> shape;  ///< of the array, without the axes of a pose
};

/// Reads an array of poses: each (4, 4), a homogeneous matrix, or (7), x, y, z, qx, qy, qz, qw, metres; one
/// alone or in up to so many axes.
/// @throws Error naming the argument and its shape
GivenPoses readPoses(const pybind11::object& given, const std::string& where, std::size_t most_axes);
/// Reads one pose, or a list of them.
std::vector<GivenPose> readPoses(const pybind11::object& given, const std::string& where);

/// Writes a pose as 16 numbers, row by row.
void writeMatrix(const Eigen::Isometry3d& pose, double* numbers);

}  // namespace concave_distance::python

#include "pose_arrays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "concave_distance/base/error.h"
#include "concave_distance/base/not_computed.h"
#include "loading/query_poses.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

using RowMajorMatrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Eigen::Isometry3d noPose() {
  Eigen::Isometry3d pose;
  pose.matrix().setConstant(kNotComputed);
  return pose;
}

Eigen::Isometry3d poseOfMatrix(const double* numbers) {
  const Eigen::Map<const RowMajorMatrix> matrix(numbers);
  if (!(matrix.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))) return noPose();
  Eigen::Isometry3d pose;
  pose.matrix() = matrix;
  return pose;
}

Eigen::Isometry3d poseOfQuaternion(const double* v) {
  QueryPose pose;
  pose.position = {v[0], v[1], v[2]};
  pose.quaternion = {v[3], v[4], v[5], v[6]};
  return poseOf(pose).value_or(noPose());
}

}  // namespace

std::string shapeOf(const py::array& array) {
  return py::str(py::tuple(array.attr("shape"))).cast<std::string>();
}

DoubleArray readNumbers(const py::object& given, const std::string& where) {
  const py::array array = py::array::ensure(given);
  const std::string remedy = "give an array of real numbers";
  if (!array) throw Error(where, "is not an array", remedy);
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u')
    throw Error(where, "has elements of the type " + py::str(array.dtype()).cast<std::string>(), remedy);
  DoubleArray numbers = DoubleArray::ensure(array);
  if (!numbers) throw Error(where, "cannot be converted to numbers of double precision", remedy);
  return numbers;
}

GivenPoses readPoses(const py::object& given, const std::string& where, std::size_t most_axes) {
  const DoubleArray numbers = readNumbers(given, where);
  const py::ssize_t axes = numbers.ndim();
  const bool are_matrices = axes >= 2 && numbers.shape(axes - 1) == 4 && numbers.shape(axes - 2) == 4;
  const bool are_quaternions = !are_matrices && axes >= 1 && numbers.shape(axes - 1) == 7;
  const py::ssize_t axes_of_one = are_matrices ? 2 : 1;
  if ((!are_matrices && !are_quaternions) || axes > axes_of_one + static_cast<py::ssize_t>(most_axes))
    throw Error(where, "has the shape " + shapeOf(numbers),
                "give matrices, (..., 4, 4), or x, y, z, qx, qy, qz, qw, (..., 7), with at most " +
                    std::to_string(most_axes) + (most_axes == 1 ? " axis" : " axes") + " before");
  const std::size_t size = are_matrices ? 16 : 7;
  GivenPoses read;
  for (py::ssize_t axis = 0; axis < axes - axes_of_one; ++axis)
    read.shape.push_back(static_cast<std::size_t>(numbers.shape(axis)));
  read.poses.resize(static_cast<std::size_t>(numbers.size()) / size);
  const double* at = numbers.data();
  for (GivenPose& pose : read.poses) {
    pose.pose = are_matrices ? poseOfMatrix(at) : poseOfQuaternion(at);
    pose.is_missing = std::all_of(at, at + size, [](double v) { return std::isnan(v); });
    at += size;
  }
  return read;
}

std::vector<GivenPose> readPoses(const py::object& given, const std::string& where) {
  return readPoses(given, where, 1).poses;
}

void writeMatrix(const Eigen::Isometry3d& pose, double* numbers) {
  Eigen::Map<RowMajorMatrix> matrix(numbers);
  matrix = pose.matrix();
}

}  // namespace concave_distance::python

#include "fcl_model.h"

#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace concave_distance::demo {
namespace {

constexpr std::size_t kHeaderSize = 80;
constexpr std::size_t kTriangleSize = 50;
constexpr std::size_t kNormalSize = 12;

template <typename Value>
Value valueAt(const std::vector<char>& bytes, std::size_t offset) {
  Value value;
  std::memcpy(&value, bytes.data() + offset, sizeof(Value));
  return value;
}

}  // namespace

std::shared_ptr<const FclModel> loadFclModel(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (bytes.size() < kHeaderSize + sizeof(std::uint32_t)) throw std::runtime_error(path + ": too short");
  const auto count = valueAt<std::uint32_t>(bytes, kHeaderSize);
  const std::size_t start = kHeaderSize + sizeof(std::uint32_t);
  if (bytes.size() != start + count * kTriangleSize) throw std::runtime_error(path + ": no binary STL");
  std::vector<fcl::Vector3d> points;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t offset = start + t * kTriangleSize + kNormalSize + corner * 3 * sizeof(float);
      points.emplace_back(valueAt<float>(bytes, offset), valueAt<float>(bytes, offset + sizeof(float)),
                          valueAt<float>(bytes, offset + 2 * sizeof(float)));
    }
    triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
  }
  auto model = std::make_shared<FclModel>();
  model->beginModel();
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

double fclDistance(const FclModel& a, const Eigen::Isometry3d& a_pose, const FclModel& b,
                   const Eigen::Isometry3d& b_pose) {
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  // -1 is FCL's word for contact.
  return std::max(0.0, fcl::distance(&a, a_pose, &b, b_pose, request, result));
}

}  // namespace concave_distance::demo

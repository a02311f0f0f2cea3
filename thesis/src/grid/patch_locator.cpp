#include "patch_locator.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/surface/plane_geometry.h"

namespace concave_distance::detail {

PatchLocator::PatchLocator(const SurfaceMesh& surface, const PatchFrame& frame,
                           const std::vector<std::uint32_t>& triangles)
    : surface_(surface), frame_(frame), triangles_(triangles) {
  bins_ = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles.size()) / 4.0)));
  std::vector<Eigen::AlignedBox2d> boxes(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      boxes[i].extend(frame.project(surface.corner(TriangleIndex{triangles[i]}, k)));
    }
    box_.extend(boxes[i]);
  }
  members_.resize(bins_ * bins_);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t x = binOf(boxes[i].min().x(), 0); x <= binOf(boxes[i].max().x(), 0); ++x) {
      for (std::size_t y = binOf(boxes[i].min().y(), 1); y <= binOf(boxes[i].max().y(), 1); ++y) {
        members_[x * bins_ + y].push_back(triangles[i]);
      }
    }
  }
}

std::size_t PatchLocator::binOf(double coordinate, int axis) const {
  const double width = box_.sizes()[axis];
  const double bin = width > 0.0 ? (coordinate - box_.min()[axis]) / width * static_cast<double>(bins_) : 0.0;
  return std::min(bins_ - 1, static_cast<std::size_t>(std::max(0.0, bin)));
}

GridPoint PatchLocator::find(const Eigen::Vector2d& place) const {
  const std::vector<std::uint32_t>& bin = members_[binOf(place.x(), 0) * bins_ + binOf(place.y(), 1)];
  const std::vector<std::uint32_t>& candidates = bin.empty() ? triangles_ : bin;
  double best = -std::numeric_limits<double>::infinity();
  TriangleIndex home{candidates.front()};
  for (const std::uint32_t t : candidates) {
    const TriangleIndex triangle{t};
    const double height = leastHeight({frame_.project(surface_.corner(triangle, 0)),
                                       frame_.project(surface_.corner(triangle, 1)),
                                       frame_.project(surface_.corner(triangle, 2))},
                                      place)
                              .value;
    if (height > best) {
      best = height;
      home = triangle;
    }
  }
  // The place is kept; only the height over the patch's plane is the triangle's own there.
  const Eigen::Vector3d normal = frame_.first_axis.cross(frame_.second_axis).normalized();
  Eigen::Vector3d weight;
  Eigen::Vector3d height;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d next = frame_.project(surface_.corner(home, (k + 1) % 3));
    const Eigen::Vector2d last = frame_.project(surface_.corner(home, (k + 2) % 3));
    weight[k] = std::max(0.0, cross(next - place, last - place));
    height[k] = normal.dot(surface_.corner(home, k) - frame_.origin);
  }
  const double total = weight.sum();
  const double height_there =
      total > 0.0 ? weight.dot(height) / total : height[0];  // a triangle without area
  const Eigen::Vector3d position = frame_.origin + place.x() * frame_.first_axis +
                                   place.y() / frame_.second_axis.squaredNorm() * frame_.second_axis +
                                   height_there * normal;
  return {position, home};
}

}  // namespace concave_distance::detail

#pragma once

#include <fcl/math/bv/RSS.h>
#include <fcl/math/bv/utility.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/trees/oriented_box_fit.h"

/// Bounding volumes to compare hierarchies with. Each has an Item (one volume, in some frame) and Lanes (the
/// volumes of a node's W children, laid out lane by lane where the arithmetic can be done so).
namespace concave_distance::benchmark {

template <int W>
using LaneArray = Eigen::Array<double, W, 1>;

/// Lower bounds in metres, along a direction (unit, from the other volume towards the node; 0: none) and, as
/// long as that does not separate all by `enough`, by the volume itself.
template <detail::BoxAxes kAxes>
struct BoxVolume {
  using Item = OrientedBox;
  static Item fit(const detail::CornerRange& corners) { return detail::fitOrientedBox(corners, kAxes); }
  static double squaredSize(const Item& box) { return box.half.squaredNorm(); }
  static Item moved(const Item& box, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& shift) {
    return {rotation * box.centre + shift, rotation * box.axes, box.half};
  }

  template <int W>
  struct Lanes {
    LaneArray<W> centre[3];
    LaneArray<W> axes[3][3];  ///< [axis][coordinate]; the frame's own are not looked at
    LaneArray<W> half[3];

    void store(int lane, const Item& box) {
      for (int k = 0; k < 3; ++k) {
        centre[k][lane] = box.centre[k];
        half[k][lane] = box.half[k];
        for (int c = 0; c < 3; ++c) axes[k][c][lane] = box.axes(c, k);
      }
    }
    LaneArray<W> along(const Eigen::Vector3d& v, int axis) const {
      if constexpr (kAxes == detail::BoxAxes::Frame) return LaneArray<W>::Constant(v[axis]);
      return v.x() * axes[axis][0] + v.y() * axes[axis][1] + v.z() * axes[axis][2];
    }
    LaneArray<W> bounds(const Item& box, const Eigen::Vector3d& direction, double enough) const {
      const LaneArray<W> d[3] = {centre[0] - box.centre.x(), centre[1] - box.centre.y(),
                                 centre[2] - box.centre.z()};
      LaneArray<W> separation = direction.x() * d[0] + direction.y() * d[1] + direction.z() * d[2] -
                                (box.axes.transpose() * direction).cwiseAbs().dot(box.half);
      for (int k = 0; k < 3; ++k) separation -= half[k] * along(direction, k).abs();
      separation = separation.max(0.0);
      if (separation.minCoeff() >= enough) return separation;
      const LaneArray<W> squared_gap = d[0].square() + d[1].square() + d[2].square();
      LaneArray<W> along_centres = squared_gap;
      LaneArray<W> along_box[3];
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d axis = box.axes.col(k);
        const LaneArray<W> offset = (axis.x() * d[0] + axis.y() * d[1] + axis.z() * d[2]).abs();
        along_centres -= offset * box.half[k];
        along_box[k] = offset - box.half[k];
      }
      LaneArray<W> sum_node = LaneArray<W>::Zero();
      for (int i = 0; i < 3; ++i) {
        LaneArray<W> offset = d[i].abs();
        if constexpr (kAxes != detail::BoxAxes::Frame) {
          offset = (axes[i][0] * d[0] + axes[i][1] * d[1] + axes[i][2] * d[2]).abs();
        }
        along_centres -= offset * half[i];
        LaneArray<W> along_node = offset - half[i];
        for (int k = 0; k < 3; ++k) {
          const LaneArray<W> cosine = along(box.axes.col(k), i).abs();
          along_node -= cosine * box.half[k];
          along_box[k] -= cosine * half[i];
        }
        sum_node += along_node.max(0.0).square();
      }
      const LaneArray<W> sum_box =
          along_box[0].max(0.0).square() + along_box[1].max(0.0).square() + along_box[2].max(0.0).square();
      const LaneArray<W> sum_centres = along_centres.max(0.0).square() / squared_gap.max(0x1.0p-500);
      return separation.max(sum_node.max(sum_box).max(sum_centres).sqrt());
    }
  };
};

struct SphereVolume {
  struct Item {
    Eigen::Vector3d centre;
    double radius;
  };
  static Item fit(const detail::CornerRange& corners) {
    const OrientedBox box = detail::fitOrientedBox(corners);
    double radius = 0.0;
    for (const auto* corner = corners.begin; corner != corners.end; ++corner) {
      radius = std::max(radius, (*corner - box.centre).norm());
    }
    return {box.centre, radius};
  }
  static double squaredSize(const Item& sphere) { return sphere.radius * sphere.radius; }
  static Item moved(const Item& sphere, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& shift) {
    return {rotation * sphere.centre + shift, sphere.radius};
  }

  template <int W>
  struct Lanes {
    LaneArray<W> centre[3];
    LaneArray<W> radius;

    void store(int lane, const Item& sphere) {
      for (int k = 0; k < 3; ++k) centre[k][lane] = sphere.centre[k];
      radius[lane] = sphere.radius;
    }
    // No direction separates spheres by more than that of their centres.
    LaneArray<W> bounds(const Item& sphere, const Eigen::Vector3d& /*direction*/, double /*enough*/) const {
      const LaneArray<W> squared_gap = (centre[0] - sphere.centre.x()).square() +
                                       (centre[1] - sphere.centre.y()).square() +
                                       (centre[2] - sphere.centre.z()).square();
      return (squared_gap.sqrt() - radius - sphere.radius).max(0.0);
    }
  };
};

/// Rectangle swept by a sphere (RSS), with FCL's fit and FCL's distance of rectangles: one lane at a time.
struct SweptRectangleVolume {
  using Item = fcl::RSS<double>;
  static Item fit(const detail::CornerRange& corners) {
    std::vector<fcl::Vector3d> points(corners.begin, corners.end);
    Item rectangle;
    fcl::fit(points.data(), static_cast<int>(points.size()), rectangle);
    return rectangle;
  }
  static double squaredSize(const Item& rss) {
    return 0.25 * (rss.l[0] * rss.l[0] + rss.l[1] * rss.l[1]) + rss.r * rss.r;
  }
  static Item moved(const Item& rss, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& shift) {
    Item result = rss;
    result.axis = rotation * rss.axis;
    result.To = rotation * rss.To + shift;
    return result;
  }

  template <int W>
  struct Lanes {
    std::array<Item, W> items;
    void store(int lane, const Item& rss) { items[static_cast<std::size_t>(lane)] = rss; }
    static double reach(const Item& rss, const Eigen::Vector3d& u) {
      return u.dot(rss.To) + std::max(0.0, rss.l[0] * u.dot(rss.axis.col(0))) +
             std::max(0.0, rss.l[1] * u.dot(rss.axis.col(1))) + rss.r;
    }
    LaneArray<W> bounds(const Item& rss, const Eigen::Vector3d& direction, double enough) const {
      LaneArray<W> result;
      const double most = reach(rss, direction);
      for (int lane = 0; lane < W; ++lane) {
        const Item& item = items[static_cast<std::size_t>(lane)];
        const double separation = -reach(item, -direction) - most;
        if (separation >= enough) {
          result[lane] = separation;
          continue;
        }
        const Eigen::Matrix3d turned = rss.axis.transpose() * item.axis;
        const Eigen::Vector3d offset = rss.axis.transpose() * (item.To - rss.To);
        const double apart = fcl::rectDistance<double>(turned, offset, rss.l, item.l) - rss.r - item.r;
        result[lane] = std::max({0.0, separation, apart});
      }
      return result;
    }
  };
};

}  // namespace concave_distance::benchmark

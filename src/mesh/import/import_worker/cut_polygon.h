#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <vector>

namespace concave_distance::detail {

/// Cuts polygons, convex or concave, into triangles by clipping ears. Its buffers are kept between polygons.
///
/// The polygon is seen along the axis that is nearest to Newell's normal, where its coordinates are exact; if
/// it cannot be cut there, along the normal itself, where warped polygons are widest. Signs of areas are
/// exact. The triangles' areas seen in this direction add up to the polygon's area by Newell, whatever is
/// clipped in which order: each ear's area is subtracted from the rest. So if none is negative they cover the
/// polygon and nothing else, each place as often as the border winds round it. A negative triangle is allowed
/// only where its height in space is at most `thin`: rounding may have turned it over. A corner in the middle
/// of an edge becomes a corner of a triangle, so that no gap opens beside the polygon behind that edge.
class PolygonCutter {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// @param thin m
  explicit PolygonCutter(double thin) : thin_(thin) {}

  /// Appends at most `count` - 2 triangles with the polygon's winding. A hole may be joined to the border
  /// by an edge that is passed in both directions. Corners need not be in a plane: any cut of a warped
  /// polygon whose triangles face Newell's normal is as good as another, and any of four corners so warped
  /// that none has such. O(n log n + n r) for n corners, r of them reflex; several times that for polygons
  /// that touch themselves.
  /// @param corners `count` indices into `vertices`, at least 3
  /// @return false, with `triangles` as before, when the polygon crosses itself, seen along its normal
  bool cut(const std::vector<Eigen::Vector3d>& vertices, const std::uint32_t* corners, std::size_t count,
           std::vector<Triangle>& triangles);

 private:
  enum class Turn { Left, Straight, Right };

  struct Corner {
    Eigen::Vector3d seen = Eigen::Vector3d::Zero();  ///< x and y: seen in the direction of the cut; z is 0
    Eigen::Vector3d in_space = Eigen::Vector3d::Zero();  ///< metres
    std::uint32_t vertex = 0;
    std::uint32_t previous = 0;
    std::uint32_t next = 0;
    std::uint32_t version = 0;  ///< changes with its neighbours
    Turn turn = Turn::Left;
    bool is_clipped = false;
  };

  struct Ear {
    double shape;  ///< height over longest edge, the larger the better
    std::uint32_t corner;
    std::uint32_t version;
    bool operator<(const Ear& other) const {
      return shape != other.shape ? shape < other.shape : corner > other.corner;
    }
  };

  void readCorners(const std::vector<Eigen::Vector3d>& vertices, const std::uint32_t* corners,
                   std::size_t count);
  void link();
  Eigen::Vector3d newellNormal() const;
  void seeAlongAxisNearest(const Eigen::Vector3d& normal);
  void seeAlong(const Eigen::Vector3d& normal);
  bool clipAll(std::vector<Triangle>& triangles);
  void pushIfEar(std::uint32_t corner);
  void findEars();
  bool turnsBack(std::uint32_t corner) const;
  bool clipWithoutEar(std::vector<Triangle>& triangles);
  void clip(std::uint32_t corner, std::vector<Triangle>& triangles);
  void judge(std::uint32_t corner);
  bool isClear(std::uint32_t corner) const;
  bool isIn(const Corner& other, std::uint32_t corner) const;
  bool entersAt(const Corner& other, const Corner& before, const Corner& at, const Corner& after) const;
  double shapeOf(std::uint32_t corner) const;
  bool isThin(std::uint32_t corner) const;
  bool isSkewQuad() const;
  void cutSkewQuad(std::vector<Triangle>& triangles);

  std::vector<Corner> corners_;
  std::vector<std::uint32_t> obstacles_;  ///< corners that do not turn left, and some that did not
  std::priority_queue<Ear> ears_;
  std::size_t left_ = 0;
  double thin_;
};

}  // namespace concave_distance::detail

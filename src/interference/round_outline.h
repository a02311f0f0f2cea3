#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "distance/kernels/round_kernels.h"

namespace concave_distance::detail {

/// Returns the lowest point of a triangle's edge: the same whichever way the edge runs, so that the triangles
/// on both of its sides agree on where it enters a solid.
LowestPoint lowestOnEdge(const RoundShape& shape, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The border of the part of a triangle inside a round solid, which is convex: straight pieces of the
/// triangle's edges and arcs of the solid's surface between them, counterclockwise. Shape's frame.
class RoundOutline {
 public:
  struct Straight {
    Eigen::Vector3d from;
    Eigen::Vector3d to;
  };
  /// An arc lies on one smooth piece of the solid's surface.
  struct Arc {
    double from;  ///< angle as seen from the centre, radians
    double to;    ///< at most 2 pi more
    Eigen::Vector3d start;
    Eigen::Vector3d end;
  };
  template <typename Part, std::size_t capacity>
  class List {
   public:
    void clear() { count_ = 0; }
    void push_back(const Part& part) {
      if (count_ < capacity) parts_[count_++] = part;
    }
    bool empty() const { return count_ == 0; }
    std::size_t size() const { return count_; }
    const Part& operator[](std::size_t index) const { return parts_[index]; }
    const Part* begin() const { return parts_.data(); }
    const Part* end() const { return parts_.data() + count_; }

   private:
    std::array<Part, capacity> parts_;
    std::size_t count_ = 0;
  };
  using Straights = List<Straight, 3>;
  using Arcs = List<Arc, 16>;

  /// @param normal of the triangle, unit
  /// @param centre a point of the part, on the border at most
  void find(const RoundShape& shape, const TrianglePoints& triangle, const Eigen::Vector3d& normal,
            const Eigen::Vector3d& centre);

  const Straights& straights() const { return straights_; }
  const Arcs& arcs() const { return arcs_; }
  const Eigen::Vector3d& centre() const { return centre_; }
  const Eigen::Vector3d& normal() const { return normal_; }
  const RoundShape& shape() const { return *shape_; }

  /// Returns where the solid ends, or the triangle, in a direction from the centre.
  Eigen::Vector3d towards(const Eigen::Vector3d& direction) const;
  Eigen::Vector3d border(double angle) const;

 private:
  void findStraights();
  void findArcs();
  void addArc(double from, double width, const Eigen::Vector3d& start, const Eigen::Vector3d& end);
  void findBends(double from, double width);
  double angleOf(const Eigen::Vector3d& point) const;
  double angleBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  double edgeWay(const Eigen::Vector3d& direction) const;

  const RoundShape* shape_ = nullptr;
  TrianglePoints triangle_;
  Eigen::Vector3d centre_;
  Eigen::Vector3d normal_;
  Eigen::Vector3d axis_u_;
  Eigen::Vector3d axis_v_;
  Straights straights_;
  Arcs arcs_;
  std::array<double, 4> bends_;
  std::size_t bend_count_ = 0;
};

}  // namespace concave_distance::detail

#include "cut_polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/exact_orientation.h"

namespace concave_distance::detail {
namespace {

/// Exact: 1 where r lies to the left of the line from p to q, 0 on it.
int sideOf(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r) {
  // All have z = 0: the tetrahedron over p has the sign of the triangle.
  return orientationSign(p, q, r, p + Eigen::Vector3d::UnitZ());
}

double longestEdge(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
}

double doubleArea(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b - a).cross(c - a).norm();
}

}  // namespace

/// Passes over corners at the place of the one before.
void PolygonCutter::readCorners(const std::vector<Eigen::Vector3d>& vertices, const std::uint32_t* corners,
                                std::size_t count) {
  corners_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d& place = vertices[corners[i]];
    if (!corners_.empty() && corners_.back().in_space == place) continue;
    Corner corner;
    corner.in_space = place;
    corner.vertex = corners[i];
    corners_.push_back(corner);
  }
  while (corners_.size() > 1 && corners_.back().in_space == corners_.front().in_space) corners_.pop_back();
}

void PolygonCutter::link() {
  const auto count = static_cast<std::uint32_t>(corners_.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    corners_[i].previous = i == 0 ? count - 1 : i - 1;
    corners_[i].next = i + 1 == count ? 0 : i + 1;
    corners_[i].version = 0;
    corners_[i].is_clipped = false;
  }
  left_ = count;
}

/// Twice the polygon's area vector (Newell), about its first corner.
Eigen::Vector3d PolygonCutter::newellNormal() const {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = corners_.front().in_space;
  for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
    normal += (corners_[i].in_space - origin).cross(corners_[i + 1].in_space - origin);
  }
  return normal;
}

void PolygonCutter::seeAlongAxisNearest(const Eigen::Vector3d& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const Eigen::Index x = normal[axis] < 0.0 ? (axis + 2) % 3 : (axis + 1) % 3;
  const Eigen::Index y = 3 - axis - x;
  for (Corner& corner : corners_) corner.seen = {corner.in_space[x], corner.in_space[y], 0.0};
}

void PolygonCutter::seeAlong(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d n = normal.stableNormalized();
  const Eigen::Vector3d x = n.unitOrthogonal();
  const Eigen::Vector3d y = n.cross(x);
  const Eigen::Vector3d origin = corners_.front().in_space;
  for (Corner& corner : corners_) {
    corner.seen = {x.dot(corner.in_space - origin), y.dot(corner.in_space - origin), 0.0};
  }
}

double PolygonCutter::shapeOf(std::uint32_t corner) const {
  const Eigen::Vector3d& a = corners_[corners_[corner].previous].in_space;
  const Eigen::Vector3d& b = corners_[corner].in_space;
  const Eigen::Vector3d& c = corners_[corners_[corner].next].in_space;
  const double longest = longestEdge(a, b, c);
  return longest > 0.0 ? doubleArea(a, b, c) / (longest * longest) : 0.0;
}

bool PolygonCutter::isThin(std::uint32_t corner) const {
  const Eigen::Vector3d& a = corners_[corners_[corner].previous].in_space;
  const Eigen::Vector3d& b = corners_[corner].in_space;
  const Eigen::Vector3d& c = corners_[corners_[corner].next].in_space;
  return doubleArea(a, b, c) <= thin_ * longestEdge(a, b, c);
}

/// Whether an edge of `other`, which is at the place of `at`, runs into the triangle of `at`
/// and its neighbours.
bool PolygonCutter::entersAt(const Corner& other, const Corner& before, const Corner& at,
                             const Corner& after) const {
  for (const std::uint32_t end : {other.previous, other.next}) {
    const Eigen::Vector3d& place = corners_[end].seen;
    if (sideOf(at.seen, after.seen, place) > 0 && sideOf(before.seen, at.seen, place) > 0) return true;
  }
  return false;
}

/// Whether `other` prevents that the ear is clipped: it lies in the closed triangle, or at a corner of it and
/// one of its edges runs into the triangle.
bool PolygonCutter::isIn(const Corner& other, std::uint32_t corner) const {
  const Corner& b = corners_[corner];
  const Corner& a = corners_[b.previous];
  const Corner& c = corners_[b.next];
  if (&other == &a || &other == &b || &other == &c) return false;
  const auto low = a.seen.cwiseMin(b.seen).cwiseMin(c.seen);
  const auto high = a.seen.cwiseMax(b.seen).cwiseMax(c.seen);
  if ((other.seen.array() < low.array()).any() || (other.seen.array() > high.array()).any()) return false;
  if (other.seen == a.seen) return entersAt(other, c, a, b);
  if (other.seen == b.seen) return entersAt(other, a, b, c);
  if (other.seen == c.seen) return entersAt(other, b, c, a);
  return sideOf(a.seen, b.seen, other.seen) >= 0 && sideOf(b.seen, c.seen, other.seen) >= 0 &&
         sideOf(c.seen, a.seen, other.seen) >= 0;
}

/// What runs into an ear has a corner there that does not turn left.
bool PolygonCutter::isClear(std::uint32_t corner) const {
  return std::none_of(obstacles_.begin(), obstacles_.end(), [&](std::uint32_t other) {
    return !corners_[other].is_clipped && corners_[other].turn != Turn::Left && isIn(corners_[other], corner);
  });
}

void PolygonCutter::judge(std::uint32_t corner) {
  Corner& b = corners_[corner];
  const int side = sideOf(corners_[b.previous].seen, b.seen, corners_[b.next].seen);
  const Turn turn = side > 0 ? Turn::Left : side < 0 ? Turn::Right : Turn::Straight;
  if (turn != Turn::Left && b.turn == Turn::Left) obstacles_.push_back(corner);
  b.turn = turn;
}

void PolygonCutter::clip(std::uint32_t corner, std::vector<Triangle>& triangles) {
  Corner& b = corners_[corner];
  triangles.push_back({corners_[b.previous].vertex, b.vertex, corners_[b.next].vertex});
  b.is_clipped = true;
  corners_[b.previous].next = b.next;
  corners_[b.next].previous = b.previous;
  --left_;
  if (left_ < 3) return;
  for (const std::uint32_t neighbour : {b.previous, b.next}) {
    judge(neighbour);
    ++corners_[neighbour].version;
  }
  for (const std::uint32_t neighbour : {b.previous, b.next}) pushIfEar(neighbour);
}

/// Whether the border turns back at the corner, so that the corner ends a spike.
bool PolygonCutter::turnsBack(std::uint32_t corner) const {
  const Corner& b = corners_[corner];
  return (corners_[b.previous].in_space - b.in_space).dot(corners_[b.next].in_space - b.in_space) >= 0.0;
}

/// Spikes without any width come first: clipping one changes nothing, and an ear beside it could swallow it.
void PolygonCutter::pushIfEar(std::uint32_t corner) {
  const Corner& b = corners_[corner];
  if (b.is_clipped) return;
  if (b.turn == Turn::Straight && turnsBack(corner) && isThin(corner)) {
    ears_.push({std::numeric_limits<double>::infinity(), corner, b.version});
  } else if (b.turn == Turn::Left && isClear(corner)) {
    ears_.push({shapeOf(corner), corner, b.version});
  }
}

void PolygonCutter::findEars() {
  for (std::uint32_t i = 0; i < corners_.size(); ++i) pushIfEar(i);
}

/// Comes where a border that touches itself up to rounding leaves no clear ear: clips the thinnest spike,
/// else the best of the left turns, else the thinnest corner. False when there is none of these.
bool PolygonCutter::clipWithoutEar(std::vector<Triangle>& triangles) {
  Ear best{-1.0, 0, 0};
  for (int choice = 0; choice < 3 && best.shape < 0.0; ++choice) {
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i].is_clipped) continue;
      const bool fits =
          choice == 1 ? corners_[i].turn == Turn::Left : isThin(i) && (choice == 2 || turnsBack(i));
      const double shape = shapeOf(i);
      if (fits) best = std::max(best, Ear{choice == 1 ? shape : 1.0 / (1.0 + shape), i, 0});
    }
  }
  if (best.shape < 0.0) return false;
  clip(best.corner, triangles);
  return true;
}

bool PolygonCutter::clipAll(std::vector<Triangle>& triangles) {
  link();
  obstacles_.clear();
  ears_ = {};
  for (Corner& corner : corners_) corner.turn = Turn::Left;
  for (std::uint32_t i = 0; i < corners_.size(); ++i) judge(i);
  findEars();
  while (left_ >= 3) {
    if (ears_.empty()) {
      if (!clipWithoutEar(triangles)) return false;
      findEars();
      continue;
    }
    const Ear ear = ears_.top();
    ears_.pop();
    const Corner& corner = corners_[ear.corner];
    if (!corner.is_clipped && corner.version == ear.version) clip(ear.corner, triangles);
  }
  return true;
}

/// True for four corners that are not in a plane: no two of their edges meet, seen along any axis.
bool PolygonCutter::isSkewQuad() const {
  if (corners_.size() != 4) return false;
  double largest_face = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    largest_face = std::max(largest_face, doubleArea(corners_[i].in_space, corners_[(i + 1) % 4].in_space,
                                                     corners_[(i + 2) % 4].in_space));
  }
  const Eigen::Vector3d& a = corners_[0].in_space;
  const double volume =
      (corners_[1].in_space - a).cross(corners_[2].in_space - a).dot(corners_[3].in_space - a);
  return std::abs(volume) > thin_ * largest_face;
}

/// Cuts along the diagonal whose worse triangle is the better one.
void PolygonCutter::cutSkewQuad(std::vector<Triangle>& triangles) {
  link();
  const bool from_first = std::min(shapeOf(1), shapeOf(3)) >= std::min(shapeOf(0), shapeOf(2));
  clip(from_first ? 1 : 0, triangles);
  clip(from_first ? 3 : 2, triangles);
}

bool PolygonCutter::cut(const std::vector<Eigen::Vector3d>& vertices, const std::uint32_t* corners,
                        std::size_t count, std::vector<Triangle>& triangles) {
  readCorners(vertices, corners, count);
  const Eigen::Vector3d normal = newellNormal();
  const std::size_t before = triangles.size();
  for (const bool along_axis : {true, false}) {
    if (along_axis) {
      seeAlongAxisNearest(normal);
    } else {
      seeAlong(normal);
    }
    if (clipAll(triangles)) return true;
    triangles.resize(before);
  }
  if (!isSkewQuad()) return false;
  cutSkewQuad(triangles);
  return true;
}

}  // namespace concave_distance::detail

#include "fuzz/niche_enumeration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "support/wide_overlap.h"

namespace concave_distance::test {
namespace {

constexpr long double kInfinity = std::numeric_limits<long double>::infinity();
/// Of the segment's ends, as a fraction of the size of the bodies: a triangle this near to an end does not
/// decide whether the segment is free.
constexpr long double kEnd = 8e-12L;
/// Up to the first, relative to its diameter, a solid counts as convex, beyond the second as concave.
constexpr long double kConvex = 1e-13L;
constexpr long double kBarelyConcave = 1e-10L;

WidePoint movedPoint(const Eigen::Isometry3d& pose, const WidePoint& p) {
  const auto row = [&](int i) {
    return pose(i, 0) * p.x + pose(i, 1) * p.y + pose(i, 2) * p.z + static_cast<long double>(pose(i, 3));
  };
  return {row(0), row(1), row(2)};
}

WideTriangle movedTriangle(const Eigen::Isometry3d& pose, const WideTriangle& t) {
  return {movedPoint(pose, t[0]), movedPoint(pose, t[1]), movedPoint(pose, t[2])};
}

long double distanceOfTriangles(const WideTriangle& l, const WideTriangle& r) {
  return std::sqrt(exactSquaredDistance(l, r));
}

}  // namespace

NicheEnumeration::NicheEnumeration(const WideBody& a, const WideBody& b, const Eigen::Isometry3d& a_from_b)
    : a_(a), b_(b), pose_(a_from_b), count_b_(b.triangles().size()), triangles_a_(a.triangles()) {
  for (const WideTriangle& t : b.triangles()) triangles_b_.push_back(movedTriangle(a_from_b, t));
  long double farthest = 0.0L;
  for (std::size_t i = 0; i < triangles_a_.size(); ++i) {
    for (std::size_t j = 0; j < count_b_; ++j) {
      const bool is_surface = a.isSurface(i) && b.isSurface(j);
      distance_.push_back(is_surface ? distanceOfTriangles(triangles_a_[i], triangles_b_[j]) : kInfinity);
      if (is_surface) farthest = std::max(farthest, distance_.back());
    }
  }
  least_ = *std::min_element(distance_.begin(), distance_.end());
  const long double extent = a.diameter() + b.diameter() + farthest;
  const long double reach = a.reach() + b.reach() + a_from_b.translation().norm();
  tolerance_ = std::ldexp(extent, -43) + std::ldexp(reach, -45);
  size_ = a.diameter() + b.diameter() + reach;
  measurePasses();
}

void NicheEnumeration::measurePasses() {
  const auto join = [&](std::size_t l, std::size_t r, const std::vector<WideTriangle>& shared,
                        const WideTriangle& other) {
    if (!std::isfinite(distance_[l]) || !std::isfinite(distance_[r])) return;
    long double level = kInfinity;
    for (const WideTriangle& part : shared) level = std::min(level, distanceOfTriangles(part, other));
    passes_.push_back({std::max({level, distance_[l], distance_[r]}), l, r});
  };
  for (const WideBody::Joint& joint : a_.shellContacts()) {
    for (std::size_t j = 0; j < count_b_; ++j) {
      join(cellOf(joint.l, j), cellOf(joint.r, j), joint.shared, triangles_b_[j]);
    }
  }
  for (const WideBody::Joint& joint : b_.shellContacts()) {
    std::vector<WideTriangle> shared;
    for (const WideTriangle& part : joint.shared) shared.push_back(movedTriangle(pose_, part));
    for (std::size_t i = 0; i < triangles_a_.size(); ++i) {
      join(cellOf(i, joint.l), cellOf(i, joint.r), shared, triangles_a_[i]);
    }
  }
  joinOverlap();
  std::sort(passes_.begin(), passes_.end(), [](const Pass& l, const Pass& r) { return l.level < r.level; });
  passes_of_.resize(distance_.size());
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    passes_of_[passes_[i].l].push_back(i);
    passes_of_[passes_[i].r].push_back(i);
  }
}

/// Joins places where the surfaces meet in one part of the overlap.
void NicheEnumeration::joinOverlap() {
  const long double highest =
      std::max(a_.highestOverPlane() / a_.diameter(), b_.highestOverPlane() / b_.diameter());
  is_overlap_clear_ = highest <= kConvex || highest > kBarelyConcave;
  if (!is_overlap_clear_) return;
  WideSurface surface_a{triangles_a_, {}};
  WideSurface surface_b{triangles_b_, {}};
  for (std::size_t t = 0; t < triangles_a_.size(); ++t) surface_a.is_closed.push_back(a_.isOnClosedShell(t));
  for (std::size_t t = 0; t < triangles_b_.size(); ++t) surface_b.is_closed.push_back(b_.isOnClosedShell(t));
  const std::vector<int> parts = overlapPartsOfPairs(surface_a, surface_b, tolerance_);
  std::map<int, std::size_t> first_of_part;
  for (std::size_t i = 0; i < distance_.size(); ++i) {
    if (parts[i] < 0 || distance_[i] > tolerance_) continue;
    const std::size_t first = first_of_part.emplace(parts[i], i).first->second;
    passes_.push_back({std::max(distance_[first], distance_[i]), first, i});
  }
}

std::vector<EnumeratedNiche> NicheEnumeration::niches(double least_prominence, double margin) const {
  std::vector<std::size_t> parent(distance_.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  // For each root, the deepest cell of its component, this lists the others that are as deep up to rounding.
  std::vector<std::vector<std::size_t>> equals(distance_.size());
  std::vector<EnumeratedNiche> found;
  const auto report = [&](std::size_t cell, long double pass, bool is_certain, bool is_tied) {
    found.push_back({distance_[cell], pass, is_certain, is_tied || !equals[cell].empty(), {cell}});
    for (const std::size_t other : equals[cell]) found.back().cells.push_back(other);
  };
  const long double rounding = 2.0L * tolerance_;
  for (const Pass& pass : passes_) {
    std::size_t deep = root(pass.l);
    std::size_t shallow = root(pass.r);
    if (deep == shallow) continue;
    if (distance_[shallow] < distance_[deep]) std::swap(shallow, deep);
    parent[shallow] = deep;
    const long double own = distance_[shallow];
    const bool is_tied = own <= distance_[deep] + rounding;
    const long double prominent =
        margin + (1.0L + least_prominence) * std::max<long double>(0.0L, own - margin);
    const long double wanted =
        own > tolerance_ || margin > 0.0 ? std::max(own + tolerance_, prominent) : own + tolerance_;
    const bool may_be_listed = pass.level > wanted - rounding && pass.level > own + 0.25L * tolerance_;
    const bool is_certain = pass.level > wanted + rounding && (is_overlap_clear_ || own > tolerance_);
    if (may_be_listed) report(shallow, pass.level, is_certain, is_tied);
    if (!is_certain && is_tied) {
      equals[deep].push_back(shallow);
      equals[deep].insert(equals[deep].end(), equals[shallow].begin(), equals[shallow].end());
    }
  }
  for (std::size_t i = 0; i < distance_.size(); ++i) {
    if (root(i) == i && std::isfinite(distance_[i])) report(i, kInfinity, true, false);
  }
  std::sort(found.begin(), found.end(),
            [](const EnumeratedNiche& l, const EnumeratedNiche& r) { return l.distance < r.distance; });
  for (EnumeratedNiche& niche : found) spread(niche);
  return found;
}

/// From the cells of its minima to all that are level with them.
void NicheEnumeration::spread(EnumeratedNiche& niche) const {
  const long double level = niche.distance + 2.0L * tolerance_;
  const std::vector<std::size_t> bottoms = niche.cells;
  niche.cells.clear();
  for (const std::size_t cell : bottoms) {
    if (distance_[cell] <= level) appendPlateau(cell, level, niche.cells);
  }
  std::sort(niche.cells.begin(), niche.cells.end());
  niche.cells.erase(std::unique(niche.cells.begin(), niche.cells.end()), niche.cells.end());
}

void NicheEnumeration::appendPlateau(std::size_t cell, long double level,
                                     std::vector<std::size_t>& cells) const {
  std::vector<std::size_t> open{cell};
  std::vector<bool> seen(distance_.size(), false);
  seen[cell] = true;
  while (!open.empty()) {
    const std::size_t here = open.back();
    open.pop_back();
    cells.push_back(here);
    for (const std::size_t i : passes_of_[here]) {
      const Pass& pass = passes_[i];
      const std::size_t next = pass.l == here ? pass.r : pass.l;
      if (pass.level > level || seen[next]) continue;
      seen[next] = true;
      open.push_back(next);
    }
  }
}

long double NicheEnumeration::distanceWithinMaterial(std::size_t cell) const {
  return distanceOfTriangles(triangles_a_[cell / count_b_], triangles_b_[cell % count_b_]);
}

long double NicheEnumeration::offTriangles(std::size_t cell, const WitnessPoints& points) const {
  const WideTriangle& a = triangles_a_[cell / count_b_];
  const WideTriangle& b = triangles_b_[cell % count_b_];
  return std::max(length(closestOnTriangle(points.a, a) - points.a),
                  length(closestOnTriangle(points.b, b) - points.b));
}

std::vector<WitnessPoints> NicheEnumeration::minimisers(std::size_t cell) const {
  const WideTriangle& a = triangles_a_[cell / count_b_];
  const WideTriangle& b = triangles_b_[cell % count_b_];
  const long double most = distance_[cell] + 0.25L * tolerance_;
  std::vector<WitnessPoints> found;
  const auto add = [&](const WidePoint& on_a, const WidePoint& on_b) {
    if (length(on_b - on_a) <= most) found.push_back({on_a, on_b});
  };
  for (std::size_t i = 0; i < 3; ++i) {
    add(a[i], closestOnTriangle(a[i], b));
    add(closestOnTriangle(b[i], a), b[i]);
    for (std::size_t j = 0; j < 3; ++j) {
      const WidePoint u = a[(i + 1) % 3] - a[i];
      const WidePoint v = b[(j + 1) % 3] - b[j];
      const WidePoint w = b[j] - a[i];
      const WidePoint normal = u.cross(v);
      const long double squared = normal.squaredNorm();
      if (!(squared > 0.0L)) continue;
      const long double s = w.cross(v).dot(normal) / squared;
      const long double t = w.cross(u).dot(normal) / squared;
      if (s >= 0.0L && s <= 1.0L && t >= 0.0L && t <= 1.0L) add(a[i] + u * s, b[j] + v * t);
    }
  }
  if (found.empty()) return found;  // the triangles cross: an edge of one runs through the other
  WitnessPoints mean{{0.0L, 0.0L, 0.0L}, {0.0L, 0.0L, 0.0L}};
  for (const WitnessPoints& points : found) mean = {mean.a + points.a, mean.b + points.b};
  const long double share = 1.0L / static_cast<long double>(found.size());
  found.push_back({mean.a * share, mean.b * share});
  return found;
}

Clarity NicheEnumeration::isVisible(const WitnessPoints& points) const {
  const WidePoint along = points.b - points.a;
  const long double distance = length(along);
  if (distance <= 4.0L * kEnd * size_) return Clarity::Unclear;
  const WidePoint from = points.a + along * (kEnd * size_ / distance);
  const WidePoint to = points.b - along * (kEnd * size_ / distance);
  Clarity result = Clarity::Yes;
  const auto look = [&](const WideTriangle& t) {
    if (distanceOfTriangles({from, to, to}, t) > 0.5L * kEnd * size_) return;
    const WidePoint normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const long double twice_area = length(normal);
    const long double before = normal.dot(from - t[0]);
    const long double after = normal.dot(to - t[0]);
    const long double least = 0.25L * kEnd * size_ * twice_area;
    bool crosses = before * after < 0.0L && std::min(std::abs(before), std::abs(after)) > least;
    if (crosses) {
      const WidePoint at = from + (to - from) * (before / (before - after));
      for (std::size_t k = 0; k < 3; ++k) {
        const WidePoint edge = t[(k + 1) % 3] - t[k];
        crosses =
            crosses && edge.cross(at - t[k]).dot(normal) > 0.5L * kEnd * size_ * length(edge) * twice_area;
      }
    }
    result = crosses ? Clarity::No : Clarity::Unclear;
  };
  for (const auto* triangles : {&triangles_a_, &triangles_b_}) {
    for (const WideTriangle& t : *triangles) {
      look(t);
      if (result == Clarity::No) return result;
    }
  }
  return result;
}

// The winding number in the middle of the segment's first free piece: what lies at its start.
Clarity NicheEnumeration::leaves(const WideBody& body, const WidePoint& from, const WidePoint& to,
                                 bool is_of_b) const {
  const WidePoint along = to - from;
  const long double distance = length(along);
  const long double end = kEnd * size_;
  if (distance <= 4.0L * end) return Clarity::Unclear;
  long double first = distance;
  for (const WideTriangle& t : is_of_b ? triangles_b_ : triangles_a_) {
    const WidePoint normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const long double here = normal.dot(from - t[0]);
    const long double there = normal.dot(to - t[0]);
    if (here == there) continue;
    const long double at = here / (here - there) * distance;
    if (at < end || at > first) continue;
    const WidePoint point = from + along * (at / distance);
    if (length(closestOnTriangle(point, t) - point) <= end) first = at;
  }
  if (first <= 8.0L * end) return Clarity::Unclear;
  const WidePoint middle = from + along * (0.5L * first / distance);
  const long double winding = body.winding(is_of_b ? movedBack(middle) : middle);
  if (std::abs(winding - std::round(winding)) > 0.01L) return Clarity::Unclear;
  return winding > 0.5L ? Clarity::No : Clarity::Yes;
}

Clarity NicheEnumeration::isOutward(const WitnessPoints& points) const {
  const Clarity of_a = leaves(a_, points.a, points.b, false);
  if (of_a == Clarity::No) return of_a;
  const Clarity of_b = leaves(b_, points.b, points.a, true);
  return of_b == Clarity::Yes ? of_a : of_b;
}

}  // namespace concave_distance::test

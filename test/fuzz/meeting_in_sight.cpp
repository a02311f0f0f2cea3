#include "fuzz/niche_enumeration.h"

namespace concave_distance::test {
namespace {

/// Where edges of one triangle run through the other one.
std::vector<WidePoint> crossingPoints(const WideTriangle& l, const WideTriangle& r) {
  std::vector<WidePoint> points;
  const auto add = [&](const WideTriangle& edges, const WideTriangle& face) {
    const WidePoint normal = (face[1] - face[0]).cross(face[2] - face[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      const WidePoint along = edges[(k + 1) % 3] - edges[k];
      const long double here = normal.dot(edges[k] - face[0]);
      const long double there = here + normal.dot(along);
      if (!(here * there < 0.0L)) continue;
      const WidePoint at = edges[k] + along * (here / (here - there));
      if (exactlyInside(at, face, normal)) points.push_back(at);
    }
  };
  add(l, r);
  add(r, l);
  return points;
}

}  // namespace

WidePoint NicheEnumeration::movedBack(const WidePoint& p) const {
  const WidePoint v{p.x - pose_(0, 3), p.y - pose_(1, 3), p.z - pose_(2, 3)};
  const auto row = [&](int i) { return pose_(0, i) * v.x + pose_(1, i) * v.y + pose_(2, i) * v.z; };
  return {row(0), row(1), row(2)};
}

Clarity NicheEnumeration::isMeetingInSight(const EnumeratedNiche& niche) const {
  constexpr int kSamples = 24;
  const long double step_off = 1e-6L * size_;
  for (const std::size_t cell : niche.cells) {
    const WideTriangle& a = triangles_a_[cell / count_b_];
    const WideTriangle& b = triangles_b_[cell % count_b_];
    const std::vector<WidePoint> ends = crossingPoints(a, b);
    if (ends.size() < 2) continue;
    const auto outside = [&](const WidePoint& at, const WideTriangle& t) {
      const WidePoint normal = (t[1] - t[0]).cross(t[2] - t[0]);
      return at + normal * (step_off / length(normal));
    };
    for (int k = 0; k < kSamples; ++k) {
      const WidePoint at = ends[0] + (ends[1] - ends[0]) * ((k + 0.5L) / kSamples);
      if (a_.winding(outside(at, a)) < 0.25L && b_.winding(movedBack(outside(at, b))) < 0.25L) {
        return Clarity::Yes;
      }
    }
  }
  return Clarity::No;
}

}  // namespace concave_distance::test

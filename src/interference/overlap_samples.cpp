#include "overlap_samples.h"

#include <algorithm>
#include <cmath>

#include "base/triangle_measures.h"

namespace concave_distance {
namespace {

// A facet of less than this share of the region's surface has one sample.
constexpr double kSmallShare = 1.0 / 128.0;
// A part this small a share of its facet is not halved again: 2^-kDeepest of its area.
constexpr std::uint32_t kDeepestLevel = 12;
// The depth is known to 1 %: twice this share, once of the search and once of what it has to win. The search
// likes ridges, where the way out is not unique.
constexpr double kDepthShare = 5e-3;
// Parts are halved where the planes are wrong by this share of the depth.
constexpr double kUnevenShare = 1e-2;
constexpr std::size_t kDepthParts = 4000;
// Corners that may be deeper by this share are looked at, so that the depth is continuous.
constexpr double kCornerShare = 1e-6;

Eigen::Vector3d middleOf(const Eigen::Vector3d& l, const Eigen::Vector3d& r) {
  return 0.5 * (l + r);
}

Eigen::Vector3d centreOf(const std::array<Eigen::Vector3d, 3>& corners) {
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

double reachOf(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& centre) {
  double reach = 0.0;
  for (const Eigen::Vector3d& corner : corners) reach = std::max(reach, (corner - centre).norm());
  return reach;
}

// Both surfaces count half.
double weightOf(const OverlapFacet& facet) {
  return facet.is_negative ? -0.5 : 0.5;
}

template <typename Part>
std::array<Eigen::Vector3d, 3> cornersOf(const Part& part) {
  return {part.corners[0].point, part.corners[1].point, part.corners[2].point};
}

/// Returns by how much the depth in the middle of an edge differs from the mean of its ends.
template <typename Part>
double bendOf(const Part& part) {
  double bend = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double linear = 0.5 * (part.corners[k].depth + part.corners[(k + 1) % 3].depth);
    bend = std::max(bend, std::abs(part.middles[k].depth - linear));
  }
  return bend;
}

}  // namespace

// The triangles of a fan share an edge with the one before.
OverlapSampler::Part OverlapSampler::wholeOf(const OverlapFacet& facet, const Part* before) {
  Part part;
  part.level = 0;
  const bool continues = before != nullptr && before->corners[0].point == facet.corners_in_a[0] &&
                         before->corners[2].point == facet.corners_in_a[1];
  if (continues) {
    part.corners = {before->corners[0], before->corners[2], probe_.look(facet, facet.corners_in_a[2])};
    part.middles[0] = before->middles[2];
  } else {
    for (std::size_t k = 0; k < 3; ++k) part.corners[k] = probe_.look(facet, facet.corners_in_a[k]);
  }
  for (std::size_t k = continues ? 1 : 0; k < 3; ++k) {
    part.middles[k] = probe_.look(facet, middleOf(facet.corners_in_a[k], facet.corners_in_a[(k + 1) % 3]));
  }
  return part;
}

DeepestPoint OverlapSampler::sample(const OverlapFacet* first, const OverlapFacet* last, double tolerance,
                                    std::vector<OverlapSample>& samples) {
  probe_.beginRegion();
  double surface = 0.0;
  for (const OverlapFacet* facet = first; facet != last; ++facet)
    surface += triangleArea(facet->corners_in_a);
  candidates_.clear();
  large_.clear();
  wholes_.clear();
  double integral = 0.0;
  const OverlapFacet* last_whole = nullptr;
  for (const OverlapFacet* facet = first; facet != last; ++facet) {
    const double area = triangleArea(facet->corners_in_a);
    const auto index = static_cast<std::uint32_t>(facet - first);
    if (area >= kSmallShare * surface) {
      large_.push_back(index);
      const bool same_triangle =
          facet != first && facet[-1].triangle == facet->triangle && facet[-1].of_b == facet->of_b;
      const Part* before = same_triangle && last_whole == facet - 1 ? &wholes_.back() : nullptr;
      wholes_.push_back(wholeOf(*facet, before));
      last_whole = facet;
      for (const ProbedPoint& middle : wholes_.back().middles) integral += area / 3.0 * middle.depth;
      continue;
    }
    const Eigen::Vector3d centre = centreOf(facet->corners_in_a);
    const ProbedPoint at = probe_.look(*facet, centre);
    samples.push_back({centre, pushOf(*facet), at.exit, weightOf(*facet) * area, at.depth});
    integral += area * at.depth;
    candidates_.push_back(candidateOf(*facet, index, at));
  }
  for (std::size_t i = 0; i < large_.size(); ++i) {
    integrate(first[large_[i]], wholes_[i], tolerance * integral, samples);
  }
  return findDeepest(first);
}

void OverlapSampler::integrate(const OverlapFacet& facet, const Part& whole, double allowed,
                               std::vector<OverlapSample>& samples) {
  const double area = triangleArea(facet.corners_in_a);
  planes_.begin(probe_.other(facet), probe_.aFromOther(facet), facet.of_b);
  parts_.assign(1, whole);
  while (!parts_.empty()) {
    const Part part = parts_.back();
    parts_.pop_back();
    const double part_area = area * std::ldexp(1.0, -static_cast<int>(part.level));
    findPlanes(facet, part);
    const double worst = worstHeight(facet, part);
    const bool is_flat = worst * part_area <= allowed;
    const bool is_uneven = worst > kUnevenShare * probe_.deepest().depth && mayBeDeeper(facet, part);
    if (part.level < kDeepestLevel && (is_uneven || (!is_flat && bendOf(part) * part_area > allowed))) {
      halve(facet, part);
    } else if (is_flat) {
      addBelowPlanes(facet, part, samples);
    } else {
      addQuadratic(facet, part, samples);
    }
  }
}

void OverlapSampler::findPlanes(const OverlapFacet& facet, const Part& part) {
  planes_.clear();
  for (const std::array<ProbedPoint, 3>* points : {&part.corners, &part.middles}) {
    for (const ProbedPoint& at : *points) {
      if (!at.is_outside) planes_.addAround(at.nearest, probe_.footInOther(facet, at));
    }
  }
}

// Returns by how much the planes are wrong, at the points that are known and at the centre.
double OverlapSampler::worstHeight(const OverlapFacet& facet, const Part& part) {
  double worst = 0.0;
  const auto compare = [&](const ProbedPoint& at) {
    worst = std::max(worst, std::abs(planes_.leastDepth(at.point) - at.depth));
  };
  for (const ProbedPoint& corner : part.corners) compare(corner);
  for (const ProbedPoint& middle : part.middles) compare(middle);
  if (planes_.size() > 1) {
    compare(probe_.look(facet, centreOf(cornersOf(part))));
  }
  return worst;
}

void OverlapSampler::addBelowPlanes(const OverlapFacet& facet, const Part& part,
                                    std::vector<OverlapSample>& samples) {
  planes_.forEachPart(
      cornersOf(part), [&](const DepthPlane& plane, const std::vector<Eigen::Vector3d>& polygon) {
        for (const Eigen::Vector3d& corner : polygon) {
          if (plane.depth(corner) > (1.0 + kCornerShare) * probe_.deepest().depth) probe_.look(facet, corner);
        }
        for (std::size_t k = 2; k < polygon.size(); ++k) {
          const std::array<Eigen::Vector3d, 3> corners = {polygon[0], polygon[k - 1], polygon[k]};
          const double area = triangleArea(corners);
          if (!(area > 0.0)) continue;
          for (std::size_t edge = 0; edge < 3; ++edge) {
            const Eigen::Vector3d middle = middleOf(corners[edge], corners[(edge + 1) % 3]);
            samples.push_back({middle, pushOf(facet), plane.exit, weightOf(facet) * area / 3.0,
                               std::max(0.0, plane.depth(middle))});
          }
        }
      });
}

void OverlapSampler::addQuadratic(const OverlapFacet& facet, const Part& part,
                                  std::vector<OverlapSample>& samples) const {
  const double area = triangleArea(cornersOf(part));
  for (const ProbedPoint& middle : part.middles) {
    samples.push_back({middle.point, pushOf(facet), middle.exit, weightOf(facet) * area / 3.0, middle.depth});
  }
}

bool OverlapSampler::mayBeDeeper(const OverlapFacet& facet, const Part& part) const {
  const std::array<Eigen::Vector3d, 3> corners = cornersOf(part);
  return std::all_of(part.middles.begin(), part.middles.end(), [&](const ProbedPoint& middle) {
    return probe_.depthBound(facet, corners, middle.nearest) > (1.0 + kUnevenShare) * probe_.deepest().depth;
  });
}

// No point is deeper than a known one by more than its distance.
OverlapSampler::Candidate OverlapSampler::candidateOf(const OverlapFacet& facet, std::uint32_t index,
                                                      const ProbedPoint& at) {
  return {index, at.nearest, at.depth + reachOf(facet.corners_in_a, at.point)};
}

void OverlapSampler::lookAtCorners(const OverlapFacet* first) {
  for (const Candidate& candidate : candidates_) {
    const double enough = (1.0 + kCornerShare) * probe_.deepest().depth;
    const OverlapFacet& facet = first[candidate.facet];
    if (candidate.reachable <= enough ||
        probe_.depthBound(facet, facet.corners_in_a, candidate.nearest) <= enough)
      continue;
    for (const Eigen::Vector3d& corner : facet.corners_in_a) probe_.look(facet, corner);
  }
}

DeepestPoint OverlapSampler::findDeepest(const OverlapFacet* first) {
  lookAtCorners(first);
  const DeepestPoint seen = probe_.deepest();
  search_.begin();
  for (std::size_t i = 0; i < large_.size(); ++i) search_.add(first, large_[i], wholes_[i].corners, probe_);
  for (const Candidate& candidate : candidates_) {
    if (candidate.reachable > (1.0 + kDepthShare) * probe_.deepest().depth)
      search_.add(first, candidate.facet, candidate.nearest, probe_);
  }
  search_.run(first, kDepthShare, kDepthParts, probe_);
  return probe_.deepest().depth > (1.0 + kDepthShare) * seen.depth ? probe_.deepest() : seen;
}

// Across the longest edge, whose middle is known.
void OverlapSampler::halve(const OverlapFacet& facet, const Part& part) {
  const std::size_t k = longestEdge(cornersOf(part));
  const ProbedPoint& from = part.corners[k];
  const ProbedPoint& to = part.corners[(k + 1) % 3];
  const ProbedPoint& tip = part.corners[(k + 2) % 3];
  const ProbedPoint& cut = part.middles[k];
  const ProbedPoint across = probe_.look(facet, middleOf(cut.point, tip.point));
  const ProbedPoint first = probe_.look(facet, middleOf(from.point, cut.point));
  const ProbedPoint second = probe_.look(facet, middleOf(cut.point, to.point));
  parts_.push_back({{from, cut, tip}, {first, across, part.middles[(k + 2) % 3]}, part.level + 1});
  parts_.push_back({{cut, to, tip}, {second, part.middles[(k + 1) % 3], across}, part.level + 1});
}

}  // namespace concave_distance

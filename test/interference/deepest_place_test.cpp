#include "interference/deepest_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "interference/interference_checks.h"
#include "support/count_allocations.h"
#include "support/random_solids.h"

namespace concave_distance::deepest_place_test {
namespace {

using detail::DeepestPlace;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kExact = 1e-9;  // of a body's size

/// Closest point of a triangle by its seven features, written apart from the library's kernel.
Vector3d closestOnTriangle(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  if (normal.squaredNorm() > 0.0) {
    const Vector3d foot = p - normal * (normal.dot(p - t[0]) / normal.squaredNorm());
    bool is_in = true;
    for (std::size_t k = 0; k < 3; ++k)
      is_in = is_in && (t[(k + 1) % 3] - t[k]).cross(foot - t[k]).dot(normal) >= 0.0;
    if (is_in) return foot;
  }
  Vector3d best = t[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d edge = t[(k + 1) % 3] - t[k];
    const double share = std::clamp(edge.dot(p - t[k]) / edge.squaredNorm(), 0.0, 1.0);
    const Vector3d on_edge = t[k] + share * edge;
    if ((on_edge - p).squaredNorm() < (best - p).squaredNorm()) best = on_edge;
  }
  return best;
}

/// A body's triangles in A's frame.
std::vector<std::array<Vector3d, 3>> placed(const SurfaceMesh& mesh, const Isometry3d& pose) {
  std::vector<std::array<Vector3d, 3>> triangles;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
    triangles.push_back({pose * mesh.corner(TriangleIndex{t}, 0), pose * mesh.corner(TriangleIndex{t}, 1),
                         pose * mesh.corner(TriangleIndex{t}, 2)});
  return triangles;
}

double distanceFrom(const Vector3d& p, const std::vector<std::array<Vector3d, 3>>& triangles) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::array<Vector3d, 3>& t : triangles)
    least = std::min(least, (closestOnTriangle(p, t) - p).squaredNorm());
  return std::sqrt(least);
}

/// The sum of solid angles over 4 pi.
bool isInside(const Vector3d& p, const std::vector<std::array<Vector3d, 3>>& triangles) {
  double angle = 0.0;
  for (const std::array<Vector3d, 3>& t : triangles) {
    const Vector3d l = t[0] - p;
    const Vector3d m = t[1] - p;
    const Vector3d n = t[2] - p;
    angle += 2.0 * std::atan2(l.dot(m.cross(n)), l.norm() * m.norm() * n.norm() + l.dot(m) * n.norm() +
                                                     m.dot(n) * l.norm() + n.dot(l) * m.norm());
  }
  return angle > 2.0 * M_PI;
}

struct Overlap {
  Overlap(const SurfaceMesh& mesh_a, const SurfaceMesh& mesh_b, const Isometry3d& a_from_b)
      : a(test::makeBody(mesh_a)),
        b(test::makeBody(mesh_b)),
        pose(a_from_b),
        found(test::interferenceOf(*a, *b, pose)),
        triangles{placed(mesh_a, Isometry3d::Identity()), placed(mesh_b, pose)} {
    search.begin(*a, *b, pose, 0.25 * kExact * size());
  }
  double size() const { return std::min(a->diameter(), b->diameter()); }
  DeepestPlace deepest(std::size_t region) {
    const InterferenceRegion& r = found.regions[region];
    const OverlapFacet* first = found.facets.data() + r.first_facet;
    WorkLimit none;
    return search.find(first, first + r.facet_count, none);
  }

  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  Isometry3d pose;
  Interference found;
  std::vector<std::array<Vector3d, 3>> triangles[2];
  detail::DeepestPlaceSearch search;
};

/// Looks around the deepest of random points of the region's facets, in neighbourhoods that shrink.
double sampledDepth(const Overlap& overlap, const InterferenceRegion& region, RandomEngine& engine) {
  struct Start {
    double depth;
    const OverlapFacet* facet;
    Vector3d weights;
  };
  const auto depthAt = [&](const OverlapFacet& facet, const Vector3d& weights) {
    Vector3d p = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) p += weights[static_cast<Eigen::Index>(k)] * facet.corners_in_a[k];
    const auto& other = overlap.triangles[facet.of_b ? 0 : 1];
    return facet.may_leave && !isInside(p, other) ? 0.0 : distanceFrom(p, other);
  };
  std::vector<Start> starts;
  for (std::uint32_t f = region.first_facet; f < region.first_facet + region.facet_count; ++f) {
    const OverlapFacet& facet = overlap.found.facets[f];
    if (facet.is_negative) continue;
    Start best{-1.0, &facet, Vector3d::Zero()};
    const int count = 40 + static_cast<int>(400 / region.facet_count);
    for (int i = 0; i < count; ++i) {
      Vector3d weights =
          i < 3 ? Vector3d::Unit(i) : Vector3d(uniformUnit(engine), uniformUnit(engine), uniformUnit(engine));
      weights /= weights.sum();
      const double depth = depthAt(facet, weights);
      if (depth > best.depth) best = {depth, &facet, weights};
    }
    starts.push_back(best);
  }
  std::sort(starts.begin(), starts.end(), [](const Start& l, const Start& r) { return l.depth > r.depth; });
  double deepest = 0.0;
  for (std::size_t s = 0; s < std::min<std::size_t>(16, starts.size()); ++s) {
    deepest = std::max(deepest, starts[s].depth);
    const OverlapFacet& facet = *starts[s].facet;
    // All over the facet, and on each edge, which ridges end at.
    for (int edge = -1; edge < 3; ++edge) {
      const Vector3d from = edge < 0 ? starts[s].weights : Vector3d::Unit(edge);
      const Vector3d to = edge < 0 ? from : Vector3d::Unit((edge + 1) % 3);
      Start at{-1.0, &facet, 0.5 * (from + to)};
      for (double reach = edge < 0 ? 0.3 : 1.0; reach > 1e-8; reach *= 0.75) {
        const Start middle = at;
        for (int i = 0; i < 25; ++i) {
          Vector3d weights = middle.weights;
          if (edge < 0) {
            weights = (weights + reach * test::uniformInCube(engine, 1.0)).cwiseMax(0.0);
            if (!(weights.sum() > 0.0)) continue;
            weights /= weights.sum();
          } else {
            const double share = weights[(edge + 1) % 3] + reach * test::uniformIn(engine, -1.0, 1.0);
            weights = from + std::clamp(share, 0.0, 1.0) * (to - from);
          }
          const double depth = depthAt(facet, weights);
          if (depth > at.depth) at = {depth, &facet, weights};
        }
      }
      deepest = std::max(deepest, at.depth);
    }
  }
  return deepest;
}

TEST(DeepestPlace, OfConcaveSolidsIsAttainedAndNoOtherPlaceIsDeeper) {
  std::size_t regions = 0;
  std::size_t met = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    RandomEngine engine(seed);
    const SurfaceMesh a = test::randomSolid(engine);
    const SurfaceMesh b = test::randomSolid(engine);
    Overlap overlap(a, b, test::randomOverlappingPose(a, b, engine));
    for (std::size_t r = 0; r < overlap.found.regions.size(); ++r) {
      const InterferenceRegion& region = overlap.found.regions[r];
      if (region.facet_count == 0 || !region.consistent) continue;
      SCOPED_TRACE("seed " + std::to_string(seed) + ", region " + std::to_string(r));
      const DeepestPlace place = overlap.deepest(r);
      EXPECT_TRUE(place.is_sure);
      const double exact = kExact * overlap.size();
      const auto& other = overlap.triangles[place.inside_is_of_b ? 0 : 1];
      const auto& own = overlap.triangles[place.inside_is_of_b ? 1 : 0];
      EXPECT_NEAR(distanceFrom(place.inside_in_a, other), place.depth, 1e-3 * exact);
      EXPECT_NEAR((place.inside_in_a - place.surface_in_a).norm(), place.depth, 1e-3 * exact);
      EXPECT_LE(distanceFrom(place.inside_in_a, own), 1e-3 * exact);
      std::vector<std::array<Vector3d, 3>> of_region;
      for (std::uint32_t f = region.first_facet; f < region.first_facet + region.facet_count; ++f) {
        if (overlap.found.facets[f].of_b == place.inside_is_of_b)
          of_region.push_back(overlap.found.facets[f].corners_in_a);
      }
      EXPECT_LE(distanceFrom(place.inside_in_a, of_region), 1e-3 * exact);
      EXPECT_TRUE(isInside(place.inside_in_a, other));
      // The region's own search is right to 1 %, from below but for fans.
      EXPECT_LE(region.depth, 1.0001 * place.depth + exact);
      EXPECT_GE(region.depth, 0.985 * place.depth - exact);
      const double sampled = sampledDepth(overlap, region, engine);
      EXPECT_LE(sampled, place.depth + exact);
      ++regions;
      if (sampled >= place.depth - 1e-6 * overlap.size()) ++met;
    }
  }
  EXPECT_GE(regions, 50U);
  EXPECT_GE(met, regions * 3 / 4);
}

/// The greatest depth of a convex body's surface in another one: at a place where three of these meet: the
/// planes of its own faces, and pairs of planes of the other's that are as far away.
double enumeratedDepth(const std::vector<std::array<Vector3d, 3>>& own,
                       const std::vector<std::array<Vector3d, 3>>& other) {
  struct Plane {
    Vector3d normal;
    double offset;  ///< inside: normal . x <= offset
  };
  const auto planesOf = [](const std::vector<std::array<Vector3d, 3>>& triangles) {
    std::vector<Plane> planes;
    for (const std::array<Vector3d, 3>& t : triangles) {
      const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
      const bool is_known = std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
        return (plane.normal - normal).norm() < 1e-9 && std::abs(plane.offset - normal.dot(t[0])) < 1e-9;
      });
      if (!is_known) planes.push_back({normal, normal.dot(t[0])});
    }
    return planes;
  };
  const std::vector<Plane> of_own = planesOf(own);
  const std::vector<Plane> of_other = planesOf(other);
  double deepest = 0.0;
  const auto offer = [&](const Vector3d& p) {
    for (const Plane& plane : of_own) {
      if (plane.normal.dot(p) > plane.offset + 1e-12) return;
    }
    double depth = std::numeric_limits<double>::infinity();
    for (const Plane& plane : of_other) depth = std::min(depth, plane.offset - plane.normal.dot(p));
    deepest = std::max(deepest, depth);
  };
  // Rows of a system whose solution is a candidate: the own planes of the place, then equal depths.
  const auto solve = [&](const std::array<Plane, 3>& rows) {
    Eigen::Matrix3d matrix;
    Vector3d right;
    for (int k = 0; k < 3; ++k) {
      matrix.row(k) = rows[static_cast<std::size_t>(k)].normal.transpose();
      right[k] = rows[static_cast<std::size_t>(k)].offset;
    }
    if (std::abs(matrix.determinant()) > 1e-9) offer(matrix.inverse() * right);
  };
  const auto tie = [&](const Plane& l, const Plane& r) {
    return Plane{l.normal - r.normal, l.offset - r.offset};
  };
  for (std::size_t i = 0; i < of_own.size(); ++i) {
    for (std::size_t m = 0; m < of_other.size(); ++m) {
      for (std::size_t n = m + 1; n < of_other.size(); ++n) {
        const Plane first = tie(of_other[m], of_other[n]);
        for (std::size_t j = i + 1; j < of_own.size(); ++j) solve({of_own[i], of_own[j], first});
        for (std::size_t o = n + 1; o < of_other.size(); ++o)
          solve({of_own[i], first, tie(of_other[m], of_other[o])});
      }
    }
    for (std::size_t j = i + 1; j < of_own.size(); ++j) {
      for (std::size_t k = j + 1; k < of_own.size(); ++k) solve({of_own[i], of_own[j], of_own[k]});
    }
  }
  return deepest;
}

TEST(DeepestPlace, OfConvexSolidsIsThatOfEveryTieOfPlanes) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto random = [&] {
      const Vector3d half = Vector3d::Constant(0.3) + test::uniformInCube(engine, 0.25);
      return uniformIndex(engine, 2) == 0
                 ? test::makeCuboid(-half, half)
                 : test::makeExtrusion({{-half.x(), -half.y()}, {half.x(), -half.y()}, {0.0, half.y()}},
                                       half.z());
    };
    const SurfaceMesh a = random();
    const SurfaceMesh b = random();
    Overlap overlap(a, b, test::randomOverlappingPose(a, b, engine));
    if (overlap.found.regions.size() != 1 || overlap.found.regions[0].loop_count == 0) continue;
    ++compared;
    const double depth = std::max(enumeratedDepth(overlap.triangles[0], overlap.triangles[1]),
                                  enumeratedDepth(overlap.triangles[1], overlap.triangles[0]));
    EXPECT_NEAR(overlap.deepest(0).depth, depth, 1e-10 * overlap.size());
  }
  EXPECT_GE(compared, 150U);
}

/// A square plate with its upper face at 0, of `count` times `count` cells.
SurfaceMesh plateOfCells(int count, double half, double thickness) {
  std::vector<Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  const auto node = [&](int i, int j, int layer) {
    return NodeIndex{static_cast<std::uint32_t>((layer * (count + 1) + i) * (count + 1) + j)};
  };
  for (int layer = 0; layer < 2; ++layer) {
    for (int i = 0; i <= count; ++i) {
      for (int j = 0; j <= count; ++j)
        vertices.emplace_back(half * (2.0 * i / count - 1.0), half * (2.0 * j / count - 1.0),
                              layer == 0 ? 0.0 : -thickness);
    }
  }
  const auto quad = [&](NodeIndex p, NodeIndex q, NodeIndex r, NodeIndex s) {
    triangles.push_back({p, q, r});
    triangles.push_back({p, r, s});
  };
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      quad(node(i, j, 0), node(i + 1, j, 0), node(i + 1, j + 1, 0), node(i, j + 1, 0));
      quad(node(i, j, 1), node(i, j + 1, 1), node(i + 1, j + 1, 1), node(i + 1, j, 1));
    }
    quad(node(i, 0, 0), node(i, 0, 1), node(i + 1, 0, 1), node(i + 1, 0, 0));
    quad(node(i, count, 0), node(i + 1, count, 0), node(i + 1, count, 1), node(i, count, 1));
    quad(node(0, i, 0), node(0, i + 1, 0), node(0, i + 1, 1), node(0, i, 1));
    quad(node(count, i, 0), node(count, i, 1), node(count, i + 1, 1), node(count, i + 1, 0));
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "plate");
}

TEST(DeepestPlace, OfAFlatBottomBelowManyTrianglesIsItsHeight) {
  const SurfaceMesh plate = plateOfCells(40, 1.0, 1.0);
  for (const double tilt : {0.0, 1e-12, 1e-7, 1e-3}) {
    SCOPED_TRACE(tilt);
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() = (Eigen::AngleAxisd(0.3, Vector3d::UnitZ()) * Eigen::AngleAxisd(tilt, Vector3d::UnitX()))
                        .toRotationMatrix();
    pose.translation() = Vector3d(0.03, 0.02, 0.2);
    const SurfaceMesh box = test::makeCuboid(Vector3d::Constant(-0.3), Vector3d::Constant(0.3));
    Overlap overlap(plate, box, pose);
    ASSERT_EQ(overlap.found.regions.size(), 1U);
    const DeepestPlace place = overlap.deepest(0);
    EXPECT_TRUE(place.is_sure);
    EXPECT_NEAR(place.depth, 0.3 * std::cos(tilt) + 0.3 * std::sin(tilt) - 0.2, kExact);
    EXPECT_NEAR((place.slope_in_a + Vector3d::UnitZ()).norm(), 0.0, 1e-9);
  }
}

TEST(DeepestPlace, OfAPegThroughAPlateIsInItsMiddleAndDoesNotChange) {
  const SurfaceMesh plate = plateOfCells(7, 1.0, 0.2);
  const SurfaceMesh peg = test::makeCuboid({-0.1, -0.1, -1.0}, {0.1, 0.1, 1.0});
  for (const double tilt : {0.0, 0.2}) {
    SCOPED_TRACE(tilt);
    Isometry3d pose(Eigen::AngleAxisd(tilt, Vector3d(1.0, 0.4, 0.1).normalized()));
    pose.translation() = Vector3d(0.07, 0.03, 0.1);
    Overlap overlap(plate, peg, pose);
    ASSERT_EQ(overlap.found.regions.size(), 1U);
    const DeepestPlace place = overlap.deepest(0);
    EXPECT_TRUE(place.is_sure);
    EXPECT_NEAR(place.depth, 0.1, kExact);
    EXPECT_NEAR(place.slope_in_a.norm(), 0.0, 1e-6);
  }
}

TEST(DeepestPlace, IsNotSureWhereTheTimeWasOver) {
  const SurfaceMesh cube = test::makeCuboid(Vector3d::Constant(-0.5), Vector3d::Constant(0.5));
  Overlap overlap(cube, cube, test::translation({0.8, 0.1, 0.2}));
  ASSERT_EQ(overlap.found.regions.size(), 1U);
  WorkLimit over(WorkLimit::Clock::now(), 0.0, 1U << 20U, nullptr);
  const OverlapFacet* first = overlap.found.facets.data();
  EXPECT_FALSE(overlap.search.find(first, first + overlap.found.facets.size(), over).is_sure);
}

TEST(DeepestPlace, AllocatesNothingAgain) {
  RandomEngine engine(3);
  const SurfaceMesh a = test::makeComb(4);
  const SurfaceMesh b = test::makeHook(0.8, 0.3);
  Overlap overlap(a, b, test::randomOverlappingPose(a, b, engine));
  ASSERT_FALSE(overlap.found.regions.empty());
  const double depth = overlap.deepest(0).depth;
  const std::size_t before = allocations;
  const double again = overlap.deepest(0).depth;
  EXPECT_EQ(allocations - before, 0U);
  EXPECT_EQ(again, depth);
}

}  // namespace
}  // namespace concave_distance::deepest_place_test

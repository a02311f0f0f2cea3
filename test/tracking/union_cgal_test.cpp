#include <gtest/gtest.h>

#include <memory>

#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "interference/interference_checks.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"
#include "support/case_seed.h"
#include "support/cgal_overlap.h"
#include "support/mesh_variants.h"
#include "support/random_solids.h"
#include "support/triangle_pairs.h"

/// Files of many solids that share slanted faces, against CGAL: its winding numbers, and the exact Booleans
/// of each solid by itself, whose volumes add up.
namespace concave_distance::union_cgal_test {
namespace {

using Eigen::Vector3d;

constexpr AccuracyLevel kLevels[] = {AccuracyLevel::Nodes, AccuracyLevel::Refined, AccuracyLevel::Certified};

/// Corners of a lattice of 2 x 2 x 1 cells, each moved by less than would turn a tetrahedron inside out.
class CrookedLattice {
 public:
  explicit CrookedLattice(RandomEngine& engine) {
    for (int i = 0; i < 18; ++i) {
      const Vector3d corner(i % 3, i / 3 % 3, i / 9);
      corners_.push_back(0.5 * (corner + test::uniformInCube(engine, 0.1)) - Vector3d(0.5, 0.5, 0.25));
    }
  }

  /// Tetrahedron 0 to 5 of cell 0 to 3 (Kuhn 1960): neighbours share whole faces.
  SurfaceMesh tetrahedron(std::uint32_t cell, std::uint32_t number) const {
    constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    constexpr std::size_t kStep[3] = {1, 3, 9};
    std::size_t at = cell % 2 * kStep[0] + cell / 2 * kStep[1];
    std::vector<Vector3d> vertices{corners_[at]};
    for (const int axis : kOrders[number]) {
      at += kStep[axis];
      vertices.push_back(corners_[at]);
    }
    const Vector3d normal = (vertices[1] - vertices[0]).cross(vertices[2] - vertices[0]);
    if (normal.dot(vertices[3] - vertices[0]) > 0.0) std::swap(vertices[0], vertices[1]);
    const auto face = [](std::size_t a, std::size_t b, std::size_t c) {
      return TriangleNodes{NodeIndex{a}, NodeIndex{b}, NodeIndex{c}};
    };
    return {std::move(vertices), {face(0, 1, 2), face(0, 3, 1), face(1, 3, 2), face(2, 3, 0)}, "tetrahedron"};
  }

 private:
  std::vector<Vector3d> corners_;
};

struct File {
  std::vector<SurfaceMesh> solids;
  std::shared_ptr<const BodyMesh> body;
};

TriangleSoup joined(const std::vector<SurfaceMesh>& solids) {
  TriangleSoup soup;
  for (const SurfaceMesh& solid : solids) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), solid.vertices().begin(), solid.vertices().end());
    for (const TriangleNodes& t : solid.triangles())
      soup.triangles.push_back({first + t[0].value, first + t[1].value, first + t[2].value});
  }
  return soup;
}

/// Tetrahedra of one lattice, most of them neighbours; one may hold a small solid or be crossed by another.
File drawFile(RandomEngine& engine, bool with_overlaps) {
  File file;
  const CrookedLattice lattice(engine);
  const double share = test::uniformIn(engine, 0.2, 0.9);
  for (std::uint32_t i = 0; i < 24; ++i) {
    if (file.solids.empty() || uniformUnit(engine) < share)
      file.solids.push_back(lattice.tetrahedron(i / 6, i % 6));
  }
  if (with_overlaps) {
    file.solids.push_back(
        test::movedSurface(test::makeCuboid(Vector3d::Constant(-0.03), Vector3d::Constant(0.02)),
                           test::randomPose(engine, 0.4)));
    file.solids.push_back(test::movedSurface(test::randomStar(engine), test::randomPose(engine, 0.5)));
  }
  file.body = test::makeBody(repairMesh(joined(file.solids), {}, "solids").mesh);
  return file;
}

TEST(UnionAgainstCgal, HoldsThePointsThatASolidHolds) {
  const std::uint64_t seed = test::caseSeed(1);
  const std::uint64_t cases = test::caseCount<std::uint64_t>(40);
  for (std::uint64_t i = 0; i < cases; ++i) {
    RandomEngine engine(streamSeed(seed, "points in unions", i));
    const File file = drawFile(engine, uniformIndex(engine, 2) == 0);
    const MeshTopology& topology = file.body->topology();
    const test::CgalSolids solids(file.solids);
    for (int k = 0; k < 60; ++k) {
      const Vector3d point = test::uniformInCube(engine, 0.7);
      ASSERT_EQ(containsPoint(file.body->tree(), file.body->surface(), topology.shell_is_closed,
                              topology.shell_of_triangle, point),
                solids.hold(point))
          << "case " << i << " of seed " << seed << " at " << point.transpose();
    }
  }
}

void expectStatus(const PairSolution& solution, AccuracyLevel level, bool overlap) {
  if (overlap && !provesDistance(level) && solution.status == SolveStatus::Ok)
    return;  // a crossing was missed
  EXPECT_EQ(solution.status, overlap ? SolveStatus::Penetrating : SolveStatus::Ok);
}

TEST(UnionAgainstCgal, OverlapsAsMuchAsItsSolidsDo) {
  const std::uint64_t seed = test::caseSeed(1);
  const std::uint64_t cases = test::caseCount<std::uint64_t>(12);
  std::uint64_t overlaps = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    RandomEngine engine(streamSeed(seed, "overlaps of unions", i));
    const File a = drawFile(engine, false);
    const SurfaceMesh partner = test::randomStar(engine);
    const Eigen::Isometry3d pose = test::randomPose(engine, 0.9);
    const auto b = test::makeBody(partner);
    double volume = 0.0;
    for (const SurfaceMesh& solid : a.solids) {
      const test::OverlapTruth truth = test::cgalOverlap(solid, test::movedSurface(partner, pose));
      ASSERT_TRUE(truth.known);
      volume += truth.volume;
    }
    if (volume > 0.0 && volume < 1e-12) continue;  // a matter of the pose's roundings
    overlaps += volume > 0.0 ? 1 : 0;
    SCOPED_TRACE("case " + std::to_string(i) + " of seed " + std::to_string(seed));
    const Interference interference = test::interferenceOf(*a.body, *b, pose);
    double sum = 0.0;
    for (const InterferenceRegion& region : interference.regions) {
      EXPECT_TRUE(region.closed && region.consistent);
      sum += region.volume;
    }
    EXPECT_NEAR(sum, volume, 1e-12);
    for (const AccuracyLevel level : kLevels) {
      TrackerParameters parameters;
      parameters.accuracy = level;
      expectStatus(solveOnce("pair", a.body, b, parameters, pose), level, volume > 0.0);
      expectStatus(solveOnce("pair", b, a.body, parameters, pose.inverse(Eigen::Isometry)), level,
                   volume > 0.0);
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(overlaps, cases / 4);
  EXPECT_LT(overlaps, cases);
}

}  // namespace
}  // namespace concave_distance::union_cgal_test

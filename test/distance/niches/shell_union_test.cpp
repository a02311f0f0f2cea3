// Niches of bodies of several shells against those of the surface of their union, which CGAL makes with exact
// arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "distance/niches/local_minima.h"
#include "mesh/trees/shell_contacts.h"
#include "support/body_pairs.h"
#include "support/cgal_overlap.h"

namespace concave_distance::shell_union_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using Body = std::shared_ptr<const BodyMesh>;

SurfaceMesh box(const Vector3d& low, const Vector3d& high) {
  return test::makeCuboid(low, high);
}

SurfaceMesh moved(const SurfaceMesh& mesh, const Isometry3d& pose) {
  std::vector<Vector3d> vertices;
  for (const Vector3d& v : mesh.vertices()) vertices.push_back(pose * v);
  return SurfaceMesh(std::move(vertices), mesh.triangles(), "moved");
}

SurfaceMesh together(const std::vector<SurfaceMesh>& solids) {
  SurfaceMesh all = solids.front();
  for (std::size_t i = 1; i < solids.size(); ++i) all = test::makeJoined(all, solids[i], Vector3d::Zero());
  return all;
}

std::vector<double> visibleNiches(const Body& a, const Body& b, const Isometry3d& pose, double cutoff) {
  LocalMinimaRequest request;
  request.hidden = false;
  request.cutoff = cutoff;
  std::vector<double> distances;
  for (const LocalMinimum& niche : findLocalMinima(*a, *b, pose, request).niches) {
    distances.push_back(niche.distance);
  }
  return distances;
}

/// Where bodies overlap, places where they meet may hang together in the material of another shell: they are
/// there in both lists or in none.
bool isSame(std::vector<double> l, std::vector<double> r) {
  const auto drop_zeros = [](std::vector<double>& distances) {
    const auto apart = std::find_if(distances.begin(), distances.end(), [](double d) { return d > 0.0; });
    const bool meets = apart != distances.begin();
    distances.erase(distances.begin(), apart);
    return meets;
  };
  return drop_zeros(l) == drop_zeros(r) &&
         std::equal(l.begin(), l.end(), r.begin(), r.end(),
                    [](double x, double y) { return std::abs(x - y) < 1e-9; });
}

/// Of `count` poses, those at which the niches differ from those of the union.
int differences(const std::vector<SurfaceMesh>& solids, std::uint64_t seed, int count, std::size_t& niches) {
  const auto united = test::cgalUnion(solids);
  EXPECT_TRUE(united.has_value());
  if (!united) return count;
  const Body shells = makeBody(together(solids));
  const Body truth = makeBody(*united);
  RandomEngine engine(seed);
  int different = 0;
  for (int k = 0; k < count; ++k) {
    const Body b = makeBody(test::concaveShape(static_cast<std::uint32_t>(k) % 4));
    const Isometry3d pose = test::randomPose(engine, 2.5);
    const std::vector<double> found = visibleNiches(shells, b, pose, 3.0);
    const std::vector<double> expected = visibleNiches(truth, b, pose, 3.0);
    niches += expected.size();
    if (isSame(found, expected)) continue;
    ++different;
    if (different > 3) continue;
    std::string text = "pose " + std::to_string(k) + ": found";
    for (const double d : found) text += " " + std::to_string(d);
    text += ", expected";
    for (const double d : expected) text += " " + std::to_string(d);
    ADD_FAILURE() << text;
  }
  return different;
}

/// 60 poses, or as many as CONCAVE_DISTANCE_UNION_POSES says.
void expectNichesOfUnion(const std::vector<SurfaceMesh>& solids, std::uint64_t seed) {
  const char* const wanted = std::getenv("CONCAVE_DISTANCE_UNION_POSES");
  const int count = wanted != nullptr ? std::atoi(wanted) : 60;
  std::size_t niches = 0;
  EXPECT_EQ(differences(solids, seed, count, niches), 0) << "of " << count << " poses";
  EXPECT_GT(niches, static_cast<std::size_t>(count));
}

TEST(UnionOfShells, OfEqualBoxesThatShareAFace) {
  expectNichesOfUnion({box({0, 0, 0}, {1, 1, 1}), box({0, 0, 1}, {1, 1, 2})}, 1);
}

TEST(UnionOfShells, OfASmallerBoxOnALargerOne) {
  expectNichesOfUnion({box({0, 0, 0}, {2, 2, 1}), box({0.3, 0.4, 1}, {1.2, 1.1, 1.8})}, 2);
}

TEST(UnionOfShells, OfBoxesFlushOnOneSide) {
  expectNichesOfUnion({box({0, 0, 0}, {2, 1, 1}), box({0.5, 0, 0.5}, {1.5, 0.7, 1.8})}, 3);
}

TEST(UnionOfShells, OfBoltsSunkIntoAPlate) {
  std::vector<SurfaceMesh> solids{box({-1, -1, 0}, {1, 1, 0.2})};
  for (const double x : {-0.6, 0.0, 0.6}) {
    Isometry3d pose(Eigen::AngleAxisd(0.3 + x, Vector3d::UnitZ()));
    pose.translation() = Vector3d(x, 0.5 * x, 0.0);
    solids.push_back(moved(box({-0.1, -0.1, 0.05}, {0.1, 0.1, 0.5}), pose));
  }
  expectNichesOfUnion(solids, 4);
}

TEST(UnionOfShells, OfNestedShells) {
  expectNichesOfUnion({box({0, 0, 0}, {1, 1, 1}), box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}),
                       box({0.3, 0.3, 0.3}, {0.5, 0.5, 0.5})},
                      5);
}

TEST(UnionOfShells, OfCrossedBoxesAnyhow) {
  RandomEngine engine(6);
  std::vector<SurfaceMesh> solids;
  for (int k = 0; k < 4; ++k) {
    solids.push_back(moved(box({-0.2, -0.3, -0.9}, {0.2, 0.3, 0.9}), test::randomPose(engine, 0.3)));
  }
  expectNichesOfUnion(solids, 6);
}

TEST(UnionOfShells, OfStairsOfManyBoxes) {
  std::vector<SurfaceMesh> solids;
  for (int k = 0; k < 12; ++k) {
    solids.push_back(box({0.15 * k, 0.0, 0.0}, {0.15 * k + 0.2, 1.0, 0.1 * (k + 1)}));
  }
  expectNichesOfUnion(solids, 7);
}

// A sheet through a closed box, against its two parts that end at the box.
TEST(UnionOfShells, OfAnOpenSheetThroughABox) {
  const auto sheet = [](double from, double to) {
    return SurfaceMesh(
        {{from, 0.2, 0.5}, {to, 0.2, 0.5}, {to, 0.8, 0.5}, {from, 0.8, 0.5}},
        {{NodeIndex{0}, NodeIndex{1}, NodeIndex{2}}, {NodeIndex{0}, NodeIndex{2}, NodeIndex{3}}}, "sheet");
  };
  const SurfaceMesh solid = box({0, 0, 0}, {1, 1, 1});
  const Body through = makeBody(together({solid, sheet(-1.0, 2.0)}));
  const Body in_parts = makeBody(together({solid, sheet(-1.0, 0.0), sheet(1.0, 2.0)}));
  RandomEngine engine(8);
  std::size_t niches = 0;
  for (int k = 0; k < 100; ++k) {
    const Body b = makeBody(test::concaveShape(static_cast<std::uint32_t>(k) % 4));
    const Isometry3d pose = test::randomPose(engine, 2.5);
    const std::vector<double> found = visibleNiches(through, b, pose, 3.0);
    EXPECT_TRUE(isSame(found, visibleNiches(in_parts, b, pose, 3.0))) << "pose " << k;
    niches += found.size();
  }
  EXPECT_GT(niches, 100U);
}

// What lies in others costs nothing.
TEST(UnionOfShells, HasNoConesForWhatIsHidden) {
  const Body nested = makeBody(together({box({0, 0, 0}, {1, 1, 1}), box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8})}));
  EXPECT_EQ(std::count(nested->shellContacts().hidden.begin(), nested->shellContacts().hidden.end(), true),
            12);
  EXPECT_TRUE(nested->shellContacts().joints.empty());
  EXPECT_TRUE(makeBody(box({0, 0, 0}, {1, 1, 1}))->shellContacts().isEmpty());
}

}  // namespace
}  // namespace concave_distance::shell_union_test

// The surface of a set of voxels against what can be counted and computed of the cubes one by one.
#include "concave_distance/mesh/surface/voxels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "base/random_engine.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/surface/mass_properties.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"
#include "support/case_seed.h"

namespace concave_distance::voxels_test {
namespace {

using Eigen::Vector3d;

/// Cells of a cube of `edge` cells, each with the probability `share`; at least one.
VoxelGrid randomGrid(RandomEngine& engine, int edge, double share, double size) {
  VoxelGrid grid(size);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  for (int x = 0; x < edge; ++x) {
    for (int y = 0; y < edge; ++y) {
      for (int z = 0; z < edge; ++z) {
        if (chance(engine) < share) grid.insert({x - edge / 2, y, z - 2 * edge});
      }
    }
  }
  if (grid.cells().empty()) grid.insert({0, 0, 0});
  return grid;
}

std::size_t freeFaces(const VoxelGrid& grid) {
  const std::set<VoxelCell> cells(grid.cells().begin(), grid.cells().end());
  std::size_t faces = 0;
  for (const VoxelCell& cell : cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        VoxelCell neighbour = cell;
        neighbour[axis] += step;
        faces += cells.count(neighbour) == 0 ? 1U : 0U;
      }
    }
  }
  return faces;
}

TEST(Voxels, SurfaceIsClosedAndHoldsTheVolumeOfTheCells) {
  RandomEngine engine(test::caseSeed(11));
  for (const double share : {0.02, 0.2, 0.5, 0.8, 1.0}) {
    for (int i = 0; i < 10; ++i) {
      const double size = std::ldexp(1.0, i - 7);
      const VoxelGrid grid = randomGrid(engine, 1 + i, share, size);
      const SurfaceMesh surface = grid.surface("test");
      EXPECT_EQ(surface.triangleCount(), 2 * freeFaces(grid));
      const MeshTopology topology = buildMeshTopology(surface);
      EXPECT_TRUE(topology.allShellsClosed());
      const double volume = massPropertiesOf(surface, 1.0, "test").mass;
      const double expected = static_cast<double>(grid.cells().size()) * size * size * size;
      EXPECT_NEAR(volume, expected, 1e-12 * expected) << share << " " << i;
    }
  }
}

// Cells that meet at an edge or a corner are apart elsewhere.
TEST(Voxels, KnowInsideFromOutsideAlsoWhereCellsTouchAtEdgesAndCorners) {
  RandomEngine engine(test::caseSeed(12));
  std::uniform_real_distribution<double> coordinate(-0.05, 1.05);
  for (const double share : {0.1, 0.3, 0.5, 0.7}) {
    VoxelGrid grid(0.2);
    std::uniform_real_distribution<double> chance(0.0, 1.0);
    for (int i = 0; i < 125; ++i) {
      if (chance(engine) < share) grid.insert({i % 5, i / 5 % 5, i / 25});
    }
    const BodyMesh body("voxels", grid.surface("test"));
    const MeshTopology& topology = body.topology();
    for (int i = 0; i < 2000; ++i) {
      const Vector3d point(coordinate(engine), coordinate(engine), coordinate(engine));
      VoxelCell cell{};
      ASSERT_TRUE(grid.locate(point, cell));
      EXPECT_EQ(containsPoint(body.tree(), body.surface(), topology.shell_is_closed,
                              topology.shell_of_triangle, point),
                grid.contains(cell))
          << point.transpose();
    }
  }
}

TEST(Voxels, APointIsInTheCubeOfItsCell) {
  RandomEngine engine(test::caseSeed(13));
  std::uniform_real_distribution<double> coordinate(-30.0, 30.0);
  for (const double size : {0.01, 0.05, 1.0 / 3.0, 7.0}) {
    const VoxelGrid grid(size);
    for (int i = 0; i < 3000; ++i) {
      const Vector3d point(coordinate(engine), coordinate(engine), coordinate(engine));
      VoxelCell cell{};
      ASSERT_TRUE(grid.locate(point, cell));
      const Vector3d low = size * Vector3d(cell[0], cell[1], cell[2]);
      const double rounding = 4e-15 * 30.0;
      EXPECT_TRUE(((point - low).array() >= -rounding).all() &&
                  ((point - low).array() <= size + rounding).all())
          << point.transpose();
    }
  }
}

TEST(Voxels, RefuseWhatIsOutsideOfTheGrid) {
  VoxelGrid grid(0.5);
  VoxelCell cell{1, 2, 3};
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), infinity, -infinity, 1e9, -1e9}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3d point = Vector3d::Zero();
      point[axis] = bad;
      EXPECT_FALSE(grid.locate(point, cell)) << bad;
    }
  }
  EXPECT_EQ(cell, (VoxelCell{1, 2, 3}));
  EXPECT_THROW(grid.insert({VoxelGrid::kLargestIndex, 0, 0}), Error);
  EXPECT_THROW(grid.insert({0, -VoxelGrid::kLargestIndex - 1, 0}), Error);
  EXPECT_THROW(static_cast<void>(grid.surface("test")), Error);
  for (const double size : {0.0, -1.0, infinity, std::nan("")}) EXPECT_THROW(VoxelGrid{size}, Error) << size;
  // The farthest cells have all their corners.
  const std::int32_t last = VoxelGrid::kLargestIndex - 1;
  EXPECT_TRUE(grid.insert({last, last, last}));
  EXPECT_TRUE(grid.insert({-VoxelGrid::kLargestIndex, 0, 0}));
  EXPECT_FALSE(grid.insert({last, last, last}));
  EXPECT_EQ(grid.surface("test").triangleCount(), 24U);
}

}  // namespace
}  // namespace concave_distance::voxels_test

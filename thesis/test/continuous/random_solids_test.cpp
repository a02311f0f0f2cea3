#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/plain_shapes.h"
#include "thesis/src/continuous/construction/tree_of_solid.h"
#include "thesis/test/continuous/tree_checks.h"

namespace concave_distance::random_solids_test {
namespace {

/// A box with corners on the grid of metres, or the half of it below its diagonal plane along one axis.
struct Block {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  int wedge_axis;  ///< -1: the whole box

  bool contains(const Eigen::Vector3d& p) const {
    const bool in_box = (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
    return in_box && (wedge_axis < 0 || heightOverDiagonal(p) <= 0.0);
  }
  double heightOverDiagonal(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d share = (p - low).cwiseQuotient(high - low);
    return share[wedge_axis] + share[(wedge_axis + 1) % 3] - 1.0;
  }
  bool isNearItsSurface(const Eigen::Vector3d& p, double margin) const {
    const bool near_box =
        ((p - low).array().abs() < margin).any() || ((p - high).array().abs() < margin).any();
    return near_box || (wedge_axis >= 0 && std::abs(heightOverDiagonal(p)) < margin);
  }
  ExactSolid solid() const {
    ExactSolid box = ExactSolid::fromMesh(test::makeCuboid(low, high), "block");
    if (wedge_axis < 0) return box;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (const int axis : {wedge_axis, (wedge_axis + 1) % 3}) normal[axis] = 1.0 / (high[axis] - low[axis]);
    return box.below(normal, normal.dot(low) + 1.0);
  }
};

Block randomBlock(RandomEngine& engine) {
  Block block;
  for (int axis = 0; axis < 3; ++axis) {
    block.low[axis] = uniformIndex(engine, 3);
    // Sizes of powers of two keep the wedges' planes exact.
    block.high[axis] = block.low[axis] + (uniformIndex(engine, 2) == 0 ? 1.0 : 2.0);
  }
  block.wedge_axis = static_cast<int>(uniformIndex(engine, 4)) - 1;
  return block;
}

/// A box, less some blocks, and some put into it again: faces in common planes, solids that touch themselves
/// along edges and in points, cavities, islands.
struct RandomSolid {
  std::vector<Block> taken;
  std::vector<Block> added;
  Eigen::AlignedBox3d box{Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(4)};

  bool contains(const Eigen::Vector3d& p) const {
    const auto holds = [&](const Block& block) { return block.contains(p); };
    return box.contains(p) && (std::none_of(taken.begin(), taken.end(), holds) ||
                               std::any_of(added.begin(), added.end(), holds));
  }
  bool isNearASurface(const Eigen::Vector3d& p) const {
    constexpr double kMargin = 1e-4;  // ten times what the tree's planes may be off
    const auto near = [&](const Block& block) { return block.isNearItsSurface(p, kMargin); };
    return std::any_of(taken.begin(), taken.end(), near) || std::any_of(added.begin(), added.end(), near) ||
           (p - box.min()).array().abs().minCoeff() < kMargin ||
           (p - box.max()).array().abs().minCoeff() < kMargin;
  }
  ExactSolid solid() const {
    const ExactSolid whole = ExactSolid::fromMesh(test::makeCuboid(box.min(), box.max()), "whole");
    ExactSolid hole = whole.minus(whole);
    for (const Block& block : taken) hole = whole.minus(whole.minus(hole).minus(block.solid()));
    for (const Block& block : added) hole = hole.minus(block.solid());
    return whole.minus(hole);
  }
};

TEST(RandomConcaveSolids, HaveTreesThatHoldExactlyTheirPoints) {
  std::size_t concave = 0;
  std::size_t fallbacks = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    RandomEngine engine(seed);
    RandomSolid random;
    for (int i = 0; i < 4; ++i) random.taken.push_back(randomBlock(engine));
    for (int i = 0; i < 2; ++i) random.added.push_back(randomBlock(engine));
    const BuiltTree built = buildTreeOf(random.solid(), random.box, {}, "random solid");
    const test::InsideComparison compared = test::compareInside(
        built.tree, 2000, seed, [&](const Eigen::Vector3d& p) { return random.contains(p); },
        [&](const Eigen::Vector3d& p) { return random.isNearASurface(p); });
    EXPECT_EQ(compared.wrong, 0) << "seed " << seed << ", first at " << compared.first_wrong.transpose()
                                 << "; " << built.report.summary();
    EXPECT_GT(compared.compared, 1900) << seed;
    concave += built.tree.pieces().size() > 2 ? 1U : 0U;
    fallbacks += built.report.fallbacks.size();
  }
  EXPECT_GT(concave, 10u);
  EXPECT_GT(fallbacks, 0u);
}

}  // namespace
}  // namespace concave_distance::random_solids_test

#include "concave_distance/kinematics/constraint_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "concave_distance/base/error.h"
#include "support/box_scene.h"
#include "support/concave_shapes.h"
#include "support/count_allocations.h"
#include "support/mesh_variants.h"
#include "support/row_differences.h"
#include "support/scene_fixture.h"

namespace concave_distance::constraint_rows_test {
namespace {

constexpr double kTilt = 1e-5;

/// A box of 0.2 m that is tilted about x and y, raised and turned above a plate that is on no robot.
std::string tiltingRobot(const std::string& geometry) {
  const auto link = [](const std::string& name, const std::string& content = "") {
    return "<link name='" + name + "'>" + content + "</link>";
  };
  return "<robot name='tilter'>" + link("floor") + link("mast") + link("gimbal") + link("table") +
         link("cube", "<collision>" + geometry + "</collision>") +
         test::movingJoint("raise", "prismatic", "floor", "mast", "<axis xyz='0 0 1'/>") +
         test::movingJoint("tilt_x", "revolute", "mast", "gimbal", "<axis xyz='1 0 0'/>") +
         test::movingJoint("tilt_y", "revolute", "gimbal", "table", "<axis xyz='0 1 0'/>") +
         test::movingJoint("slide", "prismatic", "table", "cube", "<axis xyz='1 0 0'/>") + "</robot>";
}

class ConstraintRowsTest : public test::SceneTest {
 protected:
  void setUp(const std::string& plate, std::uint32_t capacity = 16,
             const std::string& geometry = "<geometry><box size='0.2 0.2 0.1'/></geometry>") {
    setUp(loadTilter(plate, geometry), capacity);
  }
  Scene loadTilter(const std::string& plate, const std::string& geometry, const std::string& defaults = "") {
    options.descriptions["robot"] = tiltingRobot(geometry);
    return load(defaults + "robots:\n  - {description: robot}\nbodies:\n  - {name: plate, frame: world, " +
                plate + "}\n");
  }
  void setUp(Scene loaded, std::uint32_t capacity) {
    scene = std::move(loaded);
    joints = std::make_shared<const SceneKinematics>(scene);
    tracker.setScene(scene);
    state = joints->startState();
    ConstraintSettings settings;
    settings.distance = 0.5;
    settings.capacity = capacity;
    rows.emplace(joints, settings);
  }
  void cycle(double raise, double tilt_x, double tilt_y, double slide = 0.0) {
    joints->evaluate(Eigen::Vector4d(raise, tilt_x, tilt_y, slide), state);
    time += 0.01;
    tracker.update(state.world_from_body, time);
    rows->update(tracker.pairs(), state, time);
  }
  std::vector<std::size_t> used() const {
    std::vector<std::size_t> slots;
    for (std::size_t i = 0; i < rows->rows().size(); ++i) {
      if (rows->rows()[i].state == SlotState::Used) slots.push_back(i);
    }
    return slots;
  }

  Scene scene;
  std::shared_ptr<const SceneKinematics> joints;
  SceneTracker tracker{{1, nullptr}};
  SceneState state;
  std::optional<ConstraintRows> rows;
  double time = 0.0;
};

constexpr const char* kPlate = "box: {size: [2, 2, 0.1]}, pose: {xyz: [0, 0, -0.05]}";

/// The heights of the lower corners of the cube above the plate, and how they change with the joints.
struct Corner {
  double height;
  Eigen::RowVector4d gradient;
};
Corner cornerAt(const Eigen::Vector4d& joints, double x, double y) {
  const double px = x + joints[3];
  const double cx = std::cos(joints[1]);
  const double sx = std::sin(joints[1]);
  const double cy = std::cos(joints[2]);
  const double sy = std::sin(joints[2]);
  // z of Rx * Ry * (px, y, -0.05): Ry first, then Rx.
  const double z = -sy * px - 0.05 * cy;
  const double dz = -cy * px + 0.05 * sy;
  return {joints[0] + sx * y + cx * z, {1.0, cx * y - sx * z, cx * dz, -cx * sy}};
}

TEST_F(ConstraintRowsTest, GivesTheCornersOfFacesThatAreNearlyParallel) {
  setUp(kPlate);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const double size = trial == 0 ? 0.0 : 5.0 * kTilt;
    const Eigen::Vector4d at(0.2 + 0.1 * unit(engine), size * unit(engine), size * unit(engine),
                             0.2 * unit(engine));
    cycle(at[0], at[1], at[2], at[3]);
    const auto slots = used();
    ASSERT_EQ(slots.size(), 4U) << at.transpose();
    std::set<std::pair<bool, bool>> seen;
    for (const std::size_t slot : slots) {
      const ConstraintRow& row = rows->rows()[slot];
      const Eigen::Vector3d& in_cube =
          row.pair->body_a->name == "cube" ? row.point_a_in_frame : row.point_b_in_frame;
      ASSERT_NEAR(std::abs(in_cube.x()), 0.1, 1e-12);
      ASSERT_NEAR(std::abs(in_cube.y()), 0.1, 1e-12);
      seen.insert({in_cube.x() > 0.0, in_cube.y() > 0.0});
      const Corner corner = cornerAt(at, in_cube.x(), in_cube.y());
      ASSERT_NEAR(row.value, corner.height, 1e-13);
      const Eigen::RowVector4d found = rows->jacobian().row(static_cast<Eigen::Index>(slot));
      ASSERT_LT((found - corner.gradient).cwiseAbs().maxCoeff(), 1e-11) << found << "\n" << corner.gradient;
    }
    ASSERT_EQ(seen.size(), 4U);
  }
}

TEST_F(ConstraintRowsTest, GivesTheEndsOfACylinderThatLiesNearlyLevel) {
  setUp(kPlate, 16,
        "<origin rpy='1.5707963267948966 0 0'/><geometry><cylinder radius='0.05' length='0.2'/></geometry>");
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector4d at(0.2 + 0.1 * unit(engine), 5.0 * kTilt * unit(engine), 2.0 * unit(engine), 0.0);
    cycle(at[0], at[1], at[2], at[3]);
    ASSERT_EQ(used().size(), 2U) << at.transpose();
    for (const std::size_t slot : used()) {
      const ConstraintRow& row = rows->rows()[slot];
      const bool is_a = row.pair->body_a->name == "cube";
      const Eigen::Vector3d& on_cylinder = is_a ? row.point_a_in_frame : row.point_b_in_frame;
      ASSERT_NEAR(std::abs(on_cylinder.y()), 0.1, 1e-12);
      // The end of the axis is at y, and the side hangs 0.05 below it, across the tilted axis.
      const double y = on_cylinder.y();
      const double cosine = std::cos(at[1]);
      ASSERT_NEAR(row.value, at[0] + std::sin(at[1]) * y - 0.05 * cosine, 1e-13);
      const Eigen::RowVector4d found = rows->jacobian().row(static_cast<Eigen::Index>(slot));
      const Eigen::RowVector4d expected(1.0, cosine * y + 0.05 * std::sin(at[1]), 0.0,
                                        -cosine * std::sin(at[2]));
      ASSERT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-11) << found << "\n" << expected;
    }
  }
}

TEST_F(ConstraintRowsTest, GivesTheRimOfACylinderThatStandsNearlyUpright) {
  setUp(kPlate, 16, "<geometry><cylinder radius='0.1' length='0.1'/></geometry>");
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const double size = trial == 0 ? 0.0 : 3.0 * kTilt;
    const Eigen::Vector4d at(0.2 + 0.1 * unit(engine), size * unit(engine), size * unit(engine),
                             0.2 * unit(engine));
    cycle(at[0], at[1], at[2], at[3]);
    ASSERT_GE(used().size(), 3U) << at.transpose();
    ASSERT_LE(used().size(), 9U) << "eight corners and the closest points, which lie between two of them";
    for (const std::size_t slot : used()) {
      const ConstraintRow& row = rows->rows()[slot];
      const Eigen::Vector3d& in_cube =
          row.pair->body_a->name == "cube" ? row.point_a_in_frame : row.point_b_in_frame;
      ASSERT_LE(in_cube.head<2>().norm(), 0.1 + 1e-12);
      const Corner corner = cornerAt(at, in_cube.x(), in_cube.y());
      ASSERT_NEAR(row.value, corner.height, 1e-13);
      const Eigen::RowVector4d found = rows->jacobian().row(static_cast<Eigen::Index>(slot));
      ASSERT_LT((found - corner.gradient).cwiseAbs().maxCoeff(), 1e-11) << found << "\n" << corner.gradient;
    }
  }
}

constexpr const char* kLyingCylinder =
    "<origin rpy='1.5707963267948966 0 0'/><geometry><cylinder radius='0.05' length='0.2'/></geometry>";

// The fixed cylinder lies along y too, from -0.05 to 0.25: one corner is the end of either.
TEST_F(ConstraintRowsTest, GivesTheEndsOfWhatTwoParallelCylindersShare) {
  setUp("cylinder: {radius: 0.1, length: 0.3}, pose: {xyz: [0, 0.1, -0.1], rpy: [1.5707963267948966, 0, 0]}",
        16, kLyingCylinder);
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const double tilt = trial == 0 ? 0.0 : 5.0 * kTilt * unit(engine);
    const double raise = 0.2 + 0.1 * unit(engine);
    const double roll = 2.0 * unit(engine);
    cycle(raise, tilt, roll);
    ASSERT_EQ(used().size(), 2U) << raise << " " << tilt;
    std::set<bool> seen;
    for (const std::size_t slot : used()) {
      const ConstraintRow& row = rows->rows()[slot];
      const bool is_a = row.pair->body_a->name == "cube";
      const Eigen::Vector3d& on_fixed = is_a ? row.point_b : row.point_a;
      const double c = std::cos(tilt);
      const double s = std::sin(tilt);
      const bool is_of_robot = on_fixed.y() > 0.0;
      seen.insert(is_of_robot);
      // Its own end, 0.05 below the axis, over the fixed one's top; or that one's end below the tilted axis.
      const double value = is_of_robot ? raise + 0.1 * s - 0.05 * c : raise * c - 0.05 * s - 0.05;
      const double by_raise = is_of_robot ? 1.0 : c;
      const double by_tilt = is_of_robot ? 0.1 * c + 0.05 * s : -raise * s - 0.05 * c;
      ASSERT_NEAR(on_fixed.y(), is_of_robot ? 0.1 : -0.05, 1e-5);
      ASSERT_NEAR(row.value, value, 1e-12);
      const Eigen::RowVector4d found = rows->jacobian().row(static_cast<Eigen::Index>(slot));
      ASSERT_NEAR(found[0], by_raise, 1e-10);
      ASSERT_NEAR(found[1], by_tilt, 1e-9);
      ASSERT_NEAR(found[2], 0.0, 1e-9) << "it rolls about its axis";
    }
    ASSERT_EQ(seen.size(), 2U);
  }
}

TEST_F(ConstraintRowsTest, GivesTheEndsOfTheChordOfAFlatEndAboveACylinder) {
  setUp("cylinder: {radius: 0.1, length: 1.0}, pose: {xyz: [0.06, 0, -0.1], rpy: [1.5707963267948966, 0, 0]}",
        16, "<geometry><cylinder radius='0.1' length='0.1'/></geometry>");
  for (const double tilt : {0.0, 3e-5, -3e-5}) {
    cycle(0.2, tilt, 0.0);
    // Tilted, the disc's closest point lies 2e-6 beside one end, and is nearer by 3e-12.
    ASSERT_GE(used().size(), 2U);
    ASSERT_LE(used().size(), tilt == 0.0 ? 2U : 3U);
    std::set<bool> sides;
    for (const std::size_t slot : used()) {
      const ConstraintRow& row = rows->rows()[slot];
      ASSERT_NEAR(std::abs(row.point_a.y()), 0.08, 1e-5) << "of a circle of 0.1 at 0.06 from its centre";
      ASSERT_NEAR(row.point_a.x(), 0.06, 1e-5);
      sides.insert(row.point_a.y() > 0.0);
      const Corner corner = cornerAt({0.2, tilt, 0.0, 0.0}, 0.06, row.point_a.y());
      ASSERT_NEAR(row.value, corner.height, 1e-9);
      const Eigen::RowVector4d found = rows->jacobian().row(static_cast<Eigen::Index>(slot));
      ASSERT_LT((found - corner.gradient).cwiseAbs().maxCoeff(), 1e-4) << found << "\n" << corner.gradient;
    }
    ASSERT_EQ(sides.size(), 2U);
  }
}

// Two discs share a lens; between eight points around it nothing is farther out than by a twelfth of a
// radius.
TEST_F(ConstraintRowsTest, GivesPointsAroundWhatTwoFlatEndsShare) {
  for (const double offset : {0.0, 0.03, 0.12}) {
    setUp("cylinder: {radius: 0.15, length: 0.1}, pose: {xyz: [" + std::to_string(offset) + ", 0, -0.05]}",
          16, "<geometry><cylinder radius='0.1' length='0.1'/></geometry>");
    for (const double tilt : {0.0, 2e-5}) {
      cycle(0.2, tilt, 0.5 * tilt);
      ASSERT_GE(used().size(), 3U);
      ASSERT_LE(used().size(), 9U);
      for (const std::size_t slot : used()) {
        const ConstraintRow& row = rows->rows()[slot];
        const Eigen::Vector3d& in_cube =
            row.pair->body_a->name == "cube" ? row.point_a_in_frame : row.point_b_in_frame;
        ASSERT_LE(in_cube.head<2>().norm(), 0.1 + 1e-9);
        ASSERT_LE((in_cube.head<2>() - Eigen::Vector2d(offset, 0.0)).norm(), 0.15 + 1e-5);
        const Corner corner = cornerAt({0.2, tilt, 0.5 * tilt, 0.0}, in_cube.x(), in_cube.y());
        ASSERT_NEAR(row.value, corner.height, 1e-9);
      }
      for (int k = 0; k < 360; ++k) {
        const Eigen::Vector2d direction(std::cos(k * M_PI / 180.0), std::sin(k * M_PI / 180.0));
        double of_lens = -1.0;
        for (int i = 0; i < 360; ++i) {
          const Eigen::Vector2d on_rim(std::cos(i * M_PI / 180.0), std::sin(i * M_PI / 180.0));
          const Eigen::Vector2d of_small = 0.1 * on_rim;
          const Eigen::Vector2d of_large = Eigen::Vector2d(offset, 0.0) + 0.15 * on_rim;
          if ((of_small - Eigen::Vector2d(offset, 0.0)).norm() <= 0.15)
            of_lens = std::max(of_lens, direction.dot(of_small));
          if (of_large.norm() <= 0.1) of_lens = std::max(of_lens, direction.dot(of_large));
        }
        double of_rows = -1.0;
        for (const std::size_t slot : used())
          of_rows = std::max(of_rows, direction.dot(rows->rows()[slot].point_a.head<2>()));
        ASSERT_NEAR(of_rows, of_lens, 0.15 / 12.0 + 1e-3) << offset << " at " << k;
      }
    }
  }
}

TEST_F(ConstraintRowsTest, GivesOneRowWhereTwoCylindersCross) {
  setUp("cylinder: {radius: 0.1, length: 0.3}, pose: {xyz: [0, 0, -0.1], rpy: [0, 1.5707963267948966, 0]}",
        16, kLyingCylinder);
  cycle(0.2, 0.0, 0.0);
  EXPECT_EQ(used().size(), 1U);
}

// One row for the niche would move its point by 0.2 m.
TEST_F(ConstraintRowsTest, KeepsTheRowsOfAPatchInTheirSlotsWhereItTiltsToTheOtherSide) {
  setUp(kPlate);
  cycle(0.2, kTilt, kTilt);
  const auto slots = used();
  ASSERT_EQ(slots.size(), 4U);
  std::vector<ConstraintRow> before = rows->rows();
  Eigen::MatrixXd gradients = rows->jacobian();
  for (int k = 1; k <= 20; ++k) {
    cycle(0.2, kTilt * (1.0 - 0.1 * k), kTilt * std::cos(k));
    ASSERT_EQ(used(), slots);
    for (const std::size_t slot : slots) {
      const ConstraintRow& row = rows->rows()[slot];
      EXPECT_EQ(row.age, static_cast<std::uint64_t>(k));
      EXPECT_LT((row.point_b_in_frame - before[slot].point_b_in_frame).norm(), 1e-5);
      EXPECT_LT(std::abs(row.value - before[slot].value), 1e-5);
    }
    EXPECT_LT((rows->jacobian() - gradients).cwiseAbs().maxCoeff(), 1e-4);
    before = rows->rows();
    gradients = rows->jacobian();
  }
}

TEST_F(ConstraintRowsTest, GivesTheCornersOfTwoFacesThatOverlapInPart) {
  setUp("box: {size: [0.2, 0.2, 0.1]}, pose: {xyz: [0.1, 0.05, -0.05], rpy: [0, 0, 0.3]}");
  cycle(0.2, 0.0, 0.0);
  const auto slots = used();
  EXPECT_GE(slots.size(), 4U);
  EXPECT_LE(slots.size(), 8U);
  for (const std::size_t slot : slots) {
    const ConstraintRow& row = rows->rows()[slot];
    EXPECT_NEAR(row.value, 0.15, 1e-12);
    EXPECT_NEAR(std::abs(row.normal.z()), 1.0, 1e-9);
    EXPECT_LT((row.point_a - row.point_b).head<2>().norm(), 1e-9);
  }
}

TEST_F(ConstraintRowsTest, GivesTheEndsOfAnEdgeThatIsParallelToAFace) {
  setUp(kPlate);
  cycle(0.3, 0.3, 0.0);
  ASSERT_EQ(used().size(), 2U);
  for (const std::size_t slot : used()) {
    const ConstraintRow& row = rows->rows()[slot];
    EXPECT_NEAR(std::abs(row.point_a.x()), 0.1, 1e-12);
  }
}

constexpr const char* kBox = "<geometry><box size='0.2 0.2 0.1'/></geometry>";
constexpr const char* kSigned = "defaults: {expert: {signed_values: true}}\n";

// The lowest corner of the cube is the deepest place; the plate lies still.
TEST_F(ConstraintRowsTest, HasTheSignedValueAndItsGradientWhereBodiesOverlap) {
  setUp(loadTilter(kPlate, kBox, kSigned), 16);
  constexpr double kStep = 1e-5;
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    Eigen::Vector4d at(0.0, 0.3 + 0.1 * unit(engine), 0.3 + 0.1 * unit(engine), 0.1 * unit(engine));
    const Corner above = cornerAt(at, at[2] > 0.0 ? 0.1 : -0.1, at[1] > 0.0 ? -0.1 : 0.1);
    at[0] = -above.height - 0.01 * (1.5 + unit(engine));  // 5 to 25 mm deep
    const Corner corner = cornerAt(at, at[2] > 0.0 ? 0.1 : -0.1, at[1] > 0.0 ? -0.1 : 0.1);
    ASSERT_LT(corner.height, -0.004);
    cycle(at[0], at[1], at[2], at[3]);
    ASSERT_EQ(used().size(), 1U);
    const std::size_t slot = used().front();
    const ConstraintRow row = rows->rows()[slot];
    const Eigen::RowVector4d found = rows->jacobian().row(static_cast<Eigen::Index>(slot));
    EXPECT_FALSE(row.is_overlapping);
    EXPECT_NEAR(row.value, corner.height, 1e-10);
    EXPECT_EQ(row.point_a, row.point_b) << "the pivot is both points";
    EXPECT_NEAR(std::abs(row.normal.z()), 1.0, 1e-9);
    EXPECT_LT((found - corner.gradient).cwiseAbs().maxCoeff(), 1e-8) << found << "\n" << corner.gradient;
    for (Eigen::Index joint = 0; joint < 4; ++joint) {
      const auto value_at = [&](double step) {
        Eigen::Vector4d moved = at;
        moved[joint] += step;
        cycle(moved[0], moved[1], moved[2], moved[3]);
        return used().size() == 1 ? rows->rows()[used().front()].value : NAN;
      };
      const double difference = (value_at(kStep) - value_at(-kStep)) / (2.0 * kStep);
      EXPECT_NEAR(found[joint], difference, 1e-5) << "joint " << joint;
    }
  }
}

/// A table with a long and a short leg, its top 0.05 above the short one's end.
SurfaceMesh unequalLegs(bool is_mirrored) {
  test::Outline outline = {{-0.1, 0.0},  {-0.04, 0.0}, {-0.04, 0.1}, {0.04, 0.1},
                           {0.04, 0.02}, {0.1, 0.02},  {0.1, 0.15},  {-0.1, 0.15}};
  if (is_mirrored) {
    for (Eigen::Vector2d& corner : outline) corner.x() *= -1.0;
    std::reverse(outline.begin(), outline.end());
  }
  return test::movedSurface(test::makeExtrusion(outline, 0.1),
                            Eigen::Isometry3d(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX())));
}

// Where the table's top meets the plate too, the regions of both legs become one, and part again.
TEST_F(ConstraintRowsTest, BeginsItsAgeAnewWhereTheSignedValueJumps) {
  int jumps = 0;
  int others = 0;
  for (const bool is_mirrored : {false, true}) {
    Scene loaded = loadTilter("box: {size: [2, 2, 1]}, pose: {xyz: [0, 0, -0.5]}", kBox, kSigned);
    const std::size_t cube = *loaded.findBody("cube");
    loaded.bodies.edit(cube).mesh = std::make_shared<const BodyMesh>("table", unequalLegs(is_mirrored));
    loaded.bodies.edit(cube).bounds = boundsOf(*loaded.bodies[cube].mesh);
    setUp(std::move(loaded), 16);
    std::vector<ConstraintRow> before = rows->rows();
    for (int k = 0; k <= 120; ++k) {
      SCOPED_TRACE(k);
      cycle(0.03 - 0.0025 * (k <= 60 ? k : 120 - k), 0.0, 0.0);
      for (const std::size_t slot : used()) {
        const ConstraintRow& row = rows->rows()[slot];
        const ConstraintRow& last = before[slot];
        if (last.state != SlotState::Used || last.niche_id != row.niche_id) continue;
        const bool has_jumped = std::abs(row.value - last.value) > 0.0026;
        EXPECT_EQ(row.age, has_jumped ? 0U : last.age + 1) << "from " << last.value << " to " << row.value;
        ++(has_jumped ? jumps : others);
      }
      before = rows->rows();
    }
    rows->update(tracker.pairs(), state, time);
    for (const std::size_t slot : used()) EXPECT_EQ(rows->rows()[slot].age, before[slot].age + 1);
  }
  EXPECT_GE(jumps, 1);
  EXPECT_GE(others, 100);
}

TEST_F(ConstraintRowsTest, SaysHowFastOtherBodiesAndRootsApproach) {
  setUp(kPlate);
  cycle(0.3, 0.2, 0.1);
  EXPECT_TRUE(std::isnan(rows->rows()[used().front()].drift)) << "no pose before this one";
  cycle(0.31, 0.2, 0.1);
  EXPECT_NEAR(rows->rows()[used().front()].drift, 0.0, 1e-12) << "a joint alone moved";
  const std::size_t plate = *scene.findBody("plate");
  state.world_from_body[plate] =
      Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.002)) * *state.world_from_body[plate];
  cycle(0.31, 0.2, 0.1);
  EXPECT_NEAR(rows->rows()[used().front()].drift, 0.2, 1e-9) << "the plate came closer by 2 mm in 10 ms";
  state.robots[0].world_from_link.front() = Eigen::Translation3d(0, 0, 0.001);
  cycle(0.31, 0.2, 0.1);
  EXPECT_NEAR(rows->rows()[used().front()].drift, -0.1, 1e-9) << "the robot was lifted by 1 mm";
}

TEST_F(ConstraintRowsTest, GoOnThroughEditsOfTheScene) {
  setUp(kPlate);
  cycle(0.3, 0.2, 0.1);
  const auto slots = used();
  Scene edited;
  SceneBody first = unitBox("first");
  edited = scene;
  edited.bodies = {};
  edited.bodies.push_back(first);
  for (const SceneBody& body : scene.bodies) edited.bodies.push_back(body);
  for (PairRule& rule : edited.rules.list) {
    for (BodySet* side : {&rule.earlier, &rule.later}) {
      std::vector<std::size_t> bodies = side->indices();
      for (std::size_t& body : bodies) ++body;
      *side = BodySet(bodies);
    }
  }
  const std::size_t plate = *edited.findBody("plate");
  edited.bodies.edit(plate).frame_from_body =
      Eigen::Translation3d(0, 0, 0.002) * Eigen::Isometry3d::Identity();
  joints = std::make_shared<const SceneKinematics>(edited);
  tracker.setScene(edited);
  rows->setScene(joints);
  const SceneState old = state;
  EXPECT_THROW(rows->update(tracker.pairs(), old, time), Error) << "a state of the scene before";
  state = joints->startState();
  cycle(0.3, 0.2, 0.1);
  EXPECT_EQ(used(), slots);
  EXPECT_EQ(rows->rows()[slots.front()].age, 1U);
  EXPECT_NEAR(rows->rows()[slots.front()].drift, 0.2, 1e-9) << "the edit has lifted the plate by 2 mm";
}

TEST_F(ConstraintRowsTest, ReportsRowsWithoutASlot) {
  setUp(kPlate, 3);
  cycle(0.2, 2.0 * kTilt, kTilt);
  EXPECT_EQ(rows->overflow(), 1U);
  ASSERT_EQ(used().size(), 3U);
  double farthest = 0.0;
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-0.1, 0.1}) {
      farthest = std::max(farthest, cornerAt({0.2, 2.0 * kTilt, kTilt, 0.0}, x, y).height);
    }
  }
  for (const std::size_t slot : used()) EXPECT_LT(rows->rows()[slot].value, farthest - 1e-7);
}

TEST_F(ConstraintRowsTest, FreesRowsOfBodiesThatAreNowhereAndMarksTheirSlots) {
  setUp(kPlate);
  cycle(0.2, 0.1, 0.2);
  const auto slots = used();
  ASSERT_FALSE(slots.empty());
  state.world_from_body[*scene.findBody("plate")].reset();
  cycle(0.2, 0.1, 0.2);
  EXPECT_TRUE(used().empty());
  EXPECT_EQ(rows->rows()[slots.front()].state, SlotState::Freed);
  EXPECT_EQ(rows->rows()[slots.front()].pair, nullptr);
  EXPECT_TRUE(rows->jacobian().isZero(0.0));
}

TEST_F(ConstraintRowsTest, AllocatesNothingInAWarmCycle) {
  setUp(kPlate);
  const auto move = [&] {
    for (int i = 0; i < 20; ++i) cycle(0.2, kTilt * std::cos(i), kTilt * std::sin(i), 0.01 * i);
  };
  move();
  move();
  const std::size_t before = allocations;
  move();
  EXPECT_EQ(allocations, before);
}

TEST_F(ConstraintRowsTest, RefusesSettingsThatGiveNoRows) {
  setUp(kPlate);
  for (const ConstraintSettings& wrong :
       {ConstraintSettings{0.0, 8}, ConstraintSettings{-1.0, 8}, ConstraintSettings{NAN, 8},
        ConstraintSettings{0.1, 0}, ConstraintSettings{0.1, 100'001}}) {
    EXPECT_THROW(ConstraintRows(joints, wrong), Error);
  }
}

TEST(ConstraintRows, AreTheDifferencesOfDistancesOfThreeRobots) {
  constexpr double kDistance = 0.2;
  for (const test::RowScene& given : test::rowScenes(kDistance)) {
    const test::RowDifferences found = test::differencesAtRandom(given, kDistance, 40, 7);
    EXPECT_GT(found.rows, 40U) << given.name;
    EXPECT_LT(found.unclear, found.entries / 100) << given.name;
    EXPECT_LT(found.worst, 1e-6) << given.name;
  }
}

}  // namespace
}  // namespace concave_distance::constraint_rows_test

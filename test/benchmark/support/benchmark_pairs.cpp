#include "benchmark/support/benchmark_pairs.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/random_engine.h"
#include "benchmark/support/shapes.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "loading/query_poses.h"
#include "support/concave_shapes.h"
#include "support/mesh_variants.h"

namespace concave_distance::benchmark {
namespace {

using Motion = std::function<Eigen::Isometry3d(double)>;

std::string sourceFile(const std::string& relative) {
  return std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/" + relative;
}

SurfaceMesh loadSurface(const std::string& relative) {
  const std::string path = sourceFile(relative);
  return repairMesh(importMesh(path), {}, path).mesh;
}

Eigen::Isometry3d poseOf(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = position;
  return pose;
}

Eigen::Vector3d randomDirection(RandomEngine& engine) {
  const double z = 2.0 * uniformUnit(engine) - 1.0;
  const double angle = 2.0 * kPi * uniformUnit(engine);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Eigen::Quaterniond randomRotation(RandomEngine& engine) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(2.0 * kPi * uniformUnit(engine), randomDirection(engine)) *
                            Eigen::AngleAxisd(2.0 * kPi * uniformUnit(engine), randomDirection(engine)));
}

// B's centre moves around A's on a tilted loop that breathes while B turns: about two diameters long.
Motion loopAround(const BodyMesh& a, const BodyMesh& b, std::uint64_t seed, double reach) {
  RandomEngine engine(seed);
  const Eigen::Vector3d centre_a = a.surface().boundingBox().center();
  const Eigen::Vector3d centre_b = b.surface().boundingBox().center();
  const Eigen::Quaterniond tilt = randomRotation(engine);
  const Eigen::Quaterniond start = randomRotation(engine);
  const Eigen::Vector3d axis = randomDirection(engine);
  return [=](double t) {
    const double angle = 1.6 * kPi * t;
    const double breath = 1.0 + 0.15 * std::sin(3.0 * kPi * t);
    const Eigen::Vector3d displacement(std::cos(angle), std::sin(angle), 0.4 * std::sin(2.0 * kPi * t));
    const Eigen::Quaterniond rotation = Eigen::Quaterniond(Eigen::AngleAxisd(1.2 * t, axis)) * start;
    return poseOf(centre_a + reach * breath * (tilt * displacement) - rotation * centre_b, rotation);
  };
}

// The loop drawn in until its closest instant is within 2 to 5 % of A's diameter.
Motion loopNear(const BenchmarkPair& pair, std::uint64_t seed) {
  const double size = pair.a->diameter();
  double low = 0.0;
  double high = pair.a->diameter() + pair.b->diameter();
  for (int step = 0; step < 40; ++step) {
    const double reach = 0.5 * (low + high);
    const Motion motion = loopAround(*pair.a, *pair.b, seed, reach);
    double closest = size;
    for (int k = 0; k <= 100 && closest > 0.0; ++k) {
      closest = std::min(closest, fclDistance(*pair.fcl_a, *pair.fcl_b, motion(k / 100.0)).distance);
    }
    if (closest > 0.05 * size) {
      high = reach;
    } else if (closest < 0.02 * size) {
      low = reach;
    } else {
      return motion;
    }
  }
  return loopAround(*pair.a, *pair.b, seed, high);
}

Motion interpolated(std::vector<TimedPose> poses) {
  return [poses = std::move(poses)](double t) {
    const double place = t * static_cast<double>(poses.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(place), poses.size() - 2);
    const double share = place - static_cast<double>(k);
    const Eigen::Isometry3d& from = poses[k].pose;
    const Eigen::Isometry3d& to = poses[k + 1].pose;
    return poseOf((1.0 - share) * from.translation() + share * to.translation(),
                  Eigen::Quaterniond(from.linear()).slerp(share, Eigen::Quaterniond(to.linear())));
  };
}

struct Surfaces {
  SurfaceMesh a;
  SurfaceMesh b;
};

struct Recipe {
  const char* name;
  std::function<Surfaces()> surfaces;
  std::function<Motion(const BenchmarkPair&)> motion;
};

std::function<Motion(const BenchmarkPair&)> loop(std::uint64_t seed) {
  return [seed](const BenchmarkPair& pair) { return loopNear(pair, seed); };
}

std::function<Motion(const BenchmarkPair&)> always(Motion motion) {
  return [motion = std::move(motion)](const BenchmarkPair&) { return motion; };
}

std::function<Motion(const BenchmarkPair&)> fromFile(const std::string& file) {
  return [file](const BenchmarkPair&) -> Motion {
    const std::vector<TimedPose> poses = readPosePath(sourceFile(file));
    if (poses.size() == 1) {
      return [pose = poses.front().pose](double) { return pose; };
    }
    return interpolated(poses);
  };
}

std::function<Surfaces()> files(const std::string& a, const std::string& b) {
  return [=] { return Surfaces{loadSurface(a), loadSurface(b)}; };
}

Eigen::Isometry3d pegPose(double t) {
  // Clearance 0.01: the peg swings and shifts within it while it goes in and out.
  const double depth = 0.55 - 0.45 * (1.0 - std::cos(2.0 * kPi * t)) / 2.0;
  const Eigen::Vector3d shift(0.003 * std::cos(9.0 * t), 0.003 * std::sin(7.0 * t), depth);
  return poseOf(shift,
                Eigen::Quaterniond(Eigen::AngleAxisd(0.004 * std::sin(5.0 * t), Eigen::Vector3d::UnitX()) *
                                   Eigen::AngleAxisd(2.0 * t, Eigen::Vector3d::UnitZ())));
}

Eigen::Isometry3d hookPose(double t) {
  // B's ring passes through A's, a quarter turned, and swings.
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitX()));
  const Eigen::Quaterniond swing(Eigen::AngleAxisd(0.35 * std::sin(2.0 * kPi * t), Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(0.3 * std::cos(3.0 * kPi * t), Eigen::Vector3d::UnitX()));
  return poseOf({0.52 + 0.05 * std::cos(4.0 * t), 0.03 * std::sin(5.0 * t), 0.03 * std::sin(3.0 * t)},
                swing * turned);
}

Eigen::Isometry3d combPose(double t) {
  // Teeth 0.1 wide in gaps of 0.15, turned about z by half a turn: parallel walls 0.025 apart.
  const double displacement = 0.5 * (1.0 - std::cos(2.0 * kPi * t));
  const Eigen::Quaterniond rotation(
      Eigen::AngleAxisd(kPi + 0.004 * std::sin(4.0 * t), Eigen::Vector3d::UnitZ()));
  return poseOf({1.225 + 0.008 * std::sin(6.0 * t), 0.55 + 0.3 * displacement, 0.02 * std::sin(3.0 * t)},
                rotation);
}

SurfaceMesh put(const SurfaceMesh& surface, double x, double y, double z) {
  return moved(surface, poseOf({x, y, z}, Eigen::Quaterniond::Identity()));
}

/// Shells that cross each other, as links modelled of primitives: a cylinder and two spheres.
SurfaceMesh makePill() {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  const SurfaceMesh ball = makeSphere(0.09, 5e-4);
  return test::makeJoined(test::makeJoined(makeCylinder(0.09, 0.14, 1e-4), put(ball, 0.0, 0.0, 0.07), none),
                          put(ball, 0.0, 0.0, -0.07), none);
}

/// A hand of two fingers, a palm and a wrist: eight shells.
SurfaceMesh makeHandOfPrimitives() {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  SurfaceMesh hand = put(makeCylinder(0.04, 0.1, 1e-4), 0.0, 0.0, 0.04);
  const auto add = [&](const SurfaceMesh& part) { hand = test::makeJoined(hand, part, none); };
  for (const double end : {0.09, -0.01}) add(put(makeSphere(0.04, 3e-4), 0.0, 0.0, end));
  add(put(makeBox({0.04, 0.2, 0.08}), 0.0, 0.0, 0.02));
  for (const double side : {0.07, -0.07}) {
    add(put(makeCylinder(0.02, 0.06, 1e-4), 0.0, side, 0.09));
    add(put(makeSphere(0.02, 2e-4), 0.0, side, 0.12));
  }
  return hand;
}

/// B swings before A at about this distance of their centres, metres, and turns.
std::function<Motion(const BenchmarkPair&)> swinging(double reach, double width) {
  return always([=](double t) {
    const double s = 4.0 * t;
    const Eigen::Vector3d axis(1.0, 0.4 * std::sin(s), 0.3);
    return poseOf({reach + width * std::sin(1.1 * s), 1.5 * width * std::sin(0.7 * s), width * std::cos(s)},
                  Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * s, axis.normalized())));
  });
}

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> kRecipes = {
      {"notched_boxes", files("meshes/thesis/box.stl", "meshes/thesis/notched_box.stl"),
       fromFile("meshes/thesis/boxes_position_1.csv")},
      {"grooved_cylinder", files("meshes/thesis/semi_extruded.stl", "meshes/thesis/grooved_cylinder.stl"),
       fromFile("meshes/thesis/cylinder_position_2.csv")},
      {"battery_fixture", files("meshes/thesis/fixture.stl", "meshes/thesis/battery.stl"),
       fromFile("meshes/thesis/battery_static.csv")},
      {"battery_insertion", files("meshes/thesis/fixture.stl", "meshes/thesis/battery.stl"),
       fromFile("meshes/thesis/manoeuvre_200.csv")},
      {"kr5_bicep_palm", files("meshes/kr5/bicep.stl", "meshes/kr5/palm.stl"), loop(11)},
      {"kr5_base_forearm", files("meshes/kr5/base_link.stl", "meshes/kr5/forearm.stl"), loop(12)},
      {"kr5_shoulder_elbow", files("meshes/kr5/shoulder.stl", "meshes/kr5/elbow.stl"), loop(13)},
      {"wam3_wam5", files("meshes/wam/wam3.stl", "meshes/wam/wam5.stl"), loop(14)},
      {"wam_base_wam4", files("meshes/wam/wam_base.stl", "meshes/wam/wam4.stl"), loop(15)},
      {"wam1_wam6", files("meshes/wam/wam1.stl", "meshes/wam/wam6.stl"), loop(16)},
      {"peg_in_hole",
       [] {
         return Surfaces{makeTube(0.3, 0.16, 0.8, 96),
                         makeCylinder(0.15, 1.0, 0.15 * (1.0 - std::cos(kPi / 96)))};
       },
       always(pegPose)},
      {"linked_hooks",
       [] {
         return Surfaces{makeHook(0.5, 0.08, 0.2, 72, 24), makeHook(0.5, 0.08, 0.2, 72, 24)};
       },
       always(hookPose)},
      {"comb_in_comb",
       [] {
         return Surfaces{test::makeComb(5), test::makeComb(5)};
       },
       always(combPose)},
      {"stairs_leg",
       [] {
         return Surfaces{test::makeStairs(7),
                         moved(test::makeComb(4, 0.08, 0.2, 0.5),
                               poseOf(Eigen::Vector3d::Zero(), Eigen::Quaterniond(0.9, 0.2, 0.3, 0.1)))};
       },
       loop(21)},
      {"obstacle_field",
       [] {
         return Surfaces{makePyramidField(6, 8, 0.25, 5), makePyramidField(3, 4, 0.35, 9)};
       },
       always([](double t) {
         const Eigen::Quaterniond over(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()));
         const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.15 * std::sin(3.0 * t), Eigen::Vector3d::UnitX()) *
                                       Eigen::AngleAxisd(0.5 + t, Eigen::Vector3d::UnitZ()));
         return poseOf({0.4 * std::cos(4.0 * t), 0.3 * std::sin(3.0 * t), 0.95}, tilt * over);
       })},
      {"hulls_1k",
       [] {
         return Surfaces{test::makeDentedEllipsoid({0.2, 0.15, 0.3}, 6e-3, 0.0, 1),
                         test::makeDentedEllipsoid({0.25, 0.2, 0.1}, 6e-3, 0.0, 1)};
       },
       swinging(0.6, 0.1)},
      {"hulls_6k",
       [] {
         return Surfaces{test::makeDentedEllipsoid({0.2, 0.15, 0.3}, 1e-3, 0.0, 1),
                         test::makeDentedEllipsoid({0.25, 0.2, 0.1}, 1e-3, 0.0, 1)};
       },
       swinging(0.6, 0.1)},
      {"hulls_with_dents",
       [] {
         return Surfaces{test::makeDentedEllipsoid({0.2, 0.15, 0.3}, 1e-3, 5e-3, 149),
                         test::makeDentedEllipsoid({0.25, 0.2, 0.1}, 1e-3, 5e-3, 149)};
       },
       swinging(0.6, 0.1)},
      {"boxes_overlap",
       [] {
         return Surfaces{makeBox({0.2, 0.3, 0.4}), makeBox({0.4, 0.2, 0.2})};
       },
       swinging(0.2, 0.05)},
      {"spheres_overlap",
       [] {
         return Surfaces{makeSphere(0.2, 1e-3), makeSphere(0.15, 1e-3)};
       },
       swinging(0.25, 0.03)},
      {"primitives_apart",
       [] {
         return Surfaces{makePill(), makeHandOfPrimitives()};
       },
       swinging(0.35, 0.1)},
      {"primitives_overlap",
       [] {
         return Surfaces{makePill(), makeHandOfPrimitives()};
       },
       swinging(0.16, 0.03)},
  };
  return kRecipes;
}

}  // namespace

std::vector<std::string> simplePairs() {
  return {"hulls_1k",        "hulls_6k",         "hulls_with_dents",  "boxes_overlap",
          "spheres_overlap", "primitives_apart", "primitives_overlap"};
}

std::vector<std::string> allPairs() {
  const std::vector<std::string> simple = simplePairs();
  std::vector<std::string> names;
  for (const Recipe& recipe : recipes()) {
    if (std::find(simple.begin(), simple.end(), recipe.name) == simple.end()) names.emplace_back(recipe.name);
  }
  return names;
}

BenchmarkPair loadBenchmarkPair(const std::string& name, std::optional<double> max_edge_length) {
  for (const Recipe& recipe : recipes()) {
    if (recipe.name != name) {
      continue;
    }
    Surfaces surfaces = recipe.surfaces();
    BodyMeshOptions options;
    options.max_edge_length = max_edge_length;
    BenchmarkPair pair;
    pair.name = name;
    pair.fcl_a = makeFclModel(surfaces.a);
    pair.fcl_b = makeFclModel(surfaces.b);
    pair.a = std::make_shared<BodyMesh>(name + "/a", std::move(surfaces.a), options);
    pair.b = std::make_shared<BodyMesh>(name + "/b", std::move(surfaces.b), options);
    pair.motion = recipe.motion(pair);
    return pair;
  }
  throw Error(name, "no benchmark pair has this name", "see test/benchmark/support/benchmark_pairs.cpp");
}

std::vector<Eigen::Isometry3d> randomPoses(const BenchmarkPair& pair, std::size_t count, std::uint64_t seed) {
  RandomEngine engine(streamSeed(seed, pair.name, 0));
  const Eigen::Vector3d centre_a = pair.a->surface().boundingBox().center();
  const Eigen::Vector3d centre_b = pair.b->surface().boundingBox().center();
  std::vector<Eigen::Isometry3d> poses;
  while (poses.size() < count) {
    const Eigen::Quaterniond rotation = randomRotation(engine);
    const double reach = 0.5 * uniformUnit(engine) * (pair.a->diameter() + pair.b->diameter());
    const Eigen::Isometry3d pose =
        poseOf(centre_a + reach * randomDirection(engine) - rotation * centre_b, rotation);
    const double distance = fclDistance(*pair.fcl_a, *pair.fcl_b, pose).distance;
    if (distance > 1e-4 * pair.a->diameter() && distance <= 0.5 * pair.a->diameter()) {
      poses.push_back(pose);
    }
  }
  return poses;
}

}  // namespace concave_distance::benchmark

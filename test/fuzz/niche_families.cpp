#include "fuzz/niche_families.h"

#include <cmath>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "fuzz/niche_enumeration.h"
#include "fuzz/niche_shapes.h"
#include "fuzz/overlap_family.h"
#include "support/body_pairs.h"
#include "support/mesh_variants.h"
#include "support/random_solids.h"

namespace concave_distance::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kCycles = 8;
/// The enumeration's work; larger scenes are drawn again.
constexpr std::size_t kMostPairs = 6000;

SurfaceMesh imported(const SurfaceMesh& mesh) {
  TriangleSoup soup;
  soup.vertices = mesh.vertices();
  for (const TriangleNodes& t : mesh.triangles())
    soup.triangles.push_back({t[0].value, t[1].value, t[2].value});
  return repairMesh(soup, {}, "drawn").mesh;
}

/// A motion from a pose on: at rest, by roundings, by steps, turned.
void walk(RandomEngine& engine, double size, bool turns, NicheScene& scene) {
  while (scene.poses.size() < kCycles) {
    Isometry3d pose = scene.poses.back();
    const std::uint32_t kind = uniformIndex(engine, 8);
    const double step = kind < 2 ? powerOfTen(engine, -16.0, -9.0) : powerOfTen(engine, -6.0, -0.5);
    if (kind > 0) pose.translation() += size * step * randomRotation(engine).col(0);
    if (turns && kind > 4) {
      const Eigen::AngleAxisd turn(powerOfTen(engine, -15.0, -0.5), randomRotation(engine).col(0));
      pose.linear() =
          Eigen::Quaterniond(turn.toRotationMatrix() * pose.linear()).normalized().toRotationMatrix();
    }
    scene.poses.push_back(pose);
  }
}

/// B beside A in a random direction: they overlap, or there is a gap.
NicheScene besideEachOther(RandomEngine& engine, const SurfaceMesh& a, const SurfaceMesh& b) {
  NicheScene scene{a, b, {Isometry3d::Identity()}};
  const double size = 0.5 * (a.diameter() + b.diameter());
  Isometry3d& pose = scene.poses.front();
  const Eigen::Matrix3d turn = randomRotation(engine);
  pose.linear() = turn;
  const double least = uniformIndex(engine, 3) == 0 ? 0.3 : 0.8;
  const Vector3d away = randomRotation(engine).col(0) * size * uniformIn(engine, least, 1.6);
  pose.translation() = a.boundingBox().center() - turn * b.boundingBox().center() + away;
  return scene;
}

NicheScene drawNearEdge(RandomEngine& engine) {
  const SurfaceMesh a = quarterTurned(engine, plainShape(engine));
  NicheScene scene{a, spikesOver(engine, a), {Isometry3d::Identity()}};
  while (scene.poses.size() < kCycles) {
    Isometry3d pose = Isometry3d::Identity();
    pose.translation() = powerOfTen(engine, -15.0, -3.0) * randomRotation(engine).col(0);
    if (uniformIndex(engine, 3) == 0) pose.translation() += Vector3d::UnitX() * uniformIn(engine, -0.1, 0.1);
    if (uniformIndex(engine, 4) == 0) {
      pose.linear() = Eigen::AngleAxisd(powerOfTen(engine, -15.0, -6.0), randomRotation(engine).col(0))
                          .toRotationMatrix();
    }
    scene.poses.push_back(pose);
  }
  return scene;
}

Isometry3d latticePose(RandomEngine& engine, double cell, int reach) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = quarterTurn(engine);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    pose.translation()[axis] =
        cell * (static_cast<double>(uniformIndex(engine, static_cast<std::uint32_t>(2 * reach + 1))) - reach);
  }
  return pose;
}

NicheScene onALattice(RandomEngine& engine, const SurfaceMesh& a, const SurfaceMesh& b, double cell,
                      int reach, double noise) {
  NicheScene scene{a, b, {}};
  while (scene.poses.size() < kCycles) {
    Isometry3d pose = latticePose(engine, cell, reach);
    if (!scene.poses.empty() && uniformIndex(engine, 3) > 0) {
      pose = scene.poses.back();
      pose.translation()[uniformIndex(engine, 3)] += uniformIndex(engine, 2) == 0 ? cell : -cell;
    }
    if (noise > 0.0) {
      pose.translation() += uniformInCube(engine, powerOfTen(engine, -15.0, std::log10(noise)));
      if (uniformIndex(engine, 2) == 0) {
        const Eigen::AngleAxisd turn(uniformUnit(engine) * noise, randomRotation(engine).col(0));
        pose.linear() = turn.toRotationMatrix() * pose.linear();
      }
    }
    scene.poses.push_back(pose);
  }
  return scene;
}

NicheScene drawGrazing(RandomEngine& engine) {
  const SurfaceMesh a = plainShape(engine);
  return onALattice(engine, a, plainShape(engine), 0.125, 12, 1e-12);
}

NicheScene drawLattice(RandomEngine& engine) {
  const SurfaceMesh a = concaveShape(uniformIndex(engine, 4));
  return onALattice(engine, a, concaveShape(uniformIndex(engine, 4)), 0.05, 24, 0.0);
}

NicheScene drawCoplanar(RandomEngine& engine) {
  const bool is_soup = uniformIndex(engine, 3) == 0;
  const SurfaceMesh a = is_soup ? latticeSoup(engine) : skyline(engine);
  const SurfaceMesh b = is_soup && uniformIndex(engine, 2) == 0 ? latticeSoup(engine) : skyline(engine);
  return onALattice(engine, a, b, 1.0, 6, 0.0);
}

NicheScene drawConcave(RandomEngine& engine) {
  const SurfaceMesh a = randomSolid(engine);
  const SurfaceMesh b = randomSolid(engine);
  NicheScene scene = besideEachOther(engine, a, b);
  walk(engine, 0.3, true, scene);
  return scene;
}

/// Rings with lobes: many niches, which come and go.
NicheScene drawRings(RandomEngine& engine) {
  const auto ring = [&] {
    const double lobes = 2.0 + uniformIndex(engine, 3);
    const double depth = uniformIn(engine, 0.3, 0.8);
    const std::uint32_t around = 7 + uniformIndex(engine, 4);
    return makeRingOfTube(1.0, around, 3 + uniformIndex(engine, 2), [&](double along, double over) {
      return 0.4 * (1.0 - depth * std::abs(std::sin(lobes * along + over)));
    });
  };
  const SurfaceMesh a = ring();
  const SurfaceMesh b = ring();
  NicheScene scene = besideEachOther(engine, a, b);
  walk(engine, 1.0, true, scene);
  return scene;
}

/// A family's scene in other units, modelled far from the origins of its frames.
NicheScene drawFar(RandomEngine& engine) {
  NicheScene scene;
  switch (uniformIndex(engine, 3)) {
    case 0:
      scene = drawNearEdge(engine);
      break;
    case 1:
      scene = drawGrazing(engine);
      break;
    default:
      scene = drawConcave(engine);
  }
  const bool is_large = uniformIndex(engine, 2) == 0;
  const double scale = is_large ? 16.0 : 1e-5;
  const auto place = [&] { return uniformInCube(engine, is_large ? 5e5 : 1e3); };
  const Vector3d at_a = place();
  const Vector3d at_b = uniformIndex(engine, 4) == 0 ? Vector3d::Zero() : place();
  const auto moved = [&](const SurfaceMesh& mesh, const Vector3d& to) {
    return withVertices(mesh, "far", [&](const Vector3d& v) { return Vector3d(scale * v + to); });
  };
  scene.a = moved(scene.a, at_a);
  scene.b = moved(scene.b, at_b);
  for (Isometry3d& pose : scene.poses) {
    pose.translation() = scale * pose.translation() + at_a - pose.linear() * at_b;
  }
  return scene;
}

NicheScene drawTouching(RandomEngine& engine) {
  NicheScene scene = uniformIndex(engine, 3) == 0 ? drawLattice(engine) : drawConcave(engine);
  const WideBody a(scene.a);
  const WideBody b(scene.b);
  for (Isometry3d& pose : scene.poses) {
    if (uniformIndex(engine, 4) == 0) continue;
    const NicheEnumeration enumeration(a, b, pose);
    const auto closest = enumeration.minimisers(enumeration.niches(0.0).front().cells.front());
    if (closest.empty()) continue;
    const WidePoint gap = closest.front().b - closest.front().a;
    const Vector3d back(static_cast<double>(gap.x), static_cast<double>(gap.y), static_cast<double>(gap.z));
    const double left = uniformIndex(engine, 2) == 0 ? 0.0 : powerOfTen(engine, -16.0, -3.0);
    pose.translation() -= back * (1.0 + (uniformIndex(engine, 2) == 0 ? left : -left));
  }
  return scene;
}

NicheScene drawNeedles(RandomEngine& engine) {
  const SurfaceMesh a = uniformIndex(engine, 2) == 0 ? needleSoup(engine) : spikyPrism(engine);
  const SurfaceMesh b = uniformIndex(engine, 3) == 0 ? needleSoup(engine) : spikyPrism(engine);
  NicheScene scene = besideEachOther(engine, a, b);
  walk(engine, 0.5, true, scene);
  return scene;
}

NicheScene drawSoup(RandomEngine& engine) {
  const SurfaceMesh a = randomSoup(engine);
  const SurfaceMesh b = randomSoup(engine);
  NicheScene scene = besideEachOther(engine, a, b);
  walk(engine, 1.0, true, scene);
  return scene;
}

/// A shape beside another of its kind or a plain one, at random or on a lattice of `cells` eighths.
template <typename Draw>
NicheScene drawBesideAnother(RandomEngine& engine, std::uint32_t cells, const Draw& draw) {
  const SurfaceMesh a = draw(engine);
  const SurfaceMesh b = uniformIndex(engine, 2) == 0 ? plainShape(engine) : draw(engine);
  if (uniformIndex(engine, 2) == 0) return onALattice(engine, a, b, 0.125, cells, 0.0);
  NicheScene scene = besideEachOther(engine, a, b);
  walk(engine, 0.3, true, scene);
  return scene;
}

NicheScene drawSelfTouching(RandomEngine& engine) {
  return drawBesideAnother(engine, 14, selfTouchingShape);
}

NicheScene drawShells(RandomEngine& engine) {
  return drawBesideAnother(engine, 16, severalShells);
}

NicheScene drawUnions(RandomEngine& engine) {
  const SurfaceMesh a = unionOfConvexSolids(engine);
  const SurfaceMesh b = uniformIndex(engine, 2) == 0 ? plainShape(engine) : unionOfConvexSolids(engine);
  NicheScene scene;
  if (uniformIndex(engine, 2) == 0) {
    scene = onALattice(engine, a, b, 0.125, 16, 1e-6);
  } else {
    scene = besideEachOther(engine, a, b);
    walk(engine, 0.3, true, scene);
  }
  scene.shells_cross = true;
  return scene;
}

/// A block with two bumps below a plate: two niches where the bumps are higher than a hundredth of the gap,
/// from which their heights differ by 1e-6 to 0.5 of it.
NicheScene drawBumps(RandomEngine& engine) {
  const double gap = powerOfTen(engine, -3.0, 0.3);
  const auto height = [&] {
    const double beyond = powerOfTen(engine, -6.0, -0.3);
    return 1e-2 * gap * (uniformIndex(engine, 2) == 0 ? 1.0 + beyond : 1.0 - beyond);
  };
  const double heights[] = {height(), height()};
  const SurfaceMesh block = halvedEdges(halvedEdges(makeCuboid({-0.5, -0.5, -1.0}, {0.5, 0.5, 0.0})));
  const SurfaceMesh a = withVertices(block, "bumps", [&](const Vector3d& v) {
    const bool is_bump = v.z() == 0.0 && v.x() == v.y() && std::abs(v.x()) == 0.25;
    return is_bump ? Vector3d(v + heights[v.x() < 0.0 ? 0 : 1] * Vector3d::UnitZ()) : v;
  });
  NicheScene scene{a, makeCuboid({-0.6, -0.6, 0.0}, {0.6, 0.6, 0.2}), {Isometry3d::Identity()}};
  scene.poses.front().translation().z() = gap;
  walk(engine, 1e-2 * gap, false, scene);
  return scene;
}

/// The face of a tetrahedron above a block whose top leans down by 1e-9 to 1e-4 towards a groove or a pit of
/// 1e-7 to 0.05 in the middle: both sides support the hull and tie within the lean, and the way between them
/// rises by the depth.
NicheScene drawDents(RandomEngine& engine) {
  const double lean = powerOfTen(engine, -9.0, -4.0);
  const double depth = powerOfTen(engine, -6.0, -1.3);
  const bool is_pit = uniformIndex(engine, 3) == 0;
  const double place = 0.25 * static_cast<double>(uniformIndex(engine, 3)) - 0.25;
  const SurfaceMesh block = halvedEdges(halvedEdges(makeCuboid({-0.5, -0.5, -1.0}, {0.5, 0.5, 0.0})));
  const SurfaceMesh a = withVertices(block, "dents", [&](const Vector3d& v) {
    if (v.z() != 0.0) return v;
    const bool is_dent = v.x() == place && (!is_pit || v.y() == 0.0);
    return Vector3d(v - (lean * (0.5 - std::abs(v.x())) + (is_dent ? depth : 0.0)) * Vector3d::UnitZ());
  });
  const SurfaceMesh plate = makeSurface({{-2, -2, 0}, {2, -2, 0}, {0, 3, 0}, {0, 0, 1}},
                                        {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  NicheScene scene{a, plate, {Isometry3d::Identity()}};
  // Towards the dents, or to where they are farther away.
  const double turn = uniformIndex(engine, 3) == 0 ? 0.0 : lean * powerOfTen(engine, -4.0, 2.0);
  Vector3d up = Vector3d::UnitZ() + turn * (Vector3d::UnitX() + uniformInCube(engine, 0.3));
  const bool is_away = uniformIndex(engine, 2) == 0;
  if (is_away) up = Vector3d::UnitZ() + uniformInCube(engine, 1.0);
  up.normalize();
  double reach = 0.0;
  for (const Vector3d& v : a.vertices()) reach = std::max(reach, up.dot(v));
  scene.poses.front() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up) *
                        Eigen::Translation3d(0.0, 0.0, reach + powerOfTen(engine, -4.0, -0.5));
  walk(engine, is_away ? 1e-2 : lean, false, scene);
  return scene;
}

/// At distances at which the surfaces' gaps to their hulls decide whether there is a second niche.
NicheScene drawNearlyConvex(RandomEngine& engine) {
  if (uniformIndex(engine, 2) == 0) return drawBumps(engine);
  const SurfaceMesh a = nearlyConvexShape(engine);
  const SurfaceMesh b = nearlyConvexShape(engine);
  NicheScene scene = besideEachOther(engine, a, b);
  if (uniformIndex(engine, 2) == 0) {
    scene.poses.front().translation() *= 1.0 + powerOfTen(engine, -3.0, 1.0);
  }
  walk(engine, 0.5, true, scene);
  return scene;
}

NicheScene drawOverlap(RandomEngine& engine) {
  NicheScene scene = drawOverlappingPair(engine);
  walk(engine, 0.5 * scene.b.diameter(), true, scene);
  return scene;
}

/// The surfaces of clouds come so from the node: not repaired.
NicheScene drawVoxels(RandomEngine& engine) {
  for (;;) {
    const SurfaceMesh a = voxelUnion(engine);
    const bool two = uniformIndex(engine, 2) == 0;
    const SurfaceMesh b = two ? voxelUnion(engine) : imported(plainShape(engine));
    if (a.triangleCount() * b.triangleCount() > kMostPairs) continue;
    if (uniformIndex(engine, 2) == 0) return onALattice(engine, a, b, 0.125, 10, 1e-12);
    NicheScene scene = besideEachOther(engine, a, b);
    walk(engine, 0.25, true, scene);
    return scene;
  }
}

/// Draws until the enumeration can afford it and repair leaves something; the surfaces are as from a file.
template <NicheScene (*draw)(RandomEngine&)>
NicheScene affordable(RandomEngine& engine) {
  for (;;) {
    NicheScene scene = draw(engine);
    if (scene.a.triangleCount() * scene.b.triangleCount() > kMostPairs) continue;
    try {
      scene.a = imported(scene.a);
      scene.b = imported(scene.b);
      return scene;
    } catch (const Error&) {
      // Needles of which repair leaves none.
    }
  }
}

}  // namespace

const std::vector<NicheFamily>& nicheFamilies() {
  static const std::vector<NicheFamily> families{
      {"near_edge", "apexes with a foot 1e-14 to 1e-3 beside edges and corners", affordable<drawNearEdge>},
      {"grazing", "aligned shapes with up to 1e-12 of noise", affordable<drawGrazing>},
      {"coplanar", "towers with tops in one plane, triangles on a lattice", affordable<drawCoplanar>},
      {"far", "bodies of 16 m at 5e5 m, of 1e-5 m at 1e3 m", affordable<drawFar>},
      {"touching", "led to contact, with gaps and depths from 0 on", affordable<drawTouching>},
      {"needles", "thin triangles and spikes", affordable<drawNeedles>},
      {"lattice", "concave shapes in line", affordable<drawLattice>},
      {"soup", "loose triangles", affordable<drawSoup>},
      {"self_touching", "shells that touch themselves or each other, flaps", affordable<drawSelfTouching>},
      {"shells", "several shells, apart, nested, hollow", affordable<drawShells>},
      {"unions", "unions of convex solids that cross each other", affordable<drawUnions>},
      {"concave", "random concave solids", affordable<drawConcave>},
      {"nearly_convex", "solids with dents and bumps of 1e-15 to 0.3", affordable<drawNearlyConvex>},
      {"dents", "a face above a block whose halves tie beside a groove or pit", affordable<drawDents>},
      {"rings", "rings with lobes: many niches", affordable<drawRings>},
      {"overlap", "rods through plates, combs, rings, hollow bodies, sheets, unions",
       affordable<drawOverlap>},
      {"voxels", "cells that share faces, edges or corners, in line and turned", drawVoxels}};
  return families;
}

const NicheFamily& nicheFamily(const std::string& name) {
  for (const NicheFamily& family : nicheFamilies()) {
    if (name == family.name) return family;
  }
  throw Error("family", "there is no family '" + name + "'", "see niche_hunt --help");
}

}  // namespace concave_distance::test

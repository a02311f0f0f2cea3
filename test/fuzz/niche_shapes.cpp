#include "fuzz/niche_shapes.h"

#include "concave_distance/mesh/surface/voxels.h"

#include <algorithm>
#include <cmath>

#include "fuzz/wide_body.h"
#include "support/body_pairs.h"
#include "support/mesh_variants.h"
#include "support/random_solids.h"

namespace concave_distance::test {
namespace {

using Eigen::Vector3d;

/// A whole number of eighths.
double eighths(RandomEngine& engine, std::uint32_t least, std::uint32_t most) {
  return 0.125 * (least + uniformIndex(engine, most - least + 1));
}

Vector3d latticePoint(RandomEngine& engine, std::uint32_t least, std::uint32_t most) {
  const double x = eighths(engine, least, most);
  const double y = eighths(engine, least, most);
  return {x, y, eighths(engine, least, most)};
}

SurfaceMesh latticeBox(RandomEngine& engine) {
  return makeCuboid(Vector3d::Zero(), latticePoint(engine, 1, 8));
}

SurfaceMesh spike(const Vector3d& apex, const Vector3d& along, double length, double width) {
  const Vector3d side = along.unitOrthogonal() * width;
  const Vector3d other = along.cross(side);
  const Vector3d end = apex + length * along;
  return makeSurface({apex, end + side, end - 0.5 * side + 0.8 * other, end - 0.5 * side - 0.8 * other},
                     {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
}

bool isApart(const SurfaceMesh& l, const SurfaceMesh& r) {
  const WideBody wide_l(l);
  const WideBody wide_r(r);
  for (const WideTriangle& of_l : wide_l.triangles()) {
    for (const WideTriangle& of_r : wide_r.triangles()) {
      if (exactSquaredDistance(of_l, of_r) < 1e-6L) return false;
    }
  }
  return true;
}

}  // namespace

Eigen::Matrix3d quarterTurn(RandomEngine& engine) {
  const std::uint32_t first = uniformIndex(engine, 3);
  const std::uint32_t second = (first + 1 + uniformIndex(engine, 2)) % 3;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  turn(first, 0) = uniformIndex(engine, 2) == 0 ? 1.0 : -1.0;
  turn(second, 1) = uniformIndex(engine, 2) == 0 ? 1.0 : -1.0;
  turn.col(2) = turn.col(0).cross(turn.col(1));
  return turn;
}

SurfaceMesh quarterTurned(RandomEngine& engine, const SurfaceMesh& mesh) {
  const Eigen::Matrix3d turn = quarterTurn(engine);
  return withVertices(mesh, "turned", [&](const Vector3d& v) { return Vector3d(turn * v); });
}

SurfaceMesh plainShape(RandomEngine& engine) {
  const bool is_on_lattice = uniformIndex(engine, 2) == 0;
  const auto size = [&](std::uint32_t least, std::uint32_t most) {
    return is_on_lattice ? eighths(engine, least, most) : uniformIn(engine, 0.125 * least, 0.125 * most);
  };
  const double first = size(1, 3);
  const double second = size(1, 3);
  const double third = size(1, 5);
  switch (uniformIndex(engine, 5)) {
    case 0:
      return makeLShape(size(4, 7), first, third);
    case 1:
      return makeStairs(2 + static_cast<int>(uniformIndex(engine, 2)), first, second, third);
    case 2:
      return makeComb(2 + static_cast<int>(uniformIndex(engine, 2)), first, second, third, first, second);
    default:
      return makeCuboid(Vector3d::Zero(), {size(1, 8), second, third});
  }
}

SurfaceMesh spikesOver(RandomEngine& engine, const SurfaceMesh& mesh) {
  std::vector<SurfaceMesh> spikes;
  const std::uint32_t wanted = 1 + uniformIndex(engine, 4);
  for (int attempt = 0; attempt < 100 && spikes.size() < wanted; ++attempt) {
    const TriangleIndex t{uniformIndex(engine, static_cast<std::uint32_t>(mesh.triangleCount()))};
    const auto k = static_cast<int>(uniformIndex(engine, 3));
    const Vector3d from = mesh.corner(t, k);
    const Vector3d to = mesh.corner(t, (k + 1) % 3);
    const Vector3d normal = (to - from).cross(mesh.corner(t, (k + 2) % 3) - from).normalized();
    const Vector3d inwards = normal.cross((to - from).normalized());
    const double offset = powerOfTen(engine, -14.0, -3.0);
    double along = uniformUnit(engine);
    if (uniformIndex(engine, 3) == 0) along = powerOfTen(engine, -14.0, -3.0);
    if (uniformIndex(engine, 6) == 0) along = 0.5;
    const Vector3d foot =
        from + along * (to - from) + (uniformIndex(engine, 8) == 0 ? -offset : offset) * inwards;
    const double height =
        uniformIndex(engine, 3) == 0 ? powerOfTen(engine, -3.0, 1.5) : eighths(engine, 1, 24);
    const double length = uniformIn(engine, 0.1, 1.0);
    SurfaceMesh next = spike(foot + height * normal, normal, length, uniformIn(engine, 0.02, 0.1));
    const bool is_free =
        isApart(next, mesh) && std::all_of(spikes.begin(), spikes.end(),
                                           [&](const SurfaceMesh& other) { return isApart(next, other); });
    if (is_free) spikes.push_back(std::move(next));
  }
  if (spikes.empty()) return makeCuboid(Vector3d(2, 2, 2), Vector3d(3, 3, 3));
  SurfaceMesh all = spikes.front();
  for (std::size_t i = 1; i < spikes.size(); ++i) all = makeJoined(all, spikes[i]);
  return all;
}

SurfaceMesh skyline(RandomEngine& engine) {
  const std::uint32_t towers = 2 + uniformIndex(engine, 4);
  Outline outline{{0.0, 0.0}, {static_cast<double>(towers), 0.0}};
  for (std::uint32_t i = towers; i-- > 0;) {
    const double height = 1.0 + uniformIndex(engine, 3);
    for (const double x : {i + 1.0, i + 0.0}) {
      if (outline.back() != Eigen::Vector2d(x, height)) outline.emplace_back(x, height);
    }
  }
  // Corners in one line would make triangles without area.
  Outline corners;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d before = outline[(i + outline.size() - 1) % outline.size()];
    const Eigen::Vector2d after = outline[(i + 1) % outline.size()];
    if (parts::turn(before, outline[i], after) != 0.0) corners.push_back(outline[i]);
  }
  return makeExtrusion(corners, 2.0 * (1 + uniformIndex(engine, 2)));
}

SurfaceMesh latticeSoup(RandomEngine& engine) {
  std::vector<TrianglePoints> triangles;
  const std::uint32_t count = 2 + uniformIndex(engine, 5);
  while (triangles.size() < count) {
    const auto corner = [&] {
      const double x = uniformIndex(engine, 4);
      const double y = uniformIndex(engine, 4);
      return Vector3d(x, y, uniformIndex(engine, 4));
    };
    TrianglePoints t;
    for (Vector3d& point : t) point = corner();
    if ((t[1] - t[0]).cross(t[2] - t[0]).norm() > 0.0) triangles.push_back(t);
  }
  return surfaceOf(triangles);
}

SurfaceMesh randomSoup(RandomEngine& engine) {
  std::vector<TrianglePoints> triangles;
  const std::uint32_t count = 1 + uniformIndex(engine, 12);
  while (triangles.size() < count) triangles.push_back(randomTriangle(engine));
  return surfaceOf(triangles);
}

SurfaceMesh needleSoup(RandomEngine& engine) {
  std::vector<TrianglePoints> triangles;
  const std::uint32_t count = 1 + uniformIndex(engine, 10);
  while (triangles.size() < count) {
    const TrianglePoints flat = flatTriangle(engine, powerOfTen(engine, -8.0, 0.0));
    triangles.push_back(moved(flat, randomRotation(engine), uniformInCube(engine, 1.0)));
  }
  return surfaceOf(triangles);
}

namespace {

/// A cube of which one triangle's edge is cut in two for the triangle on its other side alone.
SurfaceMesh withCornerOnEdge(RandomEngine& engine) {
  const SurfaceMesh box = latticeBox(engine);
  std::vector<Vector3d> vertices = box.vertices();
  std::vector<TriangleNodes> triangles = box.triangles();
  const std::uint32_t cuts = 1 + uniformIndex(engine, 2);
  for (std::uint32_t cut = 0; cut < cuts; ++cut) {
    const std::size_t t = uniformIndex(engine, 12);
    const std::size_t k = uniformIndex(engine, 3);
    const TriangleNodes nodes = triangles[t];
    const NodeIndex middle{vertices.size()};
    const double share = 0.25 * (1 + uniformIndex(engine, 3));
    const Vector3d from = vertices[nodes[k].value];
    vertices.emplace_back(from + share * (vertices[nodes[(k + 1) % 3].value] - from));
    triangles[t] = {nodes[k], middle, nodes[(k + 2) % 3]};
    triangles.push_back({middle, nodes[(k + 1) % 3], nodes[(k + 2) % 3]});
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "cut box");
}

/// A triangle that stands on a face of a box.
SurfaceMesh withFlap(RandomEngine& engine) {
  const SurfaceMesh box = latticeBox(engine);
  const TriangleIndex t{uniformIndex(engine, 12)};
  const Vector3d middle = 0.5 * box.corner(t, 0) + 0.25 * (box.corner(t, 1) + box.corner(t, 2));
  const Vector3d end =
      uniformIndex(engine, 2) == 0 ? box.corner(t, 2) : Vector3d(0.5 * (middle + box.corner(t, 1)));
  const Vector3d normal =
      (box.corner(t, 1) - box.corner(t, 0)).cross(box.corner(t, 2) - box.corner(t, 0)).normalized();
  const double height = eighths(engine, 1, 4);
  const Vector3d top = middle + height * normal + eighths(engine, 0, 2) * Vector3d(1, 1, 1);
  return makeJoined(box, makeSurface({middle, end, top}, {{0, 1, 2}}));
}

/// A second box against the first: face on face, edge or corner.
SurfaceMesh twoBoxes(RandomEngine& engine) {
  const SurfaceMesh first = latticeBox(engine);
  const Vector3d size = first.boundingBox().sizes();
  Vector3d offset = latticePoint(engine, 0, 4);
  const std::uint32_t axes = 1 + uniformIndex(engine, 3);
  for (std::uint32_t i = 0; i < axes; ++i) offset[i] = size[i];
  return makeJoined(first, latticeBox(engine), offset);
}

/// A box, or a polyhedron with corners on an ellipsoid.
SurfaceMesh convexSolid(RandomEngine& engine) {
  const Vector3d sizes(uniformIn(engine, 0.1, 0.5), uniformIn(engine, 0.1, 0.5), uniformIn(engine, 0.1, 0.5));
  SurfaceMesh mesh = makeCuboid(-sizes, sizes);
  if (uniformIndex(engine, 2) == 0) {
    const SurfaceMesh octahedron =
        makeSurface({Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ(), -Vector3d::UnitX(),
                     -Vector3d::UnitY(), -Vector3d::UnitZ()},
                    {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}});
    mesh = withVertices(halvedEdges(octahedron), "ball",
                        [&](const Vector3d& v) { return Vector3d(v.normalized().cwiseProduct(sizes)); });
  } else if (uniformIndex(engine, 2) == 0) {
    mesh = halvedEdges(mesh);
  }
  return mesh;
}

}  // namespace

SurfaceMesh selfTouchingShape(RandomEngine& engine) {
  switch (uniformIndex(engine, 3)) {
    case 0:
      return withCornerOnEdge(engine);
    case 1:
      return withFlap(engine);
    default:
      return twoBoxes(engine);
  }
}

SurfaceMesh nearlyConvexShape(RandomEngine& engine) {
  const SurfaceMesh mesh = convexSolid(engine);
  const std::uint32_t moved_share = uniformIndex(engine, 3);
  const double depth = powerOfTen(engine, -15.0, -0.5);
  return withVertices(mesh, "nearly convex", [&](const Vector3d& v) {
    if (uniformIndex(engine, 4) >= moved_share) return v;
    return Vector3d(v * (1.0 + (uniformIndex(engine, 3) == 0 ? depth : -depth)));
  });
}

SurfaceMesh severalShells(RandomEngine& engine) {
  const std::uint32_t kind = uniformIndex(engine, 4);
  if (kind == 0) return randomHollowBox(engine);
  if (kind == 1) {
    const SurfaceMesh outer = makeCuboid(Vector3d::Zero(), Vector3d(1, 1, 1));
    return makeJoined(outer, makeCuboid(Vector3d::Zero(), Vector3d(0.25, 0.375, 0.25)),
                      latticePoint(engine, 1, 4));
  }
  SurfaceMesh all = plainShape(engine);
  const std::uint32_t more = 1 + uniformIndex(engine, 3);
  for (std::uint32_t i = 0; i < more; ++i) {
    // Beyond what is there along one axis.
    Vector3d offset = latticePoint(engine, 0, 4);
    const SurfaceMesh next = plainShape(engine);
    const std::uint32_t axis = uniformIndex(engine, 3);
    offset[axis] = all.boundingBox().max()[axis] - next.boundingBox().min()[axis] + eighths(engine, 1, 3);
    all = makeJoined(all, next, offset);
  }
  return all;
}

SurfaceMesh unionOfConvexSolids(RandomEngine& engine) {
  const std::uint32_t kind = uniformIndex(engine, 3);
  const auto solid = [&]() -> SurfaceMesh {
    if (kind == 0) return latticeBox(engine);
    const SurfaceMesh next = convexSolid(engine);
    if (kind == 1) return quarterTurned(engine, next);
    const Eigen::Matrix3d turn = randomRotation(engine);
    return withVertices(next, "turned", [&](const Vector3d& v) { return Vector3d(turn * v); });
  };
  SurfaceMesh all = solid();
  const std::uint32_t more = 1 + uniformIndex(engine, 3);
  for (std::uint32_t i = 0; i < more; ++i) {
    const Eigen::AlignedBox3d& box = all.boundingBox();
    Vector3d offset =
        kind == 0 ? latticePoint(engine, 0, 8)
                  : Vector3d(box.center() + 0.5 * uniformInCube(engine, 1.0).cwiseProduct(box.sizes()));
    if (uniformIndex(engine, 3) == 0) offset += uniformInCube(engine, powerOfTen(engine, -14.0, -6.0));
    all = makeJoined(all, solid(), offset);
  }
  return all;
}

SurfaceMesh voxelUnion(RandomEngine& engine) {
  VoxelGrid grid(0.25);
  const std::uint32_t count = 1 + uniformIndex(engine, 5);
  while (grid.cells().size() < count) {
    VoxelCell cell;
    for (std::int32_t& index : cell) index = static_cast<std::int32_t>(uniformIndex(engine, 3)) - 1;
    grid.insert(cell);
  }
  return grid.surface("drawn");
}

}  // namespace concave_distance::test

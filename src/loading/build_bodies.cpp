#include "build_bodies.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <exception>
#include <set>
#include <utility>

#include "base/content_hash.h"
#include "base/number_text.h"
#include "base/short_text.h"
#include "concave_distance/base/error.h"
#include "concave_distance/search/prepare_search.h"
#include "mesh/body_key.h"
#include "scene/body_pool.h"
#include "scene/cloud_bodies.h"

namespace concave_distance::detail {
namespace {

constexpr double kFarthestCoordinate = 1e9;  // metres

// Runs `step` for every body without a problem; what it throws becomes that body's problem.
template <typename Step>
void forEachBody(std::vector<BuiltBody>& built, LoadProgress* progress, const Step& step) {
  // One body a task: their costs differ by orders of magnitude.
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, built.size(), 1),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        if (progress != nullptr && progress->isStopped())
                          built[i].problem = "loading was stopped";
                        try {
                          if (built[i].problem.empty()) step(i);
                        } catch (const std::exception& exception) {
                          built[i].problem = exception.what();
                        }
                        if (progress != nullptr) progress->finishBody();
                      }
                    });
}

std::string foundBelow(const std::string& resource, const std::string& folder) {
  return "'" + resource + "' was found below " + folder + "; other missing meshes are looked for there too";
}

// The caller's locator need not be safe between threads: files are looked up one by one, beforehand.
void locateAll(std::vector<BodySource>& sources, const BuildOptions& options, std::vector<BuiltBody>& built) {
  std::set<std::string> reported;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    built[i].problem = sources[i].problem;
    if (!built[i].problem.empty()) continue;
    try {
      const MeshFolders folders{sources[i].base_folder, options.mesh_search_path};
      for (GeometryElement& element : sources[i].geometry) {
        const std::string resource = element.mesh_resource;
        const std::string below = locateGeometry(element, folders, options.package_locator);
        if (below.empty()) continue;
        sources[i].in_robot_model = false;  // rviz does not find the mesh
        if (reported.insert(below).second) {
          built[i].notes.push_back(foundBelow(resource, below));
        }
      }
    } catch (const std::exception& exception) {
      built[i].problem = exception.what();
    }
  }
}

void checkTriangleCount(std::size_t count, const BodySource& source, const SceneLimits& limits) {
  if (count > limits.triangles) {
    throw Error(source.source, std::to_string(count) + " triangles",
                "reduce the mesh; the limit of a body is " + std::to_string(limits.triangles));
  }
}

// Before they are repaired.
std::size_t givenTriangles(const BodySource& source) {
  std::size_t count = 0;
  for (const GeometryElement& element : source.geometry) {
    count += element.triangles ? element.triangles->triangles.size() : 0;
  }
  return count;
}

// With larger coordinates, squares lose all small terms; at 1e154 m they overflow.
void checkExtent(const SurfaceMesh& surface, const BodySource& source) {
  const Eigen::AlignedBox3d& box = surface.boundingBox();
  const double farthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  if (!(farthest <= kFarthestCoordinate)) {
    TextStream seen;
    seen << "it reaches " << farthest << " m from the origin of its frame";
    for (const GeometryElement& element : source.geometry) {
      if (!element.mesh_resource.empty()) seen << ", with " << element.mesh_resource;
    }
    throw Error(source.source, shortText(seen.str()),
                "check its size, unit (scale) and pose; the limit is 1e9 m");
  }
}

std::shared_ptr<const BodyMesh> sharedMesh(const BodySource& source, SurfaceMesh surface,
                                           const std::shared_ptr<BodyPool>& pool, const SceneLimits& limits) {
  BodyMeshOptions options;
  options.max_edge_length = source.max_edge_length;
  options.largest_node_count = limits.nodes;
  options.metric_memory = pool->metricMemory();
  options.shape = roundShapeOf(source.geometry);
  const ContentKey key = bodyKey(surfaceKey(surface), options);
  return pool->share(key, [&] {
    auto mesh = std::make_shared<const BodyMesh>(source.name, std::move(surface), options);
    prepareLargeGrid(mesh->asSolved());
    return mesh;
  });
}

/// Stands for all that a body's mesh is made from.
std::optional<ContentKey> sourceKey(const std::optional<ContentKey>& geometry, const BodySource& source,
                                    const SceneLimits& limits) {
  if (!geometry) return std::nullopt;
  ContentHasher hasher;
  return hasher.add(*geometry)
      .add(source.max_edge_length.has_value())
      .add(source.max_edge_length.value_or(0.0))
      .add(limits.nodes)
      .key();
}

// Files may change until they are read, which the key of what was read tells.
RepairedBody load(const BodySource& source, const std::shared_ptr<BodyPool>& pool,
                  const SceneLimits& limits) {
  if (const auto key = sourceKey(geometryKey(source.geometry), source, limits)) {
    if (std::optional<RepairedBody> known = pool->findRepaired(*key)) return std::move(*known);
  }
  KeyedMesh keyed = loadGeometry(source.geometry, source.source);
  checkTriangleCount(keyed.repaired.mesh.triangleCount(), source, limits);
  checkExtent(keyed.repaired.mesh, source);
  RepairedBody made{nullptr, keyed.repaired.report};
  made.mesh = sharedMesh(source, std::move(keyed.repaired.mesh), pool, limits);
  if (const auto key = sourceKey(keyed.key, source, limits)) pool->insertRepaired(*key, made);
  return made;
}

SceneBody build(const BodySource& source, const std::shared_ptr<BodyPool>& pool, const SceneLimits& limits) {
  checkTriangleCount(givenTriangles(source), source, limits);
  const RepairedBody loaded = load(source, pool, limits);
  SceneBody body = source;
  body.repair = loaded.report;
  body.mesh = loaded.mesh;
  body.bounds = boundsOf(*body.mesh);
  if (limitsMargin(body)) requireMargin(source.source, body.margin, *body.mesh);
  return body;
}

}  // namespace

std::vector<BuiltBody> buildBodies(std::vector<BodySource> sources, const BuildOptions& options) {
  std::vector<BuiltBody> built(sources.size());
  if (options.progress != nullptr) options.progress->begin(sources.size());
  locateAll(sources, options, built);
  forEachBody(built, options.progress,
              [&](std::size_t i) { built[i].body = build(sources[i], options.pool, options.limits); });
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!built[i].body) continue;
    for (const std::string& note :
         {built[i].body->repair.summary(), describeApproximations(sources[i].geometry)}) {
      if (!note.empty()) built[i].notes.push_back(note);
    }
  }
  return built;
}

}  // namespace concave_distance::detail

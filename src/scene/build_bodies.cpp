#include "build_bodies.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <sstream>
#include <utility>

namespace concave_distance::detail {
namespace {

// Per entry of the metric's matrices: a float and a 16-bit predecessor.
constexpr std::size_t kBytesPerMatrixEntry = sizeof(float) + sizeof(std::uint16_t);

// Between the two passes: all is there but the mesh metric.
struct PreparedBody {
  RepairReport repair;
  BodyMeshParts parts;
  MeshMetricOptions metric;
};

// Runs `step` for every body without a problem; what it throws becomes that body's problem.
template <typename Step>
void forEachBody(std::vector<BuiltBody>& built, const Step& step) {
  // One body a task: their costs differ by orders of magnitude.
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, built.size(), 1),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        if (!built[i].problem.empty()) continue;
                        try {
                          step(i);
                        } catch (const std::exception& exception) {
                          built[i].problem = exception.what();
                        }
                      }
                    });
}

// The caller's locator need not be safe between threads: files are looked up one by one, beforehand.
void locateAll(std::vector<BodySource>& sources, const PackageLocator& package_locator,
               std::vector<BuiltBody>& built) {
  for (std::size_t i = 0; i < sources.size(); ++i) {
    built[i].problem = sources[i].problem;
    if (!built[i].problem.empty()) continue;
    try {
      for (GeometryElement& element : sources[i].geometry) {
        locateGeometry(element, sources[i].base_folder, package_locator);
      }
    } catch (const std::exception& exception) {
      built[i].problem = exception.what();
    }
  }
}

PreparedBody prepare(const BodySource& source, const PreparationCachePointer& cache) {
  PreparedBody prepared;
  RepairedMesh repaired = loadGeometry(source.geometry, source.source, cache.get());
  prepared.repair = repaired.report;
  BodyMeshOptions options;
  options.max_edge_length = source.max_edge_length;
  options.cache = cache;
  prepared.parts = makeBodyMeshParts(source.name, std::move(repaired.mesh), options);
  return prepared;
}

// In the order of the scene, so that which bodies have matrices does not depend on who was ready first.
void shareMetricMemory(std::vector<PreparedBody>& prepared, std::size_t limit,
                       std::vector<BuiltBody>& built) {
  std::size_t left = limit;
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    PreparedBody& body = prepared[i];
    if (!built[i].problem.empty()) continue;
    const std::size_t graph_nodes = body.parts.nodes.graph.nodeCount();
    std::ostringstream reason;
    if (graph_nodes > body.metric.matrix_node_limit) {
      reason << "more than " << body.metric.matrix_node_limit << " search nodes";
    } else if (const std::size_t wanted = graph_nodes * graph_nodes * kBytesPerMatrixEntry; wanted > left) {
      body.metric.matrix_node_limit = 0;
      reason << "matrices of " << static_cast<double>(wanted) * 1e-6 << " MB, "
             << static_cast<double>(left) * 1e-6 << " of " << static_cast<double>(limit) * 1e-6
             << " MB are left";
    } else {
      left -= wanted;
      continue;
    }
    built[i].notes.push_back("mesh distances are searched on demand: " + reason.str());
  }
}

SceneBody finishBody(const BodySource& source, PreparedBody prepared) {
  SceneBody body;
  body.name = source.name;
  body.frame = source.frame;
  body.source = source.source;
  body.colour = source.colour;
  body.material = source.material;
  body.in_robot_model = source.in_robot_model;
  body.repair = prepared.repair;
  body.inertia = source.inertia;
  body.bounds = boundsOf(prepared.parts.surface);
  body.mesh = std::make_shared<const BodyMesh>(std::move(prepared.parts), prepared.metric);
  return body;
}

}  // namespace

std::vector<BuiltBody> buildBodies(std::vector<BodySource> sources, const PackageLocator& package_locator,
                                   std::size_t metric_memory_limit, const PreparationCachePointer& cache) {
  std::vector<BuiltBody> built(sources.size());
  std::vector<PreparedBody> prepared(sources.size());
  locateAll(sources, package_locator, built);
  forEachBody(built, [&](std::size_t i) { prepared[i] = prepare(sources[i], cache); });
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!built[i].problem.empty()) continue;
    for (const std::string& note :
         {prepared[i].repair.summary(), describeApproximations(sources[i].geometry)}) {
      if (!note.empty()) built[i].notes.push_back(note);
    }
  }
  shareMetricMemory(prepared, metric_memory_limit, built);
  forEachBody(built, [&](std::size_t i) {
    built[i].body = finishBody(sources[i], std::exchange(prepared[i], PreparedBody{}));
  });
  return built;
}

}  // namespace concave_distance::detail

#include "concave_distance/mesh/body_mesh.h"

#include "base/number_text.h"
#include "body_mesh_parts.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <mutex>
#include <utility>

#include "base/run_together.h"
#include "cached_parts.h"
#include "concave_distance/base/error.h"
#include "mesh/surface/facets.h"
#include "mesh/surface/grid_size.h"
#include "mesh/trees/shell_contacts.h"

namespace concave_distance {

struct BodyMesh::Measured {
  detail::Metric metric;
  bool has_room = true;  ///< for the metric's matrices
  std::shared_ptr<MetricMemory> memory;
  std::size_t taken = 0;  ///< bytes of `memory`

  ~Measured() {
    if (memory) memory->giveBack(taken);
  }
};

struct BodyMesh::State {
  template <typename T>
  struct Part {
    std::once_flag once;
    T value;
    std::atomic<std::size_t> bytes{0};

    /// Returns the part; the first call makes it, for all threads.
    template <typename Make>
    const T& get(const Make& make) {
      std::call_once(once, [&] {
        value = make();
        bytes = value.memoryBytes();
      });
      return value;
    }
  };
  State(BodyMeshParts made, const BodyMeshOptions& given)
      : parts(std::move(made)), options(given), bounds(parts.surface.boundingBox()) {
    if (options.shape) bounds.extend(boundingBox(*options.shape));
  }

  BodyMeshParts parts;  ///< without the nodes
  BodyMeshOptions options;
  Eigen::AlignedBox3d bounds;
  // Made on demand:
  Part<RecentredBody> recentred;
  Part<ShellContacts> shell_contacts;
  Part<Facets> facets;
  Part<CompressedRows<AdjacentTriangle>> adjacency;
  Part<ConnectedPieces> pieces;
  std::array<Part<NormalConeTree>, 2> cones;  ///< by NormalSides
  std::once_flag nodes_once;
  SearchNodes nodes;
  std::once_flag reserved_once;
  std::once_flag measured_once;
  Measured measured;
  std::atomic<bool> is_measured{false};
};

namespace {

SearchNodesOptions nodesOptions(const BodyMeshOptions& options) {
  return {options.max_edge_length, options.search_node_limit};
}

void checkNodeCount(const std::string& name, const SurfaceMesh& surface, const BodyMeshOptions& options) {
  if (!options.max_edge_length) return;
  const double nodes = estimatedNodeCount(surface, *options.max_edge_length);
  if (nodes <= static_cast<double>(options.largest_node_count)) return;
  TextStream seen;
  seen << "max_edge_length " << *options.max_edge_length << " m makes a search grid of about " << nodes
       << " nodes";
  throw Error(name, seen.str(),
              "give a longer one or leave it out; the limit is " +
                  std::to_string(options.largest_node_count) + " nodes");
}

BodyMeshParts makeExactParts(std::string name, SurfaceMesh surface, const BodyMeshOptions& options) {
  if (surface.triangleCount() == 0)
    throw Error(name, "the surface has no triangles", "load or make one first");
  if (options.shape) options.shape->validate(name);
  checkEdgeLength(surface, options.max_edge_length, name);
  checkNodeCount(name, surface, options);
  BodyMeshParts parts;
  parts.name = std::move(name);
  parts.surface = std::move(surface);
  parts.cache = options.cache;
  PreparationCache* cache = options.cache.get();
  ContentKey surface_key;
  if (cache != nullptr) {
    surface_key = detail::keyOf(parts.surface);
    parts.nodes_key = detail::keyOfNodes(surface_key, nodesOptions(options));
  }
  runTogether({[&] { parts.topology = detail::topologyOf(parts.surface, cache, surface_key); },
               [&] {
                 detail::Trees trees = detail::treesOf(parts.surface, cache, surface_key);
                 parts.tree = std::move(trees.tree);
                 parts.hierarchy = std::move(trees.hierarchy);
               }});
  return parts;
}

// The edge lengths have been checked; if the grid still cannot be made, the surface serves as grid.
SearchNodes makeCheckedNodes(const BodyMeshParts& parts, const BodyMeshOptions& options) {
  try {
    return detail::nodesOf(parts.surface, nodesOptions(options), parts.name, parts.cache.get(),
                           parts.nodes_key);
  } catch (const Error&) {
    SearchNodesOptions coarse = nodesOptions(options);
    coarse.max_edge_length = 2.0 * parts.surface.diameter();
    return makeSearchNodes(parts.surface, coarse, parts.name);
  }
}

}  // namespace

BodyMeshParts makeBodyMeshParts(std::string name, SurfaceMesh surface, const BodyMeshOptions& options) {
  BodyMeshParts parts = makeExactParts(std::move(name), std::move(surface), options);
  parts.nodes =
      detail::nodesOf(parts.surface, nodesOptions(options), parts.name, parts.cache.get(), parts.nodes_key);
  return parts;
}

BodyMesh::BodyMesh(std::string name, SurfaceMesh surface, const BodyMeshOptions& options)
    : state_(std::make_unique<State>(makeExactParts(std::move(name), std::move(surface), options), options)),
      surface_(&state_->parts.surface),
      topology_(&state_->parts.topology),
      tree_(&state_->parts.tree),
      hierarchy_(&state_->parts.hierarchy) {}

BodyMesh::BodyMesh(BodyMeshParts parts, const BodyMeshOptions& options)
    : state_(std::make_unique<State>(std::move(parts), options)),
      surface_(&state_->parts.surface),
      topology_(&state_->parts.topology),
      tree_(&state_->parts.tree),
      hierarchy_(&state_->parts.hierarchy) {
  std::call_once(state_->nodes_once, [&] { state_->nodes = std::exchange(state_->parts.nodes, {}); });
  nodes_.store(&state_->nodes, std::memory_order_release);
}

const std::string& BodyMesh::name() const {
  return state_->parts.name;
}

const RoundShape* BodyMesh::shape() const {
  return state_->options.shape ? &*state_->options.shape : nullptr;
}

const Eigen::AlignedBox3d& BodyMesh::bounds() const {
  return state_->bounds;
}

const SurfaceMesh& BodyMesh::grid() const {
  return searchNodes().grid;
}

const NodeGraph& BodyMesh::graph() const {
  return searchNodes().graph;
}

const NodeLevels& BodyMesh::levels() const {
  return searchNodes().levels;
}

bool BodyMesh::thinned() const {
  return searchNodes().thinned();
}

double BodyMesh::maxEdgeLength() const {
  return searchNodes().max_edge_length;
}

TriangleIndex BodyMesh::originalTriangle(NodeIndex graph_node) const {
  return searchNodes().original_triangle_of_node[graph_node.value];
}

NodeIndex BodyMesh::graphNode(NodeIndex surface_vertex) const {
  return thinned() ? searchNodes().graph_node_of_vertex[surface_vertex.value] : surface_vertex;
}

BodyMesh::~BodyMesh() = default;

// While a thread waits for its parallel parts it must not start another task, which might wait for
// the same body.
const SearchNodes& BodyMesh::makeNodes() const {
  std::call_once(state_->nodes_once, [&] {
    tbb::this_task_arena::isolate([&] { state_->nodes = makeCheckedNodes(state_->parts, state_->options); });
    nodes_.store(&state_->nodes, std::memory_order_release);
  });
  return state_->nodes;
}

void BodyMesh::reserveMetric() const {
  std::call_once(state_->reserved_once, [&] {
    Measured& part = state_->measured;
    if (!state_->options.metric_memory ||
        !MeshMetric::wantsMatrices(graph().nodeCount(), MeshMetricOptions{state_->options.matrix_node_limit}))
      return;
    const std::size_t wanted = MeshMetric::matrixBytes(graph().nodeCount());
    part.has_room = state_->options.metric_memory->take(wanted);
    if (!part.has_room) return;
    part.memory = state_->options.metric_memory;
    part.taken = wanted;
  });
}

const BodyMesh::Measured& BodyMesh::measured() const {
  Measured& part = state_->measured;
  if (state_->is_measured.load(std::memory_order_acquire)) return part;
  reserveMetric();
  std::call_once(state_->measured_once, [&] {
    const NodeGraph& made = graph();
    MeshMetricOptions options{state_->options.matrix_node_limit};
    if (!part.has_room) options.matrix_node_limit = 0;
    tbb::this_task_arena::isolate([&] {
      part.metric = detail::metricOf(made, options, state_->parts.cache.get(), state_->parts.nodes_key);
    });
    state_->is_measured.store(true, std::memory_order_release);
  });
  return part;
}

const MeshMetric& BodyMesh::metric() const {
  return *measured().metric.metric;
}

const MeshMetric* BodyMesh::metricIfMade() const {
  return state_->is_measured.load(std::memory_order_acquire) ? &metric() : nullptr;
}

double BodyMesh::geodesicExtent() const {
  return measured().metric.geodesic_extent;
}

double BodyMesh::protrusionSpacing() const {
  return measured().metric.protrusion_spacing;
}

ContentKey bodyKey(const SurfaceMesh& surface, const BodyMeshOptions& options) {
  const ContentKey key = detail::keyOfNodes(detail::keyOf(surface), nodesOptions(options));
  if (!options.shape) return key;
  const RoundShape& shape = *options.shape;
  ContentHasher hasher;
  hasher.add(key).add(shape.kind).add(shape.radius).add(shape.half_length).add(shape.chord_error);
  for (int i = 0; i < 16; ++i) hasher.add(shape.body_from_shape.data()[i]);
  return hasher.key();
}

void prepareSearch(const std::vector<const BodyMesh*>& bodies) {
  std::vector<const BodyMesh*> open;
  std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(open),
               [](const BodyMesh* body) { return body->metricIfMade() == nullptr; });
  if (open.empty()) return;
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) { open[i]->graph(); });
  for (const BodyMesh* body : open) body->reserveMetric();
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) { open[i]->metric(); });
}

namespace {

/// Along an axis, in diameters: from here on the centre is subtracted. All coordinates are then within a
/// factor of two of each other, so that the differences are exact (Sterbenz).
constexpr double kFarFromOrigin = 16.0;

Eigen::Vector3d farOrigin(const Eigen::AlignedBox3d& box, double diameter) {
  const Eigen::Vector3d centre = box.center();
  return (centre.array().abs() > kFarFromOrigin * diameter).select(centre, 0.0);
}

SurfaceMesh movedTo(const SurfaceMesh& surface, const Eigen::Vector3d& origin, const std::string& where) {
  std::vector<Eigen::Vector3d> vertices = surface.vertices();
  for (Eigen::Vector3d& vertex : vertices) vertex -= origin;
  return SurfaceMesh(std::move(vertices), surface.triangles(), where);
}

}  // namespace

const RecentredBody& BodyMesh::recentred() const {
  auto& part = state_->recentred;
  std::call_once(part.once, [&] {
    const Eigen::Vector3d origin = farOrigin(bounds(), bounds().diagonal().norm());
    if (origin.isZero(0.0)) return;
    BodyMeshOptions options = state_->options;
    if (options.shape) options.shape->body_from_shape.pretranslate(-origin);
    part.value.mesh = std::make_shared<BodyMesh>(name(), movedTo(surface(), origin, name()), options);
    part.value.origin = origin;
    part.bytes = part.value.mesh->memoryBytes();
  });
  return part.value;
}

const ShellContacts& BodyMesh::shellContacts() const {
  return state_->shell_contacts.get([&] { return findShellContacts(surface(), topology(), tree()); });
}

const Facets& BodyMesh::facets() const {
  return state_->facets.get([&] { return joinFlatTriangles(surface(), topology(), shellContacts().hidden); });
}

const CompressedRows<AdjacentTriangle>& BodyMesh::adjacency() const {
  return state_->adjacency.get([&] {
    CompressedRows<AdjacentTriangle> of_triangles = triangleAdjacency(surface(), topology());
    if (!shellContacts().isEmpty()) of_triangles = joinedAdjacency(surface(), shellContacts(), of_triangles);
    return facetAdjacency(facets(), of_triangles);
  });
}

const ConnectedPieces& BodyMesh::pieces() const {
  return state_->pieces.get([&] {
    ConnectedPieces pieces = connectedPieces(surface());
    joinPieces(shellContacts(), pieces);
    return pieces;
  });
}

const NormalConeTree& BodyMesh::normalCones(NormalSides sides) const {
  return state_->cones.at(static_cast<std::size_t>(sides)).get([&] {
    return NormalConeTree(surface(), topology(), sides, shellContacts());
  });
}

std::size_t BodyMesh::memoryBytes() const {
  const auto mesh_bytes = [](const SurfaceMesh& mesh) {
    return mesh.vertexCount() * sizeof(Eigen::Vector3d) + mesh.triangleCount() * sizeof(TriangleNodes);
  };
  const MeshTopology& topology = state_->parts.topology;
  const std::size_t topology_bytes =
      topology.triangles_of_vertex.values.size() * sizeof(TriangleIndex) +
      topology.neighbours_of_vertex.values.size() * sizeof(NodeIndex) +
      surface().triangleCount() *
          (3 * sizeof(TriangleIndex) + sizeof(std::uint32_t) + sizeof(Eigen::Vector3d)) +
      surface().vertexCount() * (2 * sizeof(std::uint32_t) + sizeof(Eigen::Vector3d));
  std::size_t search_bytes = 0;
  if (const SearchNodes* nodes = nodesIfMade()) {
    search_bytes += mesh_bytes(nodes->grid) +
                    nodes->original_triangle_of_node.size() * sizeof(TriangleIndex) +
                    nodes->graph_node_of_vertex.size() * sizeof(NodeIndex) + nodes->graph.memoryBytes() +
                    nodes->levels.memoryBytes();
  }
  if (const MeshMetric* metric = metricIfMade()) search_bytes += metric->memoryBytes();
  // A body that nobody has solved far from its origin is not made for its size.
  if (state_->recentred.bytes > 0) search_bytes += recentred().mesh->memoryBytes();
  return sizeof(BodyMesh) + sizeof(State) + mesh_bytes(surface()) + topology_bytes + search_bytes +
         state_->parts.tree.memoryBytes() + state_->parts.hierarchy.memoryBytes() + state_->adjacency.bytes +
         state_->shell_contacts.bytes + state_->facets.bytes + state_->pieces.bytes + state_->cones[0].bytes +
         state_->cones[1].bytes;
}

}  // namespace concave_distance

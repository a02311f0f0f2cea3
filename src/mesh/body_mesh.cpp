#include "concave_distance/mesh/body_mesh.h"

#include <tbb/task_arena.h>

#include <array>
#include <utility>

#include "base/made_once.h"
#include "base/number_text.h"
#include "base/run_together.h"
#include "concave_distance/base/error.h"
#include "convex_shells.h"
#include "mesh/surface/connected_pieces.h"
#include "mesh/surface/core_mesh.h"
#include "mesh/surface/facets.h"
#include "mesh/surface/grid_size.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"
#include "mesh/surface/triangle_adjacency.h"
#include "mesh/trees/bounding_volume_hierarchy.h"
#include "mesh/trees/dented_groups.h"
#include "mesh/trees/hull_gap.h"
#include "mesh/trees/normal_cone_tree.h"
#include "mesh/trees/shell_contacts.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance {

struct BodyMesh::State {
  MeshTopology topology;
  TriangleTree tree;
  BoundingVolumeHierarchy hierarchy;
  // Made on demand:
  MadeOnce<RecentredBody> recentred;
  MadeOnce<RoundCore> core;
  MadeOnce<ShellContacts> shell_contacts;
  MadeOnce<Facets> facets;
  MadeOnce<HullGap> hull_gap;
  MadeOnce<ConvexShells> convex_shells;
  MadeOnce<CompressedRows<AdjacentTriangle>> adjacency;
  MadeOnce<ConnectedPieces> pieces;
  std::array<MadeOnce<NormalConeTree>, 2> cones;  ///< by NormalSides
  MadeOnce<std::vector<bool>> dented_groups;
};

namespace {

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

void checkBody(const std::string& name, const SurfaceMesh& surface, const BodyMeshOptions& options) {
  if (surface.triangleCount() == 0)
    throw Error(name, "the surface has no triangles", "load or make one first");
  if (options.shape) options.shape->validate(name);
  checkEdgeLength(surface, options.max_edge_length, name);
  checkNodeCount(name, surface, options);
}

}  // namespace

BodyMesh::BodyMesh(std::string name, SurfaceMesh surface, const BodyMeshOptions& options)
    : name_(std::move(name)),
      surface_(std::move(surface)),
      options_(options),
      bounds_(surface_.boundingBox()),
      state_(std::make_unique<State>()),
      topology_(&state_->topology),
      tree_(&state_->tree),
      hierarchy_(&state_->hierarchy) {
  checkBody(name_, surface_, options_);
  if (options_.shape) bounds_.extend(boundingBox(*options_.shape));
  runTogether({[&] { state_->topology = buildMeshTopology(surface_); },
               [&] {
                 state_->tree = TriangleTree(surface_);
                 state_->hierarchy = BoundingVolumeHierarchy(surface_, state_->tree);
               }});
}

// Attachments may refer to the body.
BodyMesh::~BodyMesh() {
  delete attachment();
}

const BodyAttachment& BodyMesh::attach(std::unique_ptr<const BodyAttachment> made) const {
  const BodyAttachment* kept = nullptr;
  if (attachment_.compare_exchange_strong(kept, made.get(), std::memory_order_acq_rel))
    return *made.release();
  return *kept;
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
  return state_->recentred.get([&]() -> RecentredBody {
    const Eigen::Vector3d origin = farOrigin(bounds(), bounds().diagonal().norm());
    if (origin.isZero(0.0)) return {};
    BodyMeshOptions options = options_;
    if (options.shape) options.shape->body_from_shape.pretranslate(-origin);
    return {std::make_shared<BodyMesh>(name(), movedTo(surface(), origin, name()), options), origin};
  });
}

const RoundCore& BodyMesh::core() const {
  return state_->core.get([&]() -> RoundCore {
    if (shape() == nullptr || detail::hasFlatEnds(*shape())) return {};
    detail::CoreMesh core = detail::coreMesh(*shape(), name());
    BodyMeshOptions options;
    options.max_edge_length = 2.0 * core.surface.diameter();  // its vertices are all the nodes of the search
    return {std::make_shared<BodyMesh>(name(), std::move(core.surface), options), shape()->radius,
            core.thickness};
  });
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

const HullGap& BodyMesh::hullGap() const {
  return state_->hull_gap.get([&] { return measureHullGap(surface(), topology(), tree()); });
}

// A shell is a body, whose parts are made in parallel: a thread that waits may not take up other work.
const ConvexShells& BodyMesh::convexShells() const {
  return state_->convex_shells.get(
      [&] { return tbb::this_task_arena::isolate([&] { return findConvexShells(*this); }); });
}

const NormalConeTree& BodyMesh::normalCones(NormalSides sides) const {
  return state_->cones.at(static_cast<std::size_t>(sides)).get([&] {
    return NormalConeTree(surface(), topology(), sides, shellContacts());
  });
}

const std::vector<bool>& BodyMesh::dentedGroups() const {
  return state_->dented_groups.get(
      [&] { return markDentedGroups(normalCones(NormalSides::Outside), surface(), topology(), hullGap()); });
}

void BodyMesh::prepareNiches(NormalSides sides) const {
  shellContacts();
  runTogether({[&] { normalCones(sides); },
               [&] {
                 adjacency();
                 pieces();
                 hullGap();
                 convexShells();
               }});
  if (sides == NormalSides::Outside) dentedGroups();
}

}  // namespace concave_distance

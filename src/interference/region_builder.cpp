#include "region_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/surface/mesh_topology.h"
#include "overlap_facets.h"

namespace concave_distance::detail {
namespace {

/// Vector areas shorter than this share of what their loops have one by one cancel.
constexpr double kCancelled = 1e-6;

Eigen::Vector3d centroidOf(const BoundaryComponent& region, double rounding) {
  if (region.volume > 1e3 * rounding * region.surface())
    return region.reference + region.moment / region.volume;
  if (region.surface() > 0.0) return region.reference + region.area_moment / region.surface();
  return region.reference;
}

}  // namespace

void RegionBuilder::findCandidates(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                   const std::vector<KnownNormal>& known, WorkLimit& limit) {
  known_ = &known;
  frame_.reset(a, b, a_from_b);
  cut_ = !collectCandidates(frame_, stack_, candidates_, limit);
}

bool RegionBuilder::pass(const Motion& motion_of_b, std::vector<FoundRegion>& found, WorkLimit& limit) {
  found.clear();
  PerturbedPredicates predicates(motion_of_b);
  cut_ = cut_ || limit.isOver() || !curves_.find(frame_, predicates, candidates_, limit);
  if (cut_) return false;
  sets_.reset(curves_.nodes().size());
  for (const Side side : {Side::A, Side::B})
    pieces_[at(side)].collect(frame_, predicates, containment_, curves_, side, sets_);
  for (const Side side : {Side::A, Side::B}) addSwallowedShells(predicates, side);
  components_.build(frame_, curves_, pieces_, sets_, limit);
  component_of_region_.clear();
  for (std::uint32_t c = 0; c < components_.all().size(); ++c) {
    const BoundaryComponent& component = components_.all()[c];
    if (component.is_cavity) continue;
    if (limit.isOver()) break;
    found.emplace_back();
    component_of_region_.push_back(c);
    buildRegion(component, found.back());
  }
  measureReach(found);
  listSurfaces(found);
  listLoops(found);
  addOpenRegions(found, limit);
  cut_ = limit.isOver();
  if (cut_) found.clear();
  return predicates.tied() && !cut_;
}

void RegionBuilder::measureReach(std::vector<FoundRegion>& found) {
  region_of_component_.assign(components_.all().size(), kNone);
  for (std::uint32_t r = 0; r < component_of_region_.size(); ++r) {
    for (std::uint32_t c = component_of_region_[r]; c != kNone; c = components_.all()[c].next_cavity)
      region_of_component_[c] = r;
  }
  const std::vector<CrossingNode>& nodes = curves_.nodes();
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    const std::uint32_t component = components_.componentOfNode(n, sets_);
    const std::uint32_t r = component == kNone ? kNone : region_of_component_[component];
    if (r == kNone) continue;
    InterferenceRegion& region = found[r].region;
    region.reach = std::max(region.reach, (frame_.pointInA(nodes[n].position) - region.centroid_in_a).norm());
  }
}

void RegionBuilder::listSurfaces(std::vector<FoundRegion>& found) {
  facets_.clear();
  for (std::uint32_t r = 0; r < component_of_region_.size(); ++r) {
    InterferenceRegion& region = found[r].region;
    if (!region.closed || region.touching) continue;
    region.first_facet = static_cast<std::uint32_t>(facets_.size());
    appendFacets(frame_, pieces_, components_, components_.all()[component_of_region_[r]], facets_);
    region.facet_count = static_cast<std::uint32_t>(facets_.size()) - region.first_facet;
  }
}

// Needs region_of_component_ of measureReach.
void RegionBuilder::listLoops(std::vector<FoundRegion>& found) {
  std::uint32_t count = 0;
  next_loop_.clear();
  for (FoundRegion& f : found) {
    f.region.first_loop = count;
    next_loop_.push_back(count);
    count += f.region.loop_count;
  }
  loop_areas_.assign(count, Eigen::Vector3d::Zero());
  const double area = 1.0 / (frame_.scale() * frame_.scale());
  for (std::uint32_t n = 0; n < curves_.nodes().size(); ++n) {
    if (components_.loopOf(n) != n) continue;
    const std::uint32_t component = components_.componentOfNode(n, sets_);
    const std::uint32_t r = component == kNone ? kNone : region_of_component_[component];
    if (r == kNone) continue;
    const InterferenceRegion& region = found[r].region;
    if (next_loop_[r] == region.first_loop + region.loop_count) continue;
    loop_areas_[next_loop_[r]++] = components_.vectorAreaOfLoop(n) * area;
  }
}

void RegionBuilder::addSwallowedShells(PerturbedPredicates& predicates, Side side) {
  const MeshTopology& topology = frame_.body(side).topology();
  const std::vector<bool>& holders = frame_.body(other(side)).topology().shell_is_closed;
  if (std::none_of(holders.begin(), holders.end(), [](bool closed) { return closed; })) return;
  shell_seen_.assign(topology.shellCount(), 0);
  for (const CrossingSegment& segment : curves_.segments())
    shell_seen_[topology.shell_of_triangle[segment.triangle[at(side)].value]] = 1;
  for (const bool closed : {true, false}) {
    for (std::size_t shell = 0; shell < topology.shellCount(); ++shell) {
      const TriangleIndex triangle = topology.triangle_of_shell[shell];
      if (triangle == kNoTriangle || shell_seen_[shell] != 0 || topology.shell_is_closed[shell] != closed)
        continue;
      if (containment_.winding(frame_, predicates, side, *frame_.corners(side, triangle)[0]) > 0)
        pieces_[at(side)].addShell(frame_, triangle, sets_);
    }
  }
}

void RegionBuilder::buildRegion(const BoundaryComponent& component, FoundRegion& found) {
  InterferenceRegion& region = found.region;
  const double length = 1.0 / frame_.scale();
  const double area = length * length;
  BoundaryComponent whole = component;
  for (std::uint32_t c = component.next_cavity; c != kNone; c = components_.all()[c].next_cavity) {
    const BoundaryComponent& cavity = components_.all()[c];
    whole.moment += cavity.moment + cavity.volume * (cavity.reference - whole.reference);
    whole.area_moment += cavity.area_moment + cavity.surface() * (cavity.reference - whole.reference);
    whole.volume += cavity.volume;
    for (const std::size_t side : {0U, 1U}) whole.area[side] += cavity.area[side];
    whole.vector_area += cavity.vector_area;
    whole.flap_area += cavity.flap_area;
    whole.flap_vector_area += cavity.flap_vector_area;
    whole.shared_area += cavity.shared_area;
    whole.shared_vector_area += cavity.shared_vector_area;
    whole.loop_count += cavity.loop_count;
    whole.consistent = whole.consistent && cavity.consistent;
  }
  // The regularised overlap has no flaps; only where there is nothing else they are what touches.
  const bool solid = whole.volume > 2.0 * frame_.roundingBound() * frame_.scale() * whole.surface();
  if (solid) {
    whole.vector_area += whole.shared_vector_area - whole.flap_vector_area;
    whole.area[0] = std::max(0.0, whole.area[0] + whole.shared_area - whole.flap_area);
    whole.area[1] = std::max(0.0, whole.area[1] - whole.shared_area - whole.flap_area);
    found.flap_area = whole.flap_area * area;
  }
  region.surface_area_a = whole.area[0] * area;
  region.surface_area_b = whole.area[1] * area;
  region.loop_count = whole.loop_count;
  region.closed = whole.closed;
  region.consistent = whole.consistent && !curves_.broken();
  region.centroid_in_a = frame_.pointInA(centroidOf(whole, frame_.roundingBound() * frame_.scale()));
  if (whole.closed) region.volume = std::max(0.0, whole.volume) * area * length;
  if (whole.loop_count == 0) {
    region.a_swallowed = component.last_whole[0] > component.first_whole[0];
    region.b_swallowed = !region.a_swallowed;
  }
  measureDepth(component, solid, whole.vector_area * area, region);
}

void RegionBuilder::measureDepth(const BoundaryComponent& component, bool solid,
                                 const Eigen::Vector3d& vector_area, InterferenceRegion& region) {
  const double length = 1.0 / frame_.scale();
  DepthAlong along{Eigen::Vector3d::UnitX(), {0.0, component.reference, component.reference}};
  region.contact_area = vector_area.norm();
  region.normal_is_fallback = true;
  if (component.loop_count == 0) {
    const Side side = region.a_swallowed ? Side::A : Side::B;
    along = leastExit(frame_, side, pieces_[at(side)], component, knownNormal(region.centroid_in_a));
  } else if (region.contact_area > kCancelled * component.loop_area * length * length) {
    region.normal_is_fallback = false;
    along.normal = vector_area / region.contact_area;
    along.deepest = depthAlong(along.normal, frame_, curves_, pieces_, components_, component, overlay_);
  } else {
    along = leastDepth(frame_, curves_, pieces_, components_, component, sets_,
                       knownNormal(region.centroid_in_a), overlay_);
  }
  // On average thinner than roundings: faces that touch, also where several do round a corner.
  if (component.loop_count > 0 && component.closed && !solid &&
      along.deepest.depth > frame_.roundingBound() * frame_.scale()) {
    const Eigen::Vector3d& point = curves_.nodes()[component.first_node].position;
    along.deepest = {0.0, point, point};
  }
  region.depth = region.depth_along_normal = along.deepest.depth * length;
  region.normal_in_a = along.normal;
  region.point_a_in_a = region.along_normal_a_in_a = frame_.pointInA(along.deepest.point_a);
  region.point_b_in_a = region.along_normal_b_in_a = frame_.pointInA(along.deepest.point_b);
  region.touching = component.loop_count > 0 && component.closed && !solid;
}

Eigen::Vector3d RegionBuilder::knownNormal(const Eigen::Vector3d& centroid_in_a) const {
  const KnownNormal* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const KnownNormal& known : *known_) {
    const double distance = (known.centroid_in_a - centroid_in_a).norm();
    if (distance > std::min(known.reach, least)) continue;
    least = distance;
    nearest = &known;
  }
  return nearest != nullptr ? nearest->normal_in_a : Eigen::Vector3d::Zero();
}

void RegionBuilder::addOpenRegions(std::vector<FoundRegion>& found, WorkLimit& limit) {
  const std::vector<CrossingSegment>& segments = curves_.segments();
  open_segments_.clear();
  open_nodes_.clear();
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    if (segments[s].closed) continue;
    const std::uint32_t curve = components_.loopOf(segments[s].start);
    open_segments_.push_back({curve, s});
    open_nodes_.push_back({curve, segments[s].start});
    open_nodes_.push_back({curve, segments[s].end});
  }
  std::sort(open_segments_.begin(), open_segments_.end());
  std::sort(open_nodes_.begin(), open_nodes_.end());
  open_nodes_.erase(std::unique(open_nodes_.begin(), open_nodes_.end()), open_nodes_.end());
  auto node = open_nodes_.begin();
  for (auto first = open_segments_.begin(); first != open_segments_.end() && !limit.isOver();) {
    const auto is_of_another = [curve = first->curve](const OfCurve& item) { return item.curve != curve; };
    const auto last = std::find_if(first, open_segments_.end(), is_of_another);
    const auto last_node = std::find_if(node, open_nodes_.end(), is_of_another);
    found.emplace_back();
    found.back().region =
        openRegion(first->curve, &*first, &*first + (last - first), &*node, &*node + (last_node - node));
    first = last;
    node = last_node;
  }
}

InterferenceRegion RegionBuilder::openRegion(std::uint32_t curve, const OfCurve* first_segment,
                                             const OfCurve* last_segment, const OfCurve* first_node,
                                             const OfCurve* last_node) {
  const std::vector<CrossingNode>& nodes = curves_.nodes();
  double total = 0.0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d apart = Eigen::Vector3d::Zero();
  Eigen::Vector3d straight = Eigen::Vector3d::Zero();
  for (const OfCurve* item = first_segment; item != last_segment; ++item) {
    const CrossingSegment& segment = curves_.segments()[item->index];
    const Eigen::Vector3d& start = nodes[segment.start].position;
    const Eigen::Vector3d& end = nodes[segment.end].position;
    const double length = (end - start).norm();
    total += length;
    middle += 0.5 * length * (start + end - 2.0 * nodes[curve].position);
    apart +=
        length * (frame_.normal(Side::A, segment.triangle[0]) - frame_.normal(Side::B, segment.triangle[1]));
    straight += end - start;
  }
  InterferenceRegion region;
  region.closed = false;
  region.loop_count = last_segment - first_segment == last_node - first_node ? 1 : 0;
  Eigen::Vector3d centre = nodes[curve].position;
  if (total > 0.0) centre += middle / total;
  region.centroid_in_a = frame_.pointInA(centre);
  std::uint32_t nearest = curve;
  double farthest = 0.0;
  for (const OfCurve* item = first_node; item != last_node; ++item) {
    const std::uint32_t n = item->index;
    const double squared_distance = (nodes[n].position - centre).squaredNorm();
    if (squared_distance < (nodes[nearest].position - centre).squaredNorm()) nearest = n;
    farthest = std::max(farthest, squared_distance);
  }
  region.reach = std::sqrt(farthest) / frame_.scale();
  region.point_a_in_a = region.point_b_in_a = frame_.pointInA(nodes[nearest].position);
  // An open curve is closed by its chord, which the sum from one of its points leaves out of account.
  const Eigen::Vector3d& area = components_.vectorAreaOfLoop(curve);
  region.normal_is_fallback = !(area.norm() > kCancelled * total * total);
  Eigen::Vector3d normal = area;
  if (region.normal_is_fallback) {
    normal = apart;
    if (straight.norm() > 0.5 * total) normal -= straight * (straight.dot(normal) / straight.squaredNorm());
    if (!(normal.norm() > kCancelled * total))
      normal = straight.squaredNorm() > 0.0 ? straight.unitOrthogonal() : Eigen::Vector3d::UnitX();
  }
  region.normal_in_a = normal.stableNormalized();
  region.consistent = !curves_.broken();
  return region;
}

}  // namespace concave_distance::detail

#include "boundary_components.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/triangle_measures.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance::detail {
namespace {

/// A triangle's share of the volume with its moment, both from `reference`.
void addCone(BoundaryComponent& component, const Eigen::Vector3d& p, const Eigen::Vector3d& q,
             const Eigen::Vector3d& r) {
  const Eigen::Vector3d u = p - component.reference;
  const Eigen::Vector3d v = q - component.reference;
  const Eigen::Vector3d w = r - component.reference;
  const double volume = u.dot((q - p).cross(r - p)) / 6.0;
  component.volume += volume;
  component.moment += volume * 0.25 * (u + v + w);
}

/// Returns whether a component's part of a triangle holds a point of it.
bool holdsPoint(const SurfacePieces& pieces, const BoundaryComponent& component, Side side,
                TriangleIndex triangle, const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
  const auto before = [](const auto& item, TriangleIndex sought) { return item.triangle < sought; };
  const auto last_whole = pieces.wholes().begin() + component.last_whole[at(side)];
  const auto whole = std::lower_bound(pieces.wholes().begin() + component.first_whole[at(side)], last_whole,
                                      triangle, before);
  if (whole != last_whole && whole->triangle == triangle) return true;
  const auto last_edge = pieces.edges().begin() + component.last_edge[at(side)];
  double angle = 0.0;
  for (auto edge = std::lower_bound(pieces.edges().begin() + component.first_edge[at(side)], last_edge,
                                    triangle, before);
       edge != last_edge && edge->triangle == triangle; ++edge) {
    const Eigen::Vector3d from = edge->from - point;
    const Eigen::Vector3d to = edge->to - point;
    angle += std::atan2(from.cross(to).dot(normal), from.dot(to));
  }
  return angle > M_PI;
}

void addArea(BoundaryComponent& component, Side side, double area, const Eigen::Vector3d& middle) {
  component.area[at(side)] += area;
  component.area_moment += area * (middle - component.reference);
}

}  // namespace

void BoundaryComponents::build(WorkingFrame& frame, const CrossingCurves& curves, SurfacePieces (&pieces)[2],
                               UnionFind& sets, WorkLimit& limit) {
  components_.clear();
  component_of_element_.assign(sets.size(), kNone);
  for (const CrossingSegment& segment : curves.segments()) {
    if (!segment.closed) continue;
    BoundaryComponent& component = components_[componentOf(segment.start, sets)];
    if (component.first_node != kNone) continue;
    component.first_node = segment.start;
    component.reference = curves.nodes()[segment.start].position;
  }
  for (const Side side : {Side::A, Side::B}) sortPieces(pieces[at(side)], side, sets);
  for (const Side side : {Side::A, Side::B}) {
    for (BoundaryComponent& component : components_) {
      if (component.first_node != kNone || component.first_whole[at(side)] == component.last_whole[at(side)])
        continue;
      const WholeTriangle& whole = pieces[at(side)].wholes()[component.first_whole[at(side)]];
      component.reference = *frame.corners(side, whole.triangle)[0];
    }
  }
  for (const Side side : {Side::A, Side::B}) measureSurface(frame, pieces[at(side)], side);
  measureLoops(curves, sets);
  measureCommonFaces(frame, curves, pieces, limit);
  for (const Side side : {Side::A, Side::B}) {
    const std::uint32_t node = pieces[at(side)].contradiction();
    if (node != kNone) components_[component_of_element_[sets.find(node)]].consistent = false;
  }
  joinCavities(frame, pieces, limit);
}

std::uint32_t BoundaryComponents::componentOf(std::uint32_t element, UnionFind& sets) {
  std::uint32_t& component = component_of_element_[sets.find(element)];
  if (component == kNone) {
    component = static_cast<std::uint32_t>(components_.size());
    components_.emplace_back();
  }
  return component;
}

void BoundaryComponents::sortPieces(SurfacePieces& pieces, Side side, UnionFind& sets) {
  // From here on `element` is the component.
  for (PieceEdge& edge : pieces.edges()) edge.element = componentOf(edge.element, sets);
  for (WholeTriangle& whole : pieces.wholes()) whole.element = componentOf(whole.element, sets);
  const auto by_component = [](const auto& l, const auto& r) {
    return l.element != r.element ? l.element < r.element : l.triangle < r.triangle;
  };
  std::sort(pieces.edges().begin(), pieces.edges().end(), by_component);
  std::sort(pieces.wholes().begin(), pieces.wholes().end(), by_component);
  const auto note = [&](const auto& items, auto first, auto last) {
    for (std::uint32_t i = 0; i < items.size(); ++i) {
      BoundaryComponent& component = components_[items[i].element];
      if (i == 0 || items[i - 1].element != items[i].element) (component.*first)[at(side)] = i;
      (component.*last)[at(side)] = i + 1;
    }
  };
  note(pieces.edges(), &BoundaryComponent::first_edge, &BoundaryComponent::last_edge);
  note(pieces.wholes(), &BoundaryComponent::first_whole, &BoundaryComponent::last_whole);
}

void BoundaryComponents::measureLoops(const CrossingCurves& curves, UnionFind& sets) {
  const std::size_t count = curves.nodes().size();
  loops_.reset(count);
  loop_vector_areas_.assign(count, Eigen::Vector3d::Zero());
  loop_seen_.assign(count, 0);
  for (const CrossingSegment& segment : curves.segments()) loops_.unite(segment.start, segment.end);
  for (const CrossingSegment& segment : curves.segments()) {
    const std::uint32_t loop = loops_.find(segment.start);
    const Eigen::Vector3d& origin = curves.nodes()[loop].position;
    loop_vector_areas_[loop] += 0.5 * (curves.nodes()[segment.start].position - origin)
                                          .cross(curves.nodes()[segment.end].position - origin);
  }
  for (const CrossingSegment& segment : curves.segments()) {
    const std::uint32_t loop = loops_.find(segment.start);
    if (!segment.closed || loop_seen_[loop] != 0) continue;
    loop_seen_[loop] = 1;
    BoundaryComponent& component = components_[component_of_element_[sets.find(loop)]];
    component.vector_area += loop_vector_areas_[loop];
    component.loop_area += loop_vector_areas_[loop].norm();
    ++component.loop_count;
  }
}

void BoundaryComponents::measureSurface(WorkingFrame& frame, const SurfacePieces& pieces, Side side) {
  const MeshTopology& topology = frame.body(side).topology();
  for (BoundaryComponent& component : components_) {
    forEachWholeTriangle(pieces, component, side, [&](TriangleIndex triangle) {
      const Corners c = frame.corners(side, triangle);
      const double area = triangleArea(*c[0], *c[1], *c[2]);
      const Eigen::Vector3d normal = frame.normal(side, triangle);
      addArea(component, side, area, (*c[0] + *c[1] + *c[2]) / 3.0);
      component.facing += area * normal * normal.transpose();
      addCone(component, *c[0], *c[1], *c[2]);
      component.closed = component.closed && topology.isOnClosedShell(triangle);
    });
    forEachCutTriangle(pieces, component, side,
                       [&](TriangleIndex triangle, std::uint32_t first, std::uint32_t last) {
                         const Eigen::Vector3d& apex = pieces.edges()[first].from;
                         const Eigen::Vector3d normal = frame.normal(side, triangle);
                         double total = 0.0;
                         for (std::uint32_t i = first; i < last; ++i) {
                           const PieceEdge& edge = pieces.edges()[i];
                           const double area = 0.5 * (edge.from - apex).cross(edge.to - apex).dot(normal);
                           addArea(component, side, area, (apex + edge.from + edge.to) / 3.0);
                           addCone(component, apex, edge.from, edge.to);
                           total += area;
                         }
                         component.facing += total * normal * normal.transpose();
                       });
  }
}

void BoundaryComponents::measureCommonFaces(const WorkingFrame& frame, const CrossingCurves& curves,
                                            const SurfacePieces (&pieces)[2], WorkLimit& limit) {
  component_of_common_face_.clear();
  for (const CommonFace& face : curves.commonFaces()) {
    if (limit.isOverNow()) return;
    const TriangleIndex triangle = face.triangle[at(face.inside)];
    const Eigen::Vector3d normal = frame.normal(face.inside, triangle);
    component_of_common_face_.push_back(kNone);
    for (std::uint32_t c = 0; c < components_.size(); ++c) {
      BoundaryComponent& component = components_[c];
      if (!holdsPoint(pieces[at(face.inside)], component, face.inside, triangle, normal, face.centroid))
        continue;
      component_of_common_face_.back() = c;
      if (face.opposite) {
        component.flap_area += face.area;
        component.flap_vector_area += face.area * normal;
      } else {
        const double half = face.inside == Side::A ? -0.5 * face.area : 0.5 * face.area;
        component.shared_area += half;
        component.shared_vector_area += half * normal;
      }
      break;
    }
  }
}

double BoundaryComponents::windingOf(WorkingFrame& frame, const SurfacePieces (&pieces)[2],
                                     const BoundaryComponent& component, const Eigen::Vector3d& point) const {
  double angle = 0.0;
  for (const Side side : {Side::A, Side::B}) {
    const SurfacePieces& on_side = pieces[at(side)];
    forEachWholeTriangle(on_side, component, side, [&](TriangleIndex triangle) {
      const Corners c = frame.corners(side, triangle);
      angle += solidAngle(*c[0] - point, *c[1] - point, *c[2] - point);
    });
    forEachCutTriangle(on_side, component, side, [&](TriangleIndex, std::uint32_t first, std::uint32_t last) {
      const Eigen::Vector3d apex = on_side.edges()[first].from - point;
      for (std::uint32_t i = first; i < last; ++i)
        angle += solidAngle(apex, on_side.edges()[i].from - point, on_side.edges()[i].to - point);
    });
  }
  return angle / (4.0 * M_PI);
}

// A negative volume is the wall of a cavity of the region around it; of those it lies in, the smallest.
void BoundaryComponents::joinCavities(WorkingFrame& frame, const SurfacePieces (&pieces)[2],
                                      WorkLimit& limit) {
  const double rounding = frame.roundingBound() * frame.scale();
  for (std::uint32_t c = 0; c < components_.size(); ++c) {
    BoundaryComponent& cavity = components_[c];
    if (!cavity.closed || cavity.volume >= -2.0 * rounding * cavity.surface()) continue;
    std::uint32_t owner = kNone;
    for (std::uint32_t o = 0; o < components_.size(); ++o) {
      if (limit.isOverNow()) return;
      const BoundaryComponent& around = components_[o];
      if (!around.closed || around.volume < -cavity.volume) continue;
      if (owner != kNone && around.volume >= components_[owner].volume) continue;
      if (windingOf(frame, pieces, around, cavity.reference) > 0.5) owner = o;
    }
    if (owner == kNone) {
      cavity.consistent = false;  // a body turned inside out
      continue;
    }
    cavity.is_cavity = true;
    cavity.next_cavity = components_[owner].next_cavity;
    components_[owner].next_cavity = c;
  }
}

}  // namespace concave_distance::detail

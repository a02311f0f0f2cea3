#include "cut_planes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace concave_distance {
namespace {

struct ReflexEdge {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  std::size_t facet_1;
  std::size_t facet_2;
  double length() const { return (to - from).norm(); }
};

/// How far the facet's corners stand out beyond the plane of another.
double standsOut(const SolidFacets& solid, const SolidFacet& facet, const SolidFacet& plane) {
  double height = 0.0;
  for (const std::vector<std::uint32_t>& loop : facet.loops) {
    for (const std::uint32_t vertex : loop) {
      height = std::max(height, plane.normal.dot(solid.vertices[vertex]) - plane.offset);
    }
  }
  return height;
}

/// At an edge that runs along `direction` in the loop of facet 1, facet 2 lies in front of facet 1.
bool isReflex(const SolidFacet& facet_1, const SolidFacet& facet_2, const Eigen::Vector3d& direction) {
  return facet_1.normal.cross(facet_2.normal).dot(direction) < 0.0;
}

std::vector<ReflexEdge> reflexEdges(const SolidFacets& solid, double tolerance) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> facets_of_edge;
  for (std::size_t f = 0; f < solid.facets.size(); ++f) {
    for (const std::vector<std::uint32_t>& loop : solid.facets[f].loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        facets_of_edge[{loop[i], loop[(i + 1) % loop.size()]}].push_back(f);
      }
    }
  }
  std::vector<ReflexEdge> edges;
  for (const auto& [edge, facets] : facets_of_edge) {
    const auto back = facets_of_edge.find({edge.second, edge.first});
    if (edge.first > edge.second || back == facets_of_edge.end()) {
      continue;
    }
    // Where the solid touches itself along an edge, four facets or more meet: every two of them are tried.
    for (const std::size_t f : facets) {
      for (const std::size_t g : back->second) {
        const Eigen::Vector3d direction = solid.vertices[edge.second] - solid.vertices[edge.first];
        if (isReflex(solid.facets[f], solid.facets[g], direction) &&
            standsOut(solid, solid.facets[f], solid.facets[g]) > tolerance &&
            standsOut(solid, solid.facets[g], solid.facets[f]) > tolerance) {
          edges.push_back({solid.vertices[edge.first], solid.vertices[edge.second], f, g});
        }
      }
    }
  }
  return edges;
}

/// Length of reflex edges in the plane less a share of the length of those that it cuts.
double scoreOf(const CutPlane& plane, const std::vector<ReflexEdge>& edges, double tolerance) {
  double score = 0.0;
  for (const ReflexEdge& edge : edges) {
    const double from = plane.normal.dot(edge.from) - plane.offset;
    const double to = plane.normal.dot(edge.to) - plane.offset;
    if (std::abs(from) <= tolerance && std::abs(to) <= tolerance) {
      score += edge.length();
    } else if (std::min(from, to) < -tolerance && std::max(from, to) > tolerance) {
      score -= 0.5 * edge.length();
    }
  }
  return score;
}

}  // namespace

std::vector<CutPlane> cutPlanes(const SolidFacets& solid, double tolerance) {
  const std::vector<ReflexEdge> edges = reflexEdges(solid, tolerance);
  std::vector<CutPlane> planes;
  for (const ReflexEdge& edge : edges) {
    for (const std::size_t f : {edge.facet_1, edge.facet_2}) {
      planes.push_back({solid.facets[f].normal, solid.facets[f].offset});
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      const bool touch = edges[i].from == edges[k].from || edges[i].from == edges[k].to ||
                         edges[i].to == edges[k].from || edges[i].to == edges[k].to;
      if (!touch) {
        continue;
      }
      const Eigen::Vector3d u = (edges[i].to - edges[i].from).normalized();
      const Eigen::Vector3d v = (edges[k].to - edges[k].from).normalized();
      const Eigen::Vector3d across = u.cross(v);
      if (across.norm() > 1e-3) {
        const Eigen::Vector3d normal = across.normalized();
        planes.push_back({normal, normal.dot(edges[i].from)});
      }
    }
  }
  std::vector<std::pair<double, std::size_t>> ranking;
  ranking.reserve(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    ranking.emplace_back(-scoreOf(planes[i], edges, tolerance), i);
  }
  std::sort(ranking.begin(), ranking.end());
  std::vector<CutPlane> ordered;
  ordered.reserve(ranking.size());
  for (const auto& [score, i] : ranking) {
    ordered.push_back(planes[i]);
  }
  return ordered;
}

}  // namespace concave_distance

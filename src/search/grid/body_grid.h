#pragma once

#include <cstddef>
#include <memory>

#include "base/made_once.h"
#include "concave_distance/mesh/body_mesh.h"
#include "mesh_metric.h"
#include "search_nodes.h"

namespace concave_distance {

/// The mesh metric and what is measured with it (geodesic_extent.h), metres.
struct GraphMetric {
  std::unique_ptr<MeshMetric> metric;
  double geodesic_extent = 0.0;
  double protrusion_spacing = 0.0;
};

/// Holds what the search needs of one body: the nodes it moves on and the mesh metric. Kept with the body, so
/// that its pairs share it. Each part is made at its first use, once for all threads.
class BodyGrid final : public BodyAttachment {
 public:
  explicit BodyGrid(const BodyMesh& body) : body_(body) {}
  /// For a search on other nodes than the grid's, to be attached before the first search.
  BodyGrid(const BodyMesh& body, SearchNodes nodes);
  ~BodyGrid() override;
  BodyGrid(const BodyGrid&) = delete;
  BodyGrid& operator=(const BodyGrid&) = delete;

  const BodyMesh& body() const { return body_; }
  const SearchNodes& nodes() const {
    const SearchNodes* made = nodes_.ifMade();
    return made != nullptr ? *made : makeNodes();
  }
  const NodeGraph& graph() const { return nodes().graph; }
  const MeshMetric& metric() const { return *measured().metric; }
  /// Returns how long the paths on the body are, and how near its protrusions come to each other along the
  /// mesh (at most half as far), metres: what the radii of niching are chosen from.
  double geodesicExtent() const { return measured().geodesic_extent; }
  double protrusionSpacing() const { return measured().protrusion_spacing; }
  const SearchNodes* nodesIfMade() const { return nodes_.ifMade(); }
  const MeshMetric* metricIfMade() const;
  /// Takes memory for the metric's matrices from the body's limit, at the first call; false without room.
  bool reserveMatrices() const;

 private:
  struct Reserved {
    bool has_room = true;
    std::size_t bytes = 0;  ///< taken from the limit
  };
  const SearchNodes& makeNodes() const;
  const GraphMetric& measured() const;

  const BodyMesh& body_;
  MadeOnce<SearchNodes> nodes_;
  MadeOnce<Reserved> reserved_;
  MadeOnce<GraphMetric> measured_;
};

/// The grid that is kept with the body; the first call puts it there, with nothing made yet.
const BodyGrid& gridOf(const BodyMesh& body);

}  // namespace concave_distance

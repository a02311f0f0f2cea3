#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "base/union_find.h"
#include "concave_distance/base/error.h"
#include "search/grid/body_grid.h"
#include "search/grid/node_graph.h"
#include "support/enumeration.h"

namespace concave_distance::test {
namespace {

constexpr std::uint32_t kNotFlooded = 0xffffffffU;

// A node pair below the cutoff.
struct Cell {
  double squared_distance;
  std::uint32_t node_a;
  std::uint32_t node_b;
};

// Cells by node of A, so that a neighbour is found by a search in one short row.
struct CellTable {
  std::vector<Cell> cells;
  std::vector<std::uint32_t> row_of_a;  // offsets

  std::uint32_t find(std::uint32_t node_a, std::uint32_t node_b) const {
    const auto first = cells.begin() + row_of_a[node_a];
    const auto last = cells.begin() + row_of_a[node_a + 1];
    const auto cell =
        std::lower_bound(first, last, node_b, [](const Cell& c, std::uint32_t b) { return c.node_b < b; });
    return cell != last && cell->node_b == node_b ? static_cast<std::uint32_t>(cell - cells.begin())
                                                  : kNotFlooded;
  }
};

CellTable cellsBelow(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b, double cutoff,
                     std::size_t pair_limit) {
  CellTable table;
  const std::vector<Eigen::Vector3d>& nodes_a = gridOf(a).graph().positions;
  std::vector<Eigen::Vector3d> nodes_b = gridOf(b).graph().positions;
  for (Eigen::Vector3d& node : nodes_b) {
    node = a_from_b * node;
  }
  const double squared_cutoff = cutoff * cutoff;
  table.row_of_a.push_back(0);
  for (std::uint32_t i = 0; i < nodes_a.size(); ++i) {
    for (std::uint32_t j = 0; j < nodes_b.size(); ++j) {
      const double squared_distance = (nodes_a[i] - nodes_b[j]).squaredNorm();
      if (squared_distance <= squared_cutoff) {
        table.cells.push_back({squared_distance, i, j});
      }
    }
    if (table.cells.size() > pair_limit) {
      throw Error(a.name() + "/" + b.name(),
                  "more than " + std::to_string(pair_limit) + " node pairs lie below the cutoff",
                  "lower the cutoff or take a coarser grid");
    }
    table.row_of_a.push_back(static_cast<std::uint32_t>(table.cells.size()));
  }
  return table;
}

}  // namespace

std::vector<NodeNiche> enumerateNodeNiches(const BodyMesh& a, const BodyMesh& b,
                                           const Eigen::Isometry3d& a_from_b, double cutoff,
                                           double least_prominence, std::size_t pair_limit) {
  const CellTable table = cellsBelow(a, b, a_from_b, cutoff, pair_limit);
  std::vector<std::uint32_t> order(table.cells.size());
  std::iota(order.begin(), order.end(), 0U);
  // Equal distances in the order of the nodes: a plateau is one basin, its first cell the place.
  const auto deeper = [&](std::uint32_t l, std::uint32_t r) {
    const double dl = table.cells[l].squared_distance;
    const double dr = table.cells[r].squared_distance;
    return dl != dr ? dl < dr : l < r;
  };
  std::sort(order.begin(), order.end(), deeper);

  UnionFind basins(table.cells.size());  // the representative of a basin is its deepest cell
  std::vector<char> is_flooded(table.cells.size(), 0);
  std::vector<NodeNiche> niches;
  const auto report = [&](std::uint32_t cell, double pass) {
    const double distance = std::sqrt(table.cells[cell].squared_distance);
    const double prominence =
        distance > 0.0 ? pass / distance - 1.0 : std::numeric_limits<double>::infinity();
    if (prominence >= least_prominence && pass > distance) {
      niches.push_back(
          {distance, NodeIndex{table.cells[cell].node_a}, NodeIndex{table.cells[cell].node_b}, prominence});
    }
  };
  const CompressedRows<NodeGraph::Edge>& edges_a = gridOf(a).graph().edges;
  const CompressedRows<NodeGraph::Edge>& edges_b = gridOf(b).graph().edges;
  for (const std::uint32_t cell : order) {
    const Cell& here = table.cells[cell];
    std::uint32_t basin = kNotFlooded;
    const auto meet = [&](std::uint32_t neighbour) {
      if (neighbour == kNotFlooded || is_flooded[neighbour] == 0) {
        return;
      }
      const std::uint32_t other = basins.find(neighbour);
      if (basin == kNotFlooded) {
        basin = other;
        basins.attach(cell, other);
      } else if (other != basin) {
        // Two basins meet here: the shallower one ends, this is its pass.
        const std::uint32_t shallow = deeper(basin, other) ? other : basin;
        const std::uint32_t deep = shallow == other ? basin : other;
        report(shallow, std::sqrt(here.squared_distance));
        basins.attach(shallow, deep);
        basin = deep;
      }
    };
    for (const NodeGraph::Edge& edge : edges_a.row(here.node_a)) {
      meet(table.find(edge.to.value, here.node_b));
    }
    for (const NodeGraph::Edge& edge : edges_b.row(here.node_b)) {
      meet(table.find(here.node_a, edge.to.value));
    }
    is_flooded[cell] = 1;
  }
  for (std::uint32_t cell = 0; cell < table.cells.size(); ++cell) {
    if (basins.find(cell) == cell) {
      report(cell, std::numeric_limits<double>::infinity());
    }
  }
  std::sort(niches.begin(), niches.end(), [](const NodeNiche& l, const NodeNiche& r) {
    if (l.distance != r.distance) return l.distance < r.distance;
    if (l.node_a != r.node_a) return l.node_a < r.node_a;
    return l.node_b < r.node_b;
  });
  return niches;
}

}  // namespace concave_distance::test

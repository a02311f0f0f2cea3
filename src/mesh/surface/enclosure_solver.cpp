#include "enclosure_solver.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/union_find.h"

namespace concave_distance::detail {
namespace {

constexpr int kUnknown = std::numeric_limits<int>::min();

int signOf(int value) {
  return (value > 0) - (value < 0);
}

}  // namespace

EnclosureSolver::EnclosureSolver(const std::vector<Eigen::Vector3d>& vertices, const FaceTable& table,
                                 const EdgeTable& edges, const SurfaceUnits& units,
                                 const std::vector<FaceSide>& cells)
    : vertices_(vertices), table_(table), edges_(edges), units_(units), cells_(cells) {}

bool EnclosureSolver::solve(const std::vector<std::uint32_t>& faces, std::vector<FaceDecision>& decisions) {
  numberCells(faces);
  measureCells(faces);
  std::vector<int> net(faces.size());
  std::transform(faces.begin(), faces.end(), net.begin(),
                 [&](std::uint32_t face) { return table_.faces[face].net(); });
  const auto each_once = [&] {
    std::vector<int> once(net.size());
    std::transform(net.begin(), net.end(), once.begin(), signOf);
    return once;
  };
  if (cellsAgree()) {  // NOLINT(bugprone-branch-clone): the order of the questions counts
    takeCells(faces, decisions);
  } else if (edgesBalance(faces, net)) {
    takeWindings(faces, net, decisions);
  } else if (cellsVote()) {
    takeCells(faces, decisions);
  } else if (edgesBalance(faces, each_once())) {
    takeWindings(faces, each_once(), decisions);
  } else {
    windings_.assign(cell_count_, 1);
    windings_[outer_] = 0;
    takeCells(faces, decisions);
  }
  int common = 0;
  for (const std::uint32_t face : faces) common = std::gcd(common, decisions[face].coefficient);
  long votes = 0;
  for (const std::uint32_t face : faces) {
    if (common > 1) decisions[face].coefficient /= common;
    votes += static_cast<long>(signOf(decisions[face].coefficient)) * table_.faces[face].net();
  }
  return votes < 0;
}

void EnclosureSolver::numberCells(const std::vector<std::uint32_t>& faces) {
  std::vector<FaceSide> names;
  names.reserve(2 * faces.size());
  for (const std::uint32_t face : faces) {
    for (const std::size_t side : {std::size_t{2} * face, std::size_t{2} * face + 1})
      names.push_back(cells_[side]);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  cell_count_ = static_cast<std::uint32_t>(names.size());
  const auto number = [&](FaceSide side) {
    return static_cast<std::uint32_t>(std::lower_bound(names.begin(), names.end(), cells_[side]) -
                                      names.begin());
  };
  crossings_.clear();
  for (const std::uint32_t face : faces) {
    crossings_.push_back({number(2 * face), number(2 * face + 1), table_.faces[face].net()});
  }
}

double EnclosureSolver::volumeUnder(std::uint32_t face) const {
  const TriangleNodes& nodes = table_.faces[face].nodes;
  const Eigen::Vector3d a = vertices_[nodes[0].value] - origin_;
  const Eigen::Vector3d b = vertices_[nodes[1].value] - origin_;
  const Eigen::Vector3d c = vertices_[nodes[2].value] - origin_;
  return a.dot(b.cross(c));
}

/// Finds the outer cell: its signed volume is minus that of all others.
void EnclosureSolver::measureCells(const std::vector<std::uint32_t>& faces) {
  Eigen::AlignedBox3d box;
  for (const std::uint32_t face : faces) {
    for (const NodeIndex node : table_.faces[face].nodes) box.extend(vertices_[node.value]);
  }
  origin_ = box.center();
  std::vector<double> volumes(cell_count_, 0.0);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Crossing& crossing = crossings_[i];
    if (crossing.front == crossing.back) continue;
    const double volume = volumeUnder(faces[i]);
    volumes[crossing.back] += volume;
    volumes[crossing.front] -= volume;
  }
  outer_ = static_cast<std::uint32_t>(std::min_element(volumes.begin(), volumes.end()) - volumes.begin());
}

/// The median of the jumps between each two cells; faces wound both ways count only if there are no others.
std::vector<EnclosureSolver::Boundary> EnclosureSolver::boundariesOfCells() const {
  std::vector<Boundary> boundaries;
  for (const Crossing& crossing : crossings_) {
    const auto [low, high] = std::minmax(crossing.front, crossing.back);
    const int jump = crossing.front < crossing.back ? crossing.jump : -crossing.jump;
    if (low != high) boundaries.push_back({low, high, jump, 0});
  }
  std::sort(boundaries.begin(), boundaries.end(), [](const Boundary& l, const Boundary& r) {
    const bool says_nothing_l = l.jump == 0;
    const bool says_nothing_r = r.jump == 0;
    return std::tie(l.low, l.high, says_nothing_l, l.jump) < std::tie(r.low, r.high, says_nothing_r, r.jump);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < boundaries.size();) {
    const std::size_t first = i;
    std::size_t speaking = 0;
    for (; i < boundaries.size() && boundaries[i].low == boundaries[first].low &&
           boundaries[i].high == boundaries[first].high;
         ++i) {
      speaking += boundaries[i].jump != 0 ? 1U : 0U;
    }
    Boundary middle = boundaries[first + speaking / 2];
    middle.agreeing = std::count_if(boundaries.begin() + static_cast<std::ptrdiff_t>(first),
                                    boundaries.begin() + static_cast<std::ptrdiff_t>(i),
                                    [&](const Boundary& other) { return other.jump == middle.jump; });
    boundaries[kept++] = middle;
  }
  boundaries.resize(kept);
  return boundaries;
}

/// Numbers the cells by their boundaries, in order of agreement, those of faces wound both ways last; later
/// contradictions are ignored. Ends with 1 for material and 0 for void. False when a face wound one way has
/// one cell on both sides, or all are 0.
bool EnclosureSolver::cellsVote() {
  for (const Crossing& crossing : crossings_) {
    if (crossing.front == crossing.back && crossing.jump != 0) return false;
  }
  std::vector<Boundary> boundaries = boundariesOfCells();
  std::stable_sort(boundaries.begin(), boundaries.end(), [](const Boundary& l, const Boundary& r) {
    const bool says_l = l.jump != 0;
    const bool says_r = r.jump != 0;
    return says_l != says_r ? says_l : l.agreeing > r.agreeing;
  });
  CellSteps next(cell_count_);
  UnionFind joined(cell_count_);
  for (const Boundary& boundary : boundaries) {
    if (joined.find(boundary.low) == joined.find(boundary.high)) continue;
    joined.unite(boundary.low, boundary.high);
    next[boundary.low].emplace_back(boundary.high, boundary.jump);
    next[boundary.high].emplace_back(boundary.low, -boundary.jump);
  }
  if (!numberFromOuter(next)) return false;
  // The windings make a cell void only if most of its faces agree.
  std::vector<std::ptrdiff_t> support(cell_count_, 0);
  for (const Boundary& boundary : boundaries) {
    const bool agrees = windings_[boundary.high] - windings_[boundary.low] == boundary.jump;
    support[boundary.low] += agrees ? boundary.agreeing : -boundary.agreeing;
    support[boundary.high] += agrees ? boundary.agreeing : -boundary.agreeing;
  }
  for (std::uint32_t cell = 0; cell < cell_count_; ++cell) {
    const bool is_void = cell == outer_ || (windings_[cell] == 0 && support[cell] > 0);
    windings_[cell] = is_void ? 0 : 1;
  }
  return true;
}

/// Numbers the cells by the jumps; false on a contradiction or if all are 0.
bool EnclosureSolver::cellsAgree() {
  CellSteps next(cell_count_);
  for (const Crossing& crossing : crossings_) {
    if (crossing.front == crossing.back) {
      if (crossing.jump != 0) return false;
      continue;
    }
    auto& from_front = next[crossing.front];
    if (!from_front.empty() && from_front.back() == std::make_pair(crossing.back, crossing.jump)) continue;
    from_front.emplace_back(crossing.back, crossing.jump);
    next[crossing.back].emplace_back(crossing.front, -crossing.jump);
  }
  return numberFromOuter(next);
}

bool EnclosureSolver::numberFromOuter(const CellSteps& next) {
  windings_.assign(cell_count_, kUnknown);
  windings_[outer_] = 0;
  std::vector<std::uint32_t> waiting{outer_};
  bool any = false;
  while (!waiting.empty()) {
    const std::uint32_t cell = waiting.back();
    waiting.pop_back();
    any = any || windings_[cell] != 0;
    for (const auto& [other, jump] : next[cell]) {
      const int winding = windings_[cell] + jump;
      if (windings_[other] == kUnknown) {
        windings_[other] = winding;
        waiting.push_back(other);
      } else if (windings_[other] != winding) {
        return false;
      }
    }
  }
  return any;
}

bool EnclosureSolver::edgesBalance(const std::vector<std::uint32_t>& faces,
                                   const std::vector<int>& coefficients) const {
  const std::uint32_t unit = units_.unit_of_face[faces.front()];
  bool any = false;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    any = any || coefficients[i] != 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t edge = edges_.edge_of_half_edge[3 * faces[i] + k];
      int balance = 0;
      for (std::uint32_t at = edges_.first[edge]; at < edges_.first[edge + 1]; ++at) {
        const HalfEdge h = edges_.half_edges[at];
        if (units_.unit_of_face[h / 3] != unit) continue;
        if (h / 3 < faces[i]) {  // its first face has visited this edge
          balance = 0;
          break;
        }
        const auto place = std::lower_bound(faces.begin(), faces.end(), h / 3) - faces.begin();
        balance += (h % 3 == 2 ? -1 : 1) * coefficients[static_cast<std::size_t>(place)];
      }
      if (balance != 0) return false;
    }
  }
  return any;
}

void EnclosureSolver::takeCells(const std::vector<std::uint32_t>& faces,
                                std::vector<FaceDecision>& decisions) const {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face& face = table_.faces[faces[i]];
    const Crossing& crossing = crossings_[i];
    FaceDecision& decision = decisions[faces[i]];
    const int front = std::abs(windings_[crossing.front]);
    const int back = std::abs(windings_[crossing.back]);
    decision = {FaceRole::Sheet, back - front, false};
    if (decision.coefficient != 0) {
      decision.role = FaceRole::Skin;
    } else if (crossing.front != crossing.back && front != 0 && face.copies() > 1) {
      decision.role = FaceRole::Wall;
    } else {
      decision.both_windings = crossing.front != crossing.back && face.along > 0 && face.against > 0;
    }
  }
}

void EnclosureSolver::takeWindings(const std::vector<std::uint32_t>& faces,
                                   const std::vector<int>& coefficients,
                                   std::vector<FaceDecision>& decisions) const {
  double volume = 0.0;
  for (std::size_t i = 0; i < faces.size(); ++i) volume += coefficients[i] * volumeUnder(faces[i]);
  const int outward = volume < 0.0 ? -1 : 1;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face& face = table_.faces[faces[i]];
    const bool is_skin = coefficients[i] != 0;
    decisions[faces[i]] = {is_skin ? FaceRole::Skin : FaceRole::Sheet, outward * coefficients[i],
                           !is_skin && face.along > 0 && face.against > 0};
  }
}

}  // namespace concave_distance::detail

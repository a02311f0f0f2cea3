#include "marker_selection.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace concave_distance {
namespace {

// Assigns the rest of the count to further niches of the pairs, nearest first.
void addFartherNiches(std::vector<DrawnPair>& drawn, std::size_t count) {
  std::vector<std::pair<double, DrawnPair*>> others;
  std::size_t used = 0;
  for (DrawnPair& pair : drawn) {
    used += pair.niche_count;
    for (std::size_t k = 1; k < pair.pair->niches.size(); ++k) {
      others.emplace_back(pair.pair->niches[k].distance, &pair);
    }
  }
  std::stable_sort(others.begin(), others.end(),
                   [](const auto& left, const auto& right) { return left.first < right.first; });
  const std::size_t left = count == 0 ? others.size() : count - std::min(count, used);
  for (std::size_t k = 0; k < std::min(left, others.size()); ++k) {
    ++others[k].second->niche_count;
  }
}

}  // namespace

bool hasMarkers(const PairNiches& pair) {
  return pair.nearest.has_distance != 0 && (pair.nearest.has_points != 0 || !pair.niches.empty());
}

std::vector<DrawnPair> selectPairs(const std::vector<const PairNiches*>& pairs, const MarkerStyle& style) {
  std::vector<const PairNiches*> by_distance;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(by_distance),
               [](const PairNiches* pair) { return hasMarkers(*pair); });
  std::stable_sort(by_distance.begin(), by_distance.end(),
                   [](const PairNiches* left, const PairNiches* right) {
                     return left->nearest.distance < right->nearest.distance;
                   });
  std::vector<DrawnPair> drawn;
  for (const PairNiches* pair : by_distance) {
    const bool is_near = style.pair_count == 0 || drawn.size() < style.pair_count;
    if (!is_near && pair->nearest.warning == 0) continue;
    drawn.push_back({pair, std::min<std::size_t>(1, pair->niches.size()), drawn.empty()});
  }
  addFartherNiches(drawn, style.niche_count);
  return drawn;
}

std::set<std::size_t> warnedBodies(const Scene& scene, const std::vector<DrawnPair>& drawn, double largest) {
  std::set<std::size_t> bodies;
  for (const DrawnPair& pair : drawn) {
    const std::optional<std::size_t> body_a = scene.findBody(pair.pair->nearest.body_a);
    const std::optional<std::size_t> body_b = scene.findBody(pair.pair->nearest.body_b);
    if (pair.pair->nearest.warning == 0 || !body_a || !body_b) continue;
    const bool a_is_link = scene.bodies[*body_a].is_robot_link;
    const bool b_is_link = scene.bodies[*body_b].is_robot_link;
    const std::size_t obstacle = a_is_link ? *body_b : *body_a;
    if (a_is_link != b_is_link && bodies.count(obstacle) != 0) continue;  // by a nearer link
    bodies.insert({*body_a, *body_b});
  }
  for (auto body = bodies.begin(); body != bodies.end();) {
    const SceneBody& warned = scene.bodies[*body];
    // A cloud is all that a sensor sees, and another mesh several times a second.
    body = warned.cloud || warned.mesh->diameter() > largest ? bodies.erase(body) : std::next(body);
  }
  return bodies;
}

}  // namespace concave_distance

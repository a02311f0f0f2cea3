#include "link_adjacency.h"

#include <cstddef>
#include <deque>
#include <map>
#include <vector>

namespace concave_distance::detail {
namespace {

struct Neighbour {
  std::size_t link;
  bool fixed;
};

// The joints as a graph over link numbers, both ways.
std::vector<std::vector<Neighbour>> neighboursOf(const RobotDescription& robot) {
  std::map<std::string, std::size_t> number;
  for (std::size_t i = 0; i < robot.links.size(); ++i) number[robot.links[i].name] = i;
  std::vector<std::vector<Neighbour>> neighbours(robot.links.size());
  for (const RobotJoint& joint : robot.joints) {
    const auto parent = number.find(joint.parent);
    const auto child = number.find(joint.child);
    if (parent == number.end() || child == number.end()) continue;
    const bool fixed = joint.type == JointType::Fixed;
    neighbours[parent->second].push_back({child->second, fixed});
    neighbours[child->second].push_back({parent->second, fixed});
  }
  return neighbours;
}

// Least number of moving joints from `start` to each link, through links without geometry only; at most one
// is asked for, so a walk with two is not followed. Joints form a tree: a link is reached one way.
std::vector<std::size_t> reachedBy(std::size_t start, const RobotDescription& robot,
                                   const std::vector<std::vector<Neighbour>>& neighbours) {
  constexpr std::size_t kUnreached = 2;
  std::vector<std::size_t> moving(robot.links.size(), kUnreached);
  std::deque<std::size_t> open{start};
  moving[start] = 0;
  while (!open.empty()) {
    const std::size_t link = open.front();
    open.pop_front();
    if (link != start && robot.links[link].hasGeometry()) continue;
    for (const Neighbour& next : neighbours[link]) {
      const std::size_t count = moving[link] + (next.fixed ? 0 : 1);
      if (count < moving[next.link]) {
        moving[next.link] = count;
        open.push_back(next.link);
      }
    }
  }
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (i != start && moving[i] < kUnreached) reached.push_back(i);
  }
  return reached;
}

}  // namespace

LinkPair linkPair(const std::string& a, const std::string& b) {
  return a < b ? LinkPair(a, b) : LinkPair(b, a);
}

std::set<LinkPair> adjacentLinks(const RobotDescription& robot) {
  const std::vector<std::vector<Neighbour>> neighbours = neighboursOf(robot);
  std::set<LinkPair> adjacent;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    if (!robot.links[i].hasGeometry()) continue;
    for (const std::size_t other : reachedBy(i, robot, neighbours)) {
      if (robot.links[other].hasGeometry()) {
        adjacent.insert(linkPair(robot.links[i].name, robot.links[other].name));
      }
    }
  }
  return adjacent;
}

}  // namespace concave_distance::detail

#pragma once

#include <set>
#include <string>
#include <utility>

#include "robot_description.h"

namespace concave_distance::detail {

/// An unordered pair of link names, the lesser first.
using LinkPair = std::pair<std::string, std::string>;
LinkPair linkPair(const std::string& a, const std::string& b);

/// Pairs of links with geometry that touch by construction: the joints between them lead through links
/// without geometry only, and at most one of them moves. O(links^2) at worst.
std::set<LinkPair> adjacentLinks(const RobotDescription& robot);

}  // namespace concave_distance::detail

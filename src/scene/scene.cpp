#include "concave_distance/scene/scene.h"

namespace concave_distance {

std::optional<std::size_t> Scene::findBody(const std::string& name) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name) return i;
  }
  return std::nullopt;
}

std::optional<std::size_t> Scene::findPair(const std::string& name_a, const std::string& name_b) const {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::string& a = bodies[pairs[i].body_a].name;
    const std::string& b = bodies[pairs[i].body_b].name;
    if ((a == name_a && b == name_b) || (a == name_b && b == name_a)) return i;
  }
  return std::nullopt;
}

}  // namespace concave_distance

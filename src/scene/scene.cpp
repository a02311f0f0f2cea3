#include "concave_distance/scene/scene.h"

namespace concave_distance {

std::optional<std::size_t> Scene::findBody(const std::string& name) const {
  return bodies.find(name);
}

std::optional<std::size_t> Scene::findPair(const std::string& name_a, const std::string& name_b) const {
  const std::optional<std::size_t> a = bodies.find(name_a);
  const std::optional<std::size_t> b = bodies.find(name_b);
  return a && b ? pairs.find(*a, *b) : std::nullopt;
}

}  // namespace concave_distance

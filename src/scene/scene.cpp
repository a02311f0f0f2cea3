#include "concave_distance/scene/scene.h"

#include <algorithm>

#include "base/parameter_checks.h"
#include "concave_distance/base/error.h"

namespace concave_distance {

void requireMargin(const std::string& where, double margin, const BodyMesh& body) {
  detail::requireNotNegative(where, "margin", margin);
  if (margin <= body.diameter()) return;
  throw Error(where,
              "margin " + detail::toText(margin) + " m is larger than the body, whose diagonal is " +
                  detail::toText(body.diameter()) + " m",
              "give it in metres; for a ball of this size use a sphere");
}

TrackerParameters withMargins(TrackerParameters settings, const SceneBody& a, const SceneBody& b) {
  settings.margin_a = a.margin;
  settings.margin_b = b.margin;
  return settings;
}

std::optional<std::size_t> Scene::findBody(const std::string& name) const {
  return bodies.find(name);
}

std::optional<std::size_t> Scene::findBody(std::uint64_t serial) const {
  const auto found = std::find_if(bodies.begin(), bodies.end(),
                                  [&](const SceneBody& body) { return body.serial == serial; });
  if (found == bodies.end()) return std::nullopt;
  return static_cast<std::size_t>(found - bodies.begin());
}

std::optional<std::size_t> Scene::findPair(const std::string& name_a, const std::string& name_b) const {
  const std::optional<std::size_t> a = bodies.find(name_a);
  const std::optional<std::size_t> b = bodies.find(name_b);
  return a && b ? pairs.find(*a, *b) : std::nullopt;
}

}  // namespace concave_distance

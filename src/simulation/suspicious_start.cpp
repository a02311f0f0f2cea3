#include "suspicious_start.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance::detail {
namespace {

// Geometry may leave parts out that have mass.
constexpr double kMostMoment = 2.0;
// The least moment of inertia relative to the mass times the square of half the body's width: all of the mass
// would lie within a hundredth of that.
constexpr double kLeastMoment = 1e-4;
// A force that grows with the power 1.5 of the depth stores this share of force times depth.
constexpr double kStored = 0.4;
constexpr double kGravityOnEarth = 9.81;  // m/s^2
constexpr std::size_t kNamedPairs = 3;

std::string nameOf(const SimulationSettings& settings, const std::string& body) {
  for (const SimulatedBodySettings& entry : settings.bodies) {
    if (entry.body == body && !entry.where.empty()) return entry.where + ": body '" + body + "'";
  }
  return "body '" + body + "'";
}

/// Returns the distance of a point to a box, 0 inside.
double distanceTo(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& point) {
  return std::sqrt(box.squaredExteriorDistance(point));
}

bool isHeld(const SimulatedBodySettings& settings) {
  return settings.motion != BodyMotion::Free || settings.drive.has_value() || !settings.loads.empty();
}

/// Open surfaces alone have no depth, and no force.
bool hasClosedShell(const SceneBody& body) {
  const std::vector<bool>& closed = body.mesh->topology().shell_is_closed;
  return std::find(closed.begin(), closed.end(), true) != closed.end();
}

bool bringsForce(const Scene& scene, const ScenePair& pair) {
  return pair.enabled && pair.settings.effects.normal_force && hasClosedShell(scene.bodies[pair.body_a]) &&
         hasClosedShell(scene.bodies[pair.body_b]);
}

}  // namespace

std::vector<std::string> warnOfMasses(const Scene& scene, const SimulationSettings& settings,
                                      const std::vector<MovingBody>& moving) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (!moving[i].isFree()) continue;
    const RigidBody& rigid = moving[i].rigid();
    const Eigen::AlignedBox3d box = scene.bodies[i].mesh->surface().boundingBox();
    const double width = box.diagonal().norm();
    const std::string name = nameOf(settings, scene.bodies[i].name);
    const double outside = distanceTo(box, rigid.centreInBody());
    TextStream text;
    text.imbue(std::locale::classic());
    if (outside > width) {
      text << name << " has its centre of mass " << outside << " m outside its surface, which is " << width
           << " m wide; check `centre` of its inertia: metres, in the body's frame";
      warnings.push_back(text.str());
      continue;
    }
    const double largest = rigid.principalMoments().maxCoeff();
    const double most = rigid.mass() * moving[i].radius() * moving[i].radius();
    if (largest <= kMostMoment * most && largest >= kLeastMoment * 0.25 * rigid.mass() * width * width)
      continue;
    text << name << " has a largest moment of inertia of " << largest << " kg m^2; " << rigid.mass()
         << " kg at its farthest point would have " << most
         << "; check `inertia`, or give `mass` or `density` in its place";
    warnings.push_back(text.str());
  }
  return warnings;
}

std::vector<std::string> warnOfMissingPairs(const Scene& scene, const SimulationSettings& settings) {
  std::vector<std::size_t> free;
  for (const SimulatedBodySettings& body : settings.bodies) {
    const auto index = scene.findBody(body.body);
    if (index && body.motion == BodyMotion::Free) free.push_back(*index);
  }
  std::string named;
  std::string first;
  std::size_t count = 0;
  const auto hasPair = [&](std::size_t a, std::size_t b) {
    return std::any_of(scene.pairs.begin(), scene.pairs.end(), [&](const ScenePair& pair) {
      return (pair.body_a == a && pair.body_b == b) || (pair.body_a == b && pair.body_b == a);
    });
  };
  for (std::size_t i = 0; i < free.size(); ++i) {
    for (std::size_t j = i + 1; j < free.size(); ++j) {
      const SceneBody& a = scene.bodies[free[i]];
      const SceneBody& b = scene.bodies[free[j]];
      if ((a.is_robot_link && b.is_robot_link) || hasPair(free[i], free[j])) continue;
      if (count++ >= kNamedPairs) continue;
      named += (named.empty() ? "'" : ", '") + a.name + "' and '" + b.name + "'";
      if (first.empty()) first = "[" + a.name + ", " + b.name + "]";
    }
  }
  if (count == 0) return {};
  if (count > kNamedPairs) named += " and " + std::to_string(count - kNamedPairs) + " more";
  return {"free bodies without a pair pass through each other: " + named + "; add `- between: " + first +
          "` with effects to `pairs`, or with `enabled: false` if that is meant"};
}

std::vector<std::string> warnOfDeepStarts(const SimulationSettings& settings,
                                          const std::vector<MovingBody>& moving,
                                          const std::vector<SimulatedBody>& bodies,
                                          const std::vector<SimulatedPair>& pairs,
                                          const std::vector<Eigen::Vector3d>& normal) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (!moving[i].isFree()) continue;
    double depth = 0.0;
    std::size_t other = i;
    for (const SimulatedPair& pair : pairs) {
      if ((pair.body_a != i && pair.body_b != i) || pair.contacts.regions.empty()) continue;
      if (!(pair.contacts.regions.front().overlap.depth > depth)) continue;
      depth = pair.contacts.regions.front().overlap.depth;
      other = pair.body_a == i ? pair.body_b : pair.body_a;
    }
    const double stored = kStored * normal[i].norm() * depth;
    const double mass = moving[i].rigid().mass();
    const double usual = std::max(mass * kGravityOnEarth * moving[i].radius(),
                                  moving[i].rigid().kineticEnergy(moving[i].state()));
    if (!(stored > usual)) continue;
    TextStream text;
    text.imbue(std::locale::classic());
    text.precision(3);
    text << nameOf(settings, bodies[i].name) << " begins " << depth << " m deep in '" << bodies[other].name
         << "', which throws it out with about " << stored << " J, " << std::sqrt(2.0 * stored / mass)
         << " m/s; begin it where the surfaces do not overlap";
    warnings.push_back(text.str());
  }
  return warnings;
}

std::vector<std::string> warnOfUnheldBodies(const Scene& scene, const SimulationSettings& settings) {
  std::vector<std::string> warnings;
  if (settings.gravity.isZero(0.0)) return warnings;
  std::vector<bool> held(scene.bodies.size(), true);  // what the section does not name is fixed
  for (const SimulatedBodySettings& body : settings.bodies) {
    if (const auto index = scene.findBody(body.body)) held[*index] = isHeld(body);
  }
  for (bool spreads = true; spreads;) {
    spreads = false;
    for (const ScenePair& pair : scene.pairs) {
      if (held[pair.body_a] == held[pair.body_b] || !bringsForce(scene, pair)) continue;
      held[pair.body_a] = held[pair.body_b] = spreads = true;
    }
  }
  for (const SimulatedBodySettings& body : settings.bodies) {
    const auto index = scene.findBody(body.body);
    if (!index || held[*index]) continue;
    warnings.push_back((body.where.empty() ? "" : body.where + ": ") + "body '" + body.body +
                       "' falls for good: no enabled pair with a normal_force leads to a body that is held; "
                       "give such a pair `effects: {normal_force: ...}`, give the body a drive, or fix it");
  }
  return warnings;
}

}  // namespace concave_distance::detail

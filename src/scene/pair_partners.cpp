#include "pair_partners.h"

#include <unordered_map>
#include <unordered_set>

#include "concave_distance/base/error.h"
#include "matching_bodies.h"

namespace concave_distance {
namespace {

// Reports bodies of other frames that do not move relative to a new one's.
class MovingBodies {
 public:
  MovingBodies(const Scene& scene, const std::string& frame, const PairPartners& partners, AddedPairs& added)
      : scene_(scene), frame_(frame), partners_(partners), added_(added) {}

  void look(std::size_t index) {
    const SceneBody& other = scene_.bodies[index];
    if (other.carrier == 0 && other.frame != frame_ && isRigid(other.frame))
      added_.rigid_neighbours.push_back(other.name);
  }

  std::vector<std::string> found_by_asking;  ///< frames

 private:
  // tf is asked once for each frame, because many bodies share few frames.
  bool isRigid(const std::string& frame) {
    const auto [place, is_new] = rigid_.emplace(frame, false);
    if (is_new) {
      place->second = scene_.rigid.areJoined(frame, frame_);
      if (!place->second && partners_.is_rigid && partners_.is_rigid(frame, frame_)) {
        place->second = true;
        found_by_asking.push_back(frame);
      }
    }
    return place->second;
  }

  const Scene& scene_;
  const std::string& frame_;
  const PairPartners& partners_;
  AddedPairs& added_;
  std::unordered_map<std::string, bool> rigid_;
};

Partners partnersNamed(const Scene& scene, const SceneBody& body, const PairPartners& partners,
                       AddedPairs& added) {
  Partners found;
  MovingBodies moving(scene, body.frame, partners, added);
  std::unordered_set<std::size_t> seen;
  // First those named by themselves, which no filter leaves out.
  for (const std::string& name : partners.names) {
    if (name == body.name) {
      throw Error("pair_with", "it names the new body '" + name + "' itself", "name other bodies");
    }
    if (const auto index = scene.findBody(name); index && seen.insert(*index).second) {
      found.named.push_back(*index);
    }
  }
  for (const std::string& name : partners.names) {
    const std::vector<std::size_t> bodies = partners.may_be_gone
                                                ? detail::findMatchingBodies(scene, name).bodies
                                                : detail::matchingBodies(scene, name, "pair_with").bodies;
    if (bodies.empty()) added.unknown.push_back(name);
    for (const std::size_t index : bodies) {
      if (!seen.insert(index).second) continue;
      moving.look(index);
      found.by_rule.insert(index);  // ruleOf() leaves it out while it does not move
    }
  }
  found.rigid_frames = std::move(moving.found_by_asking);
  return found;
}

Partners partnersThatMove(const Scene& scene, const SceneBody& body, const PairPartners& partners,
                          AddedPairs& added) {
  Partners found;
  std::unordered_set<std::size_t> touched;
  for (const std::string& name : partners.may_touch) {
    const std::vector<std::size_t> bodies = detail::findMatchingBodies(scene, name).bodies;
    touched.insert(bodies.begin(), bodies.end());
    if (bodies.empty()) {
      added.unknown.push_back(name);
    }
  }
  MovingBodies moving(scene, body.frame, partners, added);
  for (std::size_t index = 0; index < scene.bodies.size(); ++index) {
    if (touched.count(index) != 0) continue;
    moving.look(index);
    found.by_rule.insert(index);
  }
  found.rigid_frames = std::move(moving.found_by_asking);
  return found;
}

}  // namespace

Partners partnersOf(const Scene& scene, const SceneBody& body, const PairPartners& partners,
                    AddedPairs& added) {
  if (partners.none && !partners.names.empty()) {
    throw Error("pair_with", "it names '" + partners.names.front() + "', and without_pairs is set",
                "give one of the two");
  }
  if (!partners.names.empty() && !partners.may_touch.empty()) {
    throw Error("touch_links", "pair_with names the bodies to watch already", "leave one of the two empty");
  }
  if (partners.none) {
    return {};
  }
  return partners.names.empty() ? partnersThatMove(scene, body, partners, added)
                                : partnersNamed(scene, body, partners, added);
}

}  // namespace concave_distance

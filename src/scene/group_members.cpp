#include "group_members.h"

#include <map>
#include <optional>
#include <unordered_map>

namespace concave_distance::detail {
namespace {

/// Adds to the groups of bodies those of what they are attached to.
class Inheritance {
 public:
  Inheritance(const Scene& scene, std::vector<GroupMembers::Mask>& masks) : scene_(scene), masks_(masks) {
    bool is_any = false;
    for (const SceneBody& body : scene.bodies) is_any = is_any || body.attachment;
    if (!is_any) return;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const SceneBody& body = scene.bodies[i];
      place_of_serial_.emplace(body.serial, i);
      if (body.is_robot_link) links_at_[scene.rigid.rootOf(body.frame)] |= masks[i];
    }
    is_done_.assign(scene.bodies.size(), false);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) follow(i);
  }

 private:
  std::optional<std::size_t> parentOf(std::size_t body) const {
    const std::shared_ptr<const Attachment>& attachment = scene_.bodies[body].attachment;
    if (!attachment) return std::nullopt;
    const auto found = place_of_serial_.find(attachment->parent_serial);
    return found == place_of_serial_.end() ? std::nullopt : std::optional(found->second);
  }

  // From the end of the chain of attachments back to the body.
  void follow(std::size_t body) {
    chain_.clear();
    for (std::optional<std::size_t> at = body; at && !is_done_[*at]; at = parentOf(*at))
      chain_.push_back(*at);
    for (; !chain_.empty(); chain_.pop_back()) {
      const std::size_t at = chain_.back();
      is_done_[at] = true;
      if (const auto parent = parentOf(at)) {
        masks_[at] |= masks_[*parent];
      } else if (const auto& attachment = scene_.bodies[at].attachment) {
        const auto links = links_at_.find(scene_.rigid.rootOf(attachment->parent));
        if (links != links_at_.end()) masks_[at] |= links->second;
      }
    }
  }

  const Scene& scene_;
  std::vector<GroupMembers::Mask>& masks_;
  std::unordered_map<std::uint64_t, std::size_t> place_of_serial_;
  std::map<std::string, GroupMembers::Mask> links_at_;  ///< by RigidFrames::rootOf()
  std::vector<bool> is_done_;
  std::vector<std::size_t> chain_;
};

}  // namespace

GroupMembers::GroupMembers(const Scene& scene) : masks_(scene.bodies.size(), 0) {
  for (const auto& [name, members] : scene.groups) {
    if (names_.size() == kMostGroups) break;
    for (const std::string& member : members) {
      if (const auto body = scene.findBody(member)) masks_[*body] |= Mask{1} << names_.size();
    }
    names_.push_back(name);
  }
  Inheritance(scene, masks_);
}

// All pairs less those of two bodies that stand for the group and those of two that do not.
std::size_t GroupMembers::countFacing(const Scene& scene, std::size_t group) const {
  std::vector<bool> inside(masks_.size());
  std::vector<bool> outside(masks_.size());
  for (std::size_t i = 0; i < masks_.size(); ++i) {
    inside[i] = (masks_[i] >> group & 1U) != 0;
    outside[i] = !inside[i];
  }
  return countRuledPairs(scene) - countRuledPairs(scene, inside) - countRuledPairs(scene, outside);
}

}  // namespace concave_distance::detail

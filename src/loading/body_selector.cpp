#include "body_selector.h"

#include <algorithm>

#include "concave_distance/base/error.h"
#include "kinematics/wording.h"
#include "scene/name_pattern.h"

namespace concave_distance::detail {
namespace {

// Enough to see a misspelt name beside the right one; a list cut short says so.
constexpr std::size_t kMostNamesListed = 30;

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "none" : detail::listed(names, kMostNamesListed);
}

void addOnce(std::vector<std::size_t>& into, const std::vector<std::size_t>& sources) {
  for (const std::size_t source : sources) {
    if (std::find(into.begin(), into.end(), source) == into.end()) into.push_back(source);
  }
}

}  // namespace

BodySelector::BodySelector(const SceneParts& parts, const std::vector<GroupSpec>& groups,
                           std::vector<std::string>& notes)
    : parts_(parts) {
  for (std::size_t i = 0; i < parts.sources.size(); ++i) source_of_name_[parts.sources[i].name] = i;
  const auto is_in_file = [&](const std::string& name) {
    return std::any_of(groups.begin(), groups.end(), [&](const GroupSpec& g) { return g.name == name; });
  };
  for (const auto& [name, members] : parts.groups) {
    if (source_of_name_.count(name) != 0 || groups_.count(name) != 0 || is_in_file(name)) {
      notes.push_back("group '" + name + "' of a robot is not there: the name stands for something else");
      continue;
    }
    std::vector<std::size_t>& sources = groups_[name];
    for (const std::string& member : members) {
      const auto found = source_of_name_.find(member);
      if (found != source_of_name_.end()) addOnce(sources, {found->second});
    }
  }
  for (const GroupSpec& group : groups) {
    if (source_of_name_.count(group.name) != 0) {
      throw Error(group.where, "the name '" + group.name + "' is taken by a body",
                  "give the group another name");
    }
    std::vector<std::size_t> sources;
    for (const Selector& member : group.members) addOnce(sources, select(member).sources);
    groups_[group.name] = std::move(sources);
  }
}

BodySelector::Selection BodySelector::select(const Selector& selector) const {
  const std::string& text = selector.text;
  if (const auto body = source_of_name_.find(text); body != source_of_name_.end()) {
    return {{body->second}, true, false, false};
  }
  if (const auto group = groups_.find(text); group != groups_.end())
    return {group->second, false, false, false};
  if (parts_.bare_links.count(text) != 0) return {{}, true, true, false};
  Selection selection;
  bool matches_bare_link = false;
  if (isPattern(text)) {
    for (std::size_t i = 0; i < parts_.sources.size(); ++i) {
      if (matchesPattern(text, parts_.sources[i].name)) selection.sources.push_back(i);
    }
    matches_bare_link = std::any_of(parts_.bare_links.begin(), parts_.bare_links.end(),
                                    [&](const std::string& link) { return matchesPattern(text, link); });
  }
  if (selection.sources.empty() && !matches_bare_link) {
    if (parts_.robot_failed) return {{}, !isPattern(text), false, true};
    std::vector<std::string> bodies;
    for (const BodySource& source : parts_.sources) bodies.push_back(source.name);
    std::vector<std::string> groups;
    for (const auto& group : groups_) groups.push_back(group.first);
    throw Error(selector.where,
                "'" + text + (isPattern(text) ? "' matches no body" : "' is not a body, link or group"),
                "bodies: " + listed(bodies) + "; groups: " + listed(groups));
  }
  return selection;
}

}  // namespace concave_distance::detail

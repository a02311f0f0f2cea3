#include "semantic_description.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "kinematics/wording.h"

namespace concave_distance::detail {
namespace {

using tinyxml2::XMLElement;

template <typename Visit>
void forEachChild(const XMLElement& parent, const char* name, const Visit& visit) {
  for (const auto* child = parent.FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name)) {
    visit(*child);
  }
}

std::string linkName(const XMLElement& element, const char* name) {
  return withoutLeadingSlash(attribute(element, name));
}

// Reads one SRDF against one robot; notes gather in the result.
class Reader {
 public:
  Reader(const RobotDescription& robot, std::string where, SemanticDescription& result)
      : robot_(robot), where_(std::move(where)), result_(result) {}

  // In MoveIt's order: first links disabled against all others, then pairs enabled again, then pairs disabled
  // by name.
  void readDisabledPairs(const XMLElement& root) {
    forEachChild(root, "disable_default_collisions", [&](const XMLElement& element) {
      const std::string link = linkName(element, "link");
      if (!isLink(link, element)) return;
      for (const RobotLink& other : robot_.links) {
        if (other.name != link) result_.disabled.insert(linkPair(link, other.name));
      }
    });
    forEachPair(root, "enable_collisions", [&](const LinkPair& pair) { result_.disabled.erase(pair); });
    forEachPair(root, "disable_collisions", [&](const LinkPair& pair) { result_.disabled.insert(pair); });
  }

  void readGroups(const XMLElement& root) {
    forEachChild(root, "group", [&](const XMLElement& group) {
      const std::string name = attribute(group, "name");
      if (name.empty()) return note(group, "a group without a name is left out");
      if (findGroup(name) != nullptr) return note(group, "a second group '" + name + "' is left out");
      std::vector<std::string> links;
      forEachChild(group, "link", [&](const XMLElement& element) {
        const std::string link = linkName(element, "name");
        if (isLink(link, element)) add(links, link);
      });
      forEachChild(group, "joint", [&](const XMLElement& element) { addJoint(links, element); });
      forEachChild(group, "chain", [&](const XMLElement& element) { addChain(links, element); });
      forEachChild(group, "group", [&](const XMLElement& element) { addGroup(links, element); });
      result_.groups.emplace_back(name, std::move(links));
    });
  }

  // Disabled by mistake, a pair would never be watched, and nobody would notice.
  void requireThisRobot(const std::string& name) {
    const bool has_other_links = unknown_link_ && (name != robot_.name || known_links_ == 0);
    if (has_other_links) {
      throw Error(where_,
                  "it is the SRDF of robot '" + name + "' with the link '" + *unknown_link_ +
                      "', and this is robot '" + robot_.name + "' without that link",
                  "give the SRDF of this robot");
    }
    if (name != robot_.name) {
      result_.warnings.push_back(
          where_ + ": it is for robot '" + name + "', read for '" + robot_.name +
          "', which has all the links that it names. If it is not meant for this robot, pairs are "
          "missing; if it is, give both the same name");
    }
  }

 private:
  template <typename Visit>
  void forEachPair(const XMLElement& root, const char* name, const Visit& visit) {
    forEachChild(root, name, [&](const XMLElement& element) {
      const std::string a = linkName(element, "link1");
      const std::string b = linkName(element, "link2");
      if (isLink(a, element) && isLink(b, element)) visit(linkPair(a, b));
    });
  }

  static void add(std::vector<std::string>& links, const std::string& link) {
    if (std::find(links.begin(), links.end(), link) == links.end()) links.push_back(link);
  }

  void note(const XMLElement& element, const std::string& text) {
    result_.notes.push_back(where_ + ":" + std::to_string(element.GetLineNum()) + ": " + text);
  }

  bool isLink(const std::string& link, const XMLElement& element) {
    if (robot_.findLink(link) != nullptr) {
      ++known_links_;
      return true;
    }
    unknown_link_ = link;
    note(element, std::string(element.Name()) + " names '" + link + "', no link of robot '" + robot_.name +
                      "'; left out");
    return false;
  }

  const std::vector<std::string>* findGroup(const std::string& name) const {
    for (const auto& group : result_.groups) {
      if (group.first == name) return &group.second;
    }
    return nullptr;
  }

  void addJoint(std::vector<std::string>& links, const XMLElement& element) {
    const std::string name = attribute(element, "name");
    for (const RobotJoint& joint : robot_.joints) {
      if (joint.name == name) return add(links, joint.child);
    }
    // A virtual joint moves the whole robot and has no link of its own.
    note(element, "joint '" + name + "' is not a joint of the URDF; left out of its group");
  }

  void addChain(std::vector<std::string>& links, const XMLElement& element) {
    const std::string base = linkName(element, "base_link");
    std::string link = linkName(element, "tip_link");
    if (!isLink(base, element) || !isLink(link, element)) return;
    std::vector<std::string> from_tip;
    while (link != base) {
      from_tip.push_back(link);
      const auto joint = std::find_if(robot_.joints.begin(), robot_.joints.end(),
                                      [&](const RobotJoint& candidate) { return candidate.child == link; });
      if (joint == robot_.joints.end()) {
        return note(element, "chain: '" + base + "' is not above '" + from_tip.front() + "'; left out");
      }
      link = joint->parent;
    }
    for (auto from_base = from_tip.rbegin(); from_base != from_tip.rend(); ++from_base) {
      add(links, *from_base);
    }
  }

  void addGroup(std::vector<std::string>& links, const XMLElement& element) {
    const std::string name = attribute(element, "name");
    const std::vector<std::string>* group = findGroup(name);
    if (group == nullptr) {
      return note(element, "group '" + name + "' is not above the group that names it; left out");
    }
    for (const std::string& link : std::vector<std::string>(*group)) add(links, link);
  }

  const RobotDescription& robot_;
  std::string where_;
  SemanticDescription& result_;
  std::size_t known_links_ = 0;              ///< in all elements
  std::optional<std::string> unknown_link_;  ///< one of them
};

}  // namespace

SemanticDescription readSemanticDescription(const std::string& srdf, const std::string& where,
                                            const RobotDescription& robot) {
  tinyxml2::XMLDocument document;
  document.Parse(srdf.c_str(), srdf.size());
  if (document.Error()) {
    throw Error(where, "the SRDF cannot be read; " + xmlError(document), "mend the XML");
  }
  const XMLElement* root = document.FirstChildElement("robot");
  if (root == nullptr) throw Error(where, "the SRDF has no <robot> element", "give an SRDF");
  SemanticDescription result;
  Reader reader(robot, where, result);
  reader.readDisabledPairs(*root);
  reader.readGroups(*root);
  reader.requireThisRobot(attribute(*root, "name"));
  return result;
}

}  // namespace concave_distance::detail

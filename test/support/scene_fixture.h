#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"
#include "support/mesh_measures.h"
#include "support/temporary_folder.h"

namespace concave_distance::test {

inline bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The bounding box is [0, 1] x [0, 2] x [0, 3], the volume 1; no symmetry hides a mistaken axis.
inline std::string tetrahedronStl() {
  return "solid t\n"
         "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 2 0\nvertex 1 0 0\nendloop\nendfacet\n"
         "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 3\nendloop\nendfacet\n"
         "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 3\nvertex 0 2 0\nendloop\nendfacet\n"
         "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 2 0\nvertex 0 0 3\nendloop\nendfacet\n"
         "endsolid t\n";
}

/// Scenes from texts and small files in a folder of their own. Grids are coarse: no test here needs a search.
class SceneTest : public ::testing::Test {
 protected:
  SceneTest() {
    options.package_locator = [this](const std::string& package) {
      return package == "arm_description" ? folder.path() : std::string();
    };
  }

  Scene load(const std::string& yaml) const {
    return loadSceneText(yaml, "scene.yaml", folder.path(), options);
  }

  /// A scene of one robot; the grid is coarse.
  Scene loadRobot(const std::string& urdf, const std::string& more_of_robot = "",
                  const std::string& srdf = "") {
    options.descriptions["robot_description"] = urdf;
    options.descriptions["semantics"] = srdf;
    return load("defaults: {max_edge_length: 100}\nrobots:\n  - description: robot_description\n" +
                (srdf.empty() ? "" : std::string("    semantic_description: semantics\n")) + more_of_robot);
  }

  /// The whole message of the error that the text must end in.
  std::string refusal(const std::string& yaml) const {
    try {
      load(yaml);
      return "accepted";
    } catch (const Error& error) {
      return error.what();
    }
  }

  TemporaryFolder folder;
  SceneLoadOptions options;
};

inline std::vector<std::string> bodyNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const SceneBody& body : scene.bodies) names.push_back(body.name);
  return names;
}

/// The listed ones first, then those by rule.
inline std::vector<std::string> pairNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const ScenePair& pair : allPairs(scene)) names.push_back(pair.name);
  return names;
}

inline bool hasNote(const Scene& scene, const std::string& part) {
  for (const std::string& note : scene.notes) {
    if (mentions(note, part)) return true;
  }
  return false;
}

/// A link with one box of edge 1, and a joint; what URDFs of tests are made of.
inline std::string boxLink(const std::string& name) {
  return "<link name='" + name + "'><collision><geometry><box size='1 1 1'/></geometry></collision></link>";
}
inline std::string bareLink(const std::string& name) {
  return "<link name='" + name + "'/>";
}
inline std::string joint(const std::string& type, const std::string& parent, const std::string& child) {
  return "<joint name='" + parent + "_" + child + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>";
}
inline std::string robot(const std::string& content) {
  return "<robot name='arm'>" + content + "</robot>";
}

}  // namespace concave_distance::test

#pragma once

#include <CLI/CLI.hpp>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/csv_table.h"
#include "concave_distance/base/error.h"

namespace concave_distance::tools {

/// Splits NAME=VALUE. @throws Error naming the option
inline std::pair<std::string, std::string> assignment(const std::string& option, const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size()) {
    throw Error(option, "it is '" + text + "'", "write a name, = and what it is");
  }
  return {text.substr(0, at), text.substr(at + 1)};
}

/// Returns the text of a URDF or SRDF file. @throws Error naming the file
inline std::string readDescription(const std::string& path) {
  requireReadableFile(path);
  std::ifstream file(path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file || text.empty()) throw Error(path, "it cannot be read, or is empty", "name a URDF file");
  return text;
}

inline void addDescriptionOption(CLI::App& app, std::vector<std::string>& descriptions,
                                 const std::string& what) {
  app.add_option("--description", descriptions, what + " that the scene file names; once for each")
      ->type_name("NAME=FILE");
}

/// Reads the files that options NAME=FILE name into texts by that name, and appends them to the places to
/// search for meshes. @throws Error naming option or file
inline void readDescriptions(const std::vector<std::string>& given, std::map<std::string, std::string>& texts,
                             std::vector<std::string>& mesh_search_path) {
  for (const std::string& description : given) {
    const auto [name, path] = assignment("--description", description);
    texts[name] = readDescription(path);
    mesh_search_path.push_back(path);
  }
}

}  // namespace concave_distance::tools

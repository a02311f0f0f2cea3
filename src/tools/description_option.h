#pragma once

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

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

}  // namespace concave_distance::tools

#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace concave_distance::detail {

/// The file name's ending with its dot, in lower case.
inline std::string lowerCaseExtension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace concave_distance::detail

#include "mesh_content_checks.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "concave_distance/base/error.h"
#include "ply_check.h"

namespace concave_distance::detail {
namespace {

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// A binary STL has 50 bytes per announced facet; an ASCII STL has no facet after its last "endsolid".
void checkStl(std::string_view content, const std::string& path, std::uint64_t most_triangles) {
  constexpr std::size_t kHeader = 84;
  if (content.size() >= kHeader) {
    const std::uint64_t facets = wholeNumber(content.substr(80, 4), true);
    if (content.size() == kHeader + 50 * facets) {
      if (facets <= most_triangles) return;
      throw Error(path,
                  "the file has " + std::to_string(facets) + " triangles, the limit is " +
                      std::to_string(most_triangles),
                  "simplify the mesh, or raise the limit (of the node: ~limits/largest_triangle_count)");
    }
  }
  constexpr std::size_t kTail = 4096;
  const std::string tail = lowerCase(content.substr(content.size() - std::min(content.size(), kTail)));
  const std::size_t end = tail.rfind("endsolid");
  if (end == std::string::npos || tail.find("facet normal", end) != std::string::npos) {
    throw Error(path,
                "the STL file breaks off: its " + std::to_string(content.size()) +
                    " bytes neither match a binary header nor end with 'endsolid'",
                kExportAgain);
  }
}

/// Assimp would reserve memory for a count that is larger than the file.
void checkDaeCount(std::string_view attributes, const std::string& tag, std::size_t file_size,
                   const std::string& path) {
  const std::size_t at = attributes.find("count=");
  if (at == std::string_view::npos)
    throw Error(path, "a <" + tag + "> does not state its count", kExportAgain);
  const std::string_view value = attributes.substr(std::min(at + 7, attributes.size()));
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), count);
  if (error != std::errc() || count > file_size) {
    throw Error(path,
                "a <" + tag + "> states a count of " +
                    std::string(value.substr(0, std::min<std::size_t>(value.find_first_of("\"'"), 40))) +
                    " in a file of " + std::to_string(file_size) + " bytes",
                kExportAgain);
  }
}

/// Assimp's COLLADA reader never returns from an index list that contains anything but numbers, and reads
/// numbers beyond 31 bits as 0.
void checkDaeIndices(std::string_view list, const std::string& tag, const std::string& path) {
  constexpr const char* kSpace = " \t\r\n";
  for (std::size_t at = list.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const std::size_t end = std::min(list.find_first_of(kSpace, at), list.size());
    std::int32_t index = 0;
    const auto [last, error] = std::from_chars(list.data() + at, list.data() + end, index);
    if (error != std::errc() || last != list.data() + end || index < 0) {
      throw Error(path,
                  "a <" + tag + "> contains '" +
                      std::string(list.substr(at, std::min<std::size_t>(end - at, 40))) +
                      "', which is not an index",
                  kExportAgain);
    }
    at = list.find_first_not_of(kSpace, end);
  }
}

/// It also reads out of bounds when an array does not state its length.
void checkDae(std::string_view content, const std::string& path) {
  const std::size_t first = content.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == std::string_view::npos || content[first] != '<') {
    throw Error(path, "a DAE file begins with '<', this one does not", kExportAgain);
  }
  for (std::size_t open = first; open != std::string_view::npos;) {
    if (content.compare(open, 4, "<!--") == 0) {
      const std::size_t end = content.find("-->", open);
      if (end == std::string_view::npos) return;  // malformed: assimp says so
      open = content.find('<', end);
      continue;
    }
    const std::size_t close = content.find_first_of("<>", open + 1);
    if (close == std::string_view::npos) return;
    const std::size_t next = content[close] == '<' ? close : content.find('<', close);
    const std::string_view inside = content.substr(open + 1, close - open - 1);
    // No relevant name is longer.
    const std::string tag(inside.substr(0, std::min<std::size_t>(inside.find_first_of(" \t\r\n/"), 16)));
    if (tag == "float_array" || tag == "accessor") {
      checkDaeCount(inside.substr(tag.size()), tag, content.size(), path);
    } else if (content[close] == '>' && (tag == "p" || tag == "vcount")) {
      checkDaeIndices(content.substr(close + 1, next - close - 1), tag, path);
    }
    open = next;
  }
}

}  // namespace

void checkMeshContent(std::string_view content, const std::string& path, const std::string& extension,
                      std::uint64_t most_triangles) {
  if (extension == ".stl") {
    checkStl(content, path, most_triangles);
  } else if (extension == ".ply") {
    checkPly(content, path);
  } else if (extension == ".dae") {
    checkDae(content, path);
  } else if (extension != ".obj") {
    throw Error(path, "the ending '" + extension + "' is not that of a mesh file",
                "give an STL, OBJ, PLY or DAE file");
  }
}

}  // namespace concave_distance::detail

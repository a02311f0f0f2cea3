#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace concave_distance::detail {

/// A type of number in a PLY file.
struct PlyType {
  std::size_t size = 0;  ///< bytes in a binary file
  bool is_whole = false;
  bool is_signed = false;
};

/// Names what a property says about the surface.
enum class PlyRole { None, X, Y, Z, Corners, Strip };

struct PlyProperty {
  std::string name;
  bool is_list = false;
  PlyType count;  ///< of a list's length
  PlyType value;
  PlyRole role = PlyRole::None;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  /// Bytes of a binary record whose lists are empty.
  std::size_t leastSize() const;
};

struct PlyHeader {
  bool is_text = false;
  bool little_endian = false;
  std::vector<PlyElement> elements;
  std::string_view body;        ///< what follows the header
  std::uint64_t body_line = 1;  ///< number of its first line
};

/// Reads a header and gives roles to the coordinates of the element vertex and to the lists of corners of the
/// elements face and tristrips; all else has none.
/// @throws Error naming the file and what is wrong or cannot be read: also another element with a list of
///         corners, because its faces would be lost, and more elements than the file has bytes
PlyHeader readPlyHeader(std::string_view content, const std::string& path);

}  // namespace concave_distance::detail

#include "ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include "concave_distance/base/error.h"
#include "text_words.h"

namespace concave_distance::detail {
namespace {

// Scanners write a few dozen.
constexpr std::size_t kMostProperties = 1000;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(path, "the PLY header " + what, kExportAgain);
}

PlyType typeOf(std::string_view name, const std::string& path) {
  using Names = std::array<std::string_view, 2>;
  static const std::array<std::pair<Names, PlyType>, 8> types{{{{"char", "int8"}, {1, true, true}},
                                                               {{"uchar", "uint8"}, {1, true, false}},
                                                               {{"short", "int16"}, {2, true, true}},
                                                               {{"ushort", "uint16"}, {2, true, false}},
                                                               {{"int", "int32"}, {4, true, true}},
                                                               {{"uint", "uint32"}, {4, true, false}},
                                                               {{"float", "float32"}, {4, false, true}},
                                                               {{"double", "float64"}, {8, false, true}}}};
  for (const auto& [names, type] : types) {
    if (name == names[0] || name == names[1]) return type;
  }
  refuse(path, "names the type " + inQuotes(name));
}

PlyProperty readProperty(TextWords& words, const std::string& path) {
  PlyProperty property;
  std::string_view type = words.wordInLine();
  property.is_list = type == "list";
  if (property.is_list) {
    const std::string_view count = words.wordInLine();
    property.count = typeOf(count, path);
    if (!property.count.is_whole) refuse(path, "counts a list in numbers of the type " + inQuotes(count));
    type = words.wordInLine();
  }
  property.value = typeOf(type, path);
  property.name = std::string(words.wordInLine());
  return property;
}

PlyElement readElement(TextWords& words, const std::string& path, std::size_t file_size) {
  PlyElement element;
  element.name = std::string(words.wordInLine());
  const std::string_view word = words.wordInLine();
  std::int64_t count = -1;
  if (!parseWhole(word, count) || count < 0) {
    refuse(path, "gives the element " + inQuotes(element.name) + " the count " + inQuotes(word));
  }
  element.count = static_cast<std::uint64_t>(count);
  // Every element takes a byte at least.
  if (element.count > file_size) {
    refuse(path, "announces " + std::to_string(count) + " elements " + inQuotes(element.name) +
                     " in a file of " + std::to_string(file_size) + " bytes");
  }
  return element;
}

void readFormat(TextWords& words, PlyHeader& header, const std::string& path) {
  const std::string_view format = words.wordInLine();
  header.is_text = format == "ascii";
  header.little_endian = format == "binary_little_endian";
  if (!header.is_text && !header.little_endian && format != "binary_big_endian") {
    refuse(path, "names the format " + inQuotes(format));
  }
}

/// Lines end as the first one does: after a lone \r a \n belongs to a binary body.
std::string_view bodyAfter(std::string_view rest, std::string_view content) {
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
  const std::size_t first_end = std::min(content.find_first_of("\r\n"), content.size());
  const bool is_pair = content.substr(first_end, 2) == "\r\n" && rest.substr(0, 2) == "\r\n";
  rest.remove_prefix(std::min<std::size_t>(is_pair ? 2 : 1, rest.size()));
  return rest;
}

PlyProperty* find(PlyElement& element, std::string_view name) {
  const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                  [&](const PlyProperty& property) { return property.name == name; });
  return found == element.properties.end() ? nullptr : &*found;
}

PlyProperty* findCorners(PlyElement& element) {
  PlyProperty* corners = find(element, "vertex_indices");
  if (corners == nullptr) corners = find(element, "vertex_index");
  return corners != nullptr && corners->is_list ? corners : nullptr;
}

void giveCoordinateRoles(PlyElement& element, const std::string& path) {
  for (const auto& [name, role] : {std::pair{"x", PlyRole::X}, {"y", PlyRole::Y}, {"z", PlyRole::Z}}) {
    PlyProperty* coordinate = find(element, name);
    if (coordinate == nullptr || coordinate->is_list) {
      refuse(path, "gives the element 'vertex' no number " + inQuotes(name));
    }
    coordinate->role = role;
  }
}

void giveRoles(PlyElement& element, const std::string& path) {
  if (element.count == 0) return;
  if (element.properties.empty())
    refuse(path, "gives the element " + inQuotes(element.name) + " no property");
  if (element.name == "vertex") return giveCoordinateRoles(element, path);
  PlyProperty* corners = findCorners(element);
  const bool is_face = element.name == "face";
  if (is_face || element.name == "tristrips") {
    if (corners == nullptr || !corners->value.is_whole) {
      refuse(path,
             "gives the element " + inQuotes(element.name) + " no list 'vertex_indices' of whole numbers");
    }
    corners->role = is_face ? PlyRole::Corners : PlyRole::Strip;
  } else if (corners != nullptr) {
    throw Error(path, "the PLY element " + inQuotes(element.name) + " has corners, but is not known",
                "export the mesh with elements 'face' or 'tristrips'");
  }
}

}  // namespace

std::size_t PlyElement::leastSize() const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties) {
    size += property.is_list ? property.count.size : property.value.size;
  }
  return size;
}

PlyHeader readPlyHeader(std::string_view content, const std::string& path) {
  TextWords words(content);
  if (words.word() != "ply")
    throw Error(path, "a PLY file begins with 'ply', this one does not", kExportAgain);
  PlyHeader header;
  bool has_format = false;
  std::size_t properties = 0;
  for (words.line(); !words.rest().empty(); words.line()) {
    const std::string_view word = words.wordInLine();
    if (word == "format") {
      readFormat(words, header, path);
      has_format = true;
    } else if (word == "element") {
      header.elements.push_back(readElement(words, path, content.size()));
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(readProperty(words, path));
    } else if (word == "end_header") {
      if (!has_format) refuse(path, "names no format");
      for (PlyElement& element : header.elements) giveRoles(element, path);
      header.body = bodyAfter(words.rest(), content);
      header.body_line = words.lineNumber() + 1;
      return header;
    } else if (!word.empty() && word != "comment" && word != "obj_info") {
      refuse(path, "has the word " + inQuotes(word) + " in line " + std::to_string(words.lineNumber()));
    }
    properties += word == "property" || word == "element" ? 1 : 0;
    if (properties > kMostProperties) {
      refuse(path, "has more than " + std::to_string(kMostProperties) + " properties");
    }
  }
  refuse(path, "has no end");
}

}  // namespace concave_distance::detail

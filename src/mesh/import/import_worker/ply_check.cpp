#include "ply_check.h"

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "concave_distance/base/error.h"
#include "mesh_content_checks.h"

namespace concave_distance::detail {
namespace {

constexpr const char* kSpace = " \t\r\n\v\f";
// Scanners write a few dozen; assimp compares all pairs.
constexpr std::size_t kMostProperties = 1000;

struct PlyProperty {
  std::size_t count_size = 0;  ///< bytes of a list's length; 0 for a single value
  std::size_t value_size = 0;
};

struct PlyElement {
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::string format;
  std::vector<PlyElement> elements;
};

enum class Kind { WholeNumber, Any };

/// Reads words and lines from the front of a text.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  /// Empty at the end of the text.
  std::string_view word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpace), rest_.size()));
    const std::string_view found = rest_.substr(0, rest_.find_first_of(kSpace));
    rest_.remove_prefix(found.size());
    return found;
  }

  std::string_view line() {
    const std::string_view found = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(found.size() + 1, rest_.size()));
    return found;
  }

  /// Empty when fewer are left.
  std::string_view bytes(std::size_t count) {
    if (count > rest_.size()) return {};
    const std::string_view found = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return found;
  }

  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

bool parseCount(std::string_view text, std::uint64_t& count) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  return error == std::errc() && end == text.data() + text.size();
}

/// @throws Error for a name that is not a type of PLY
std::size_t typeSize(std::string_view type, Kind kind, const std::string& path) {
  static const std::vector<std::pair<std::size_t, std::vector<std::string_view>>> whole{
      {1, {"char", "uchar", "int8", "uint8"}},
      {2, {"short", "ushort", "int16", "uint16"}},
      {4, {"int", "uint", "int32", "uint32"}}};
  static const std::vector<std::pair<std::size_t, std::vector<std::string_view>>> broken{
      {4, {"float", "float32"}}, {8, {"double", "float64"}}};
  for (const auto* table : {&whole, &broken}) {
    if (table == &broken && kind == Kind::WholeNumber) break;
    for (const auto& [size, names] : *table) {
      if (std::find(names.begin(), names.end(), type) != names.end()) return size;
    }
  }
  throw Error(path,
              "the PLY header names the type '" + std::string(type.substr(0, 40)) + "'" +
                  (kind == Kind::WholeNumber ? " for the length of a list" : ""),
              kExportAgain);
}

PlyProperty readProperty(Words words, const std::string& path) {
  PlyProperty property;
  std::string_view type = words.word();
  if (type == "list") {
    property.count_size = typeSize(words.word(), Kind::WholeNumber, path);
    type = words.word();
  }
  property.value_size = typeSize(type, Kind::Any, path);
  return property;
}

PlyElement readElement(Words words, const std::string& path) {
  PlyElement element;
  words.word();  // its name
  const std::string_view count = words.word();
  if (!parseCount(count, element.count)) {
    throw Error(path, "a PLY element has the count '" + std::string(count.substr(0, 40)) + "'", kExportAgain);
  }
  return element;
}

/// Afterwards `file` begins after the header.
PlyHeader readHeader(Words& file, const std::string& path) {
  PlyHeader header;
  std::size_t properties = 0;
  while (!file.rest().empty()) {
    Words words(file.line());
    const std::string_view word = words.word();
    if (word == "format") {
      header.format = std::string(words.word());
    } else if (word == "element") {
      header.elements.push_back(readElement(words, path));
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(readProperty(words, path));
    } else if (word == "end_header") {
      return header;
    }
    properties += word == "property" || word == "element" ? 1 : 0;
    if (properties > kMostProperties) {
      throw Error(path, "the PLY header has more than " + std::to_string(kMostProperties) + " properties",
                  kExportAgain);
    }
  }
  return {};
}

/// Skips the values of a PLY body; false when they run out.
class Body {
 public:
  Body(Words file, const std::string& format)
      : file_(file), is_text_(format == "ascii"), little_endian_(format == "binary_little_endian") {}

  bool skip(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        std::uint64_t count = 1;
        if (property.count_size != 0 && !readCount(property.count_size, count)) return false;
        if (!skipValues(property.value_size, count)) return false;
      }
    }
    return true;
  }

 private:
  bool skipValues(std::size_t size, std::uint64_t count) {
    // So no product overflows.
    if (count > file_.rest().size()) return false;
    if (!is_text_) return count == 0 || !file_.bytes(count * size).empty();
    for (std::uint64_t i = 0; i < count; ++i) {
      if (file_.word().empty()) return false;
    }
    return true;
  }

  bool readCount(std::size_t size, std::uint64_t& count) {
    if (is_text_) return parseCount(file_.word(), count);
    const std::string_view bytes = file_.bytes(size);
    count = wholeNumber(bytes, little_endian_);
    return !bytes.empty();
  }

  Words file_;
  bool is_text_;
  bool little_endian_;
};

}  // namespace

std::uint64_t wholeNumber(std::string_view bytes, bool little_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    value = (value << 8U) | static_cast<unsigned char>(bytes[little_endian ? bytes.size() - 1 - i : i]);
  }
  return value;
}

void checkPly(std::string_view content, const std::string& path) {
  Words file(content);
  const PlyHeader header = readHeader(file, path);
  if (header.elements.empty()) {
    throw Error(path, "the PLY header has no element or no end", kExportAgain);
  }
  Body body(file, header.format);
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty() && element.count > 0) {
      throw Error(path, "the PLY header announces elements without properties", kExportAgain);
    }
    if (!body.skip(element)) {
      throw Error(path, "the PLY file breaks off before the last element of its header", kExportAgain);
    }
  }
}

}  // namespace concave_distance::detail

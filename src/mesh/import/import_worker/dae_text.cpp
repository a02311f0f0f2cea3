#include "dae_text.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <pugixml.hpp>
#include <utility>
#include <vector>

#include "concave_distance/base/error.h"
#include "text_words.h"

namespace concave_distance::detail {
namespace {

class TextWriter : public pugi::xml_writer {
 public:
  void write(const void* data, std::size_t size) override {
    text.append(static_cast<const char*>(data), size);
  }
  std::string text;
};

/// Visits every node of a document without recursion, however deep it is.
class DaeChecks : public pugi::xml_tree_walker {
 public:
  DaeChecks(std::size_t file_size, const std::string& path) : file_size_(file_size), path_(path) {}

  bool for_each(pugi::xml_node& node) override {
    if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) {
      checkText(node);
    } else if (node.type() == pugi::node_element) {
      checkElement(node);
    }
    return true;
  }

  /// Limits what accessors state to the arrays that they read, beyond whose end assimp would read on; it
  /// refuses indices beyond the count. Comes last, because arrays may follow.
  void limitAccessors() {
    for (Accessor& accessor : accessors_) {
      const auto array = array_sizes_.find(accessor.array);
      if (array == array_sizes_.end()) continue;
      const std::int64_t rest = array->second - accessor.offset - accessor.width;
      const std::int64_t most = rest < 0 ? 0 : rest / std::max<std::int64_t>(accessor.stride, 1) + 1;
      if (accessor.count > most) accessor.node.attribute("count").set_value(std::to_string(most).c_str());
    }
  }

 private:
  struct Accessor {
    pugi::xml_node node;
    std::string array;
    std::int64_t count;
    std::int64_t offset;
    std::int64_t stride;
    std::int64_t width;  ///< of one value, in numbers
  };

  void checkElement(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    if (name == "float_array") {
      array_sizes_[node.attribute("id").value()] = number(node, "count");
    } else if (name == "accessor") {
      addAccessor(node);
    } else if (name == "triangles" || name == "polylist") {
      checkListCount(node, number(node, "count"));
    } else if (name == "polygons" || name == "tristrips" || name == "trifans") {
      checkListCount(node, number(node, "count"));
      checkNumberOfLists(node, number(node, "count"));
    } else if (name == "ph") {
      throw Error(path_, "a polygon has holes (<ph>)",
                  "cut its faces into triangles in the program that made the mesh, and export it again");
    } else if (name == "convex_mesh" || name == "brep") {
      throw Error(path_, "a geometry is a <" + std::string(name) + ">, which cannot be read",
                  "export it as a mesh");
    }
  }

  void addAccessor(const pugi::xml_node& node) {
    const std::string_view source = node.attribute("source").value();
    const std::int64_t stride = number(node, "stride", 1);
    accessors_.push_back({node, std::string(source.substr(source.substr(0, 1) == "#" ? 1 : 0)),
                          number(node, "count"), number(node, "offset", 0), stride,
                          std::max(stride, childCount(node, "param"))});
  }

  static std::int64_t childCount(const pugi::xml_node& node, const char* name) {
    return std::distance(node.children(name).begin(), node.children(name).end());
  }

  /// An attribute that counts something in the file. Assimp reserves what it states.
  std::int64_t number(const pugi::xml_node& node, const char* name, std::int64_t usual = -1) const {
    const pugi::xml_attribute attribute = node.attribute(name);
    const std::string tag = "a <" + std::string(node.name()) + ">";
    if (!attribute && usual >= 0) return usual;
    if (!attribute) throw Error(path_, tag + " does not state its " + name, kExportAgain);
    TextWords words(attribute.value());
    const std::string_view word = words.word();
    std::int64_t value = -1;
    if (!parseWhole(word, value) || value < 0 || static_cast<std::uint64_t>(value) > file_size_) {
      throw Error(path_,
                  tag + " states a " + name + " of " + inQuotes(word) + " in a file of " +
                      std::to_string(file_size_) + " bytes",
                  kExportAgain);
    }
    return value;
  }

  /// Assimp passes over the faces of an element without any.
  void checkListCount(const pugi::xml_node& node, std::int64_t count) const {
    if (count > 0 || isPadding(node.child("p").text().get())) return;
    throw Error(path_, "a <" + std::string(node.name()) + "> states a count of 0, but has a <p>",
                kExportAgain);
  }

  void checkNumberOfLists(const pugi::xml_node& node, std::int64_t count) const {
    const std::int64_t lists = childCount(node, "p") + childCount(node, "ph");
    if (lists == count) return;
    throw Error(path_,
                "a <" + std::string(node.name()) + "> states a count of " + std::to_string(count) +
                    ", but has " + std::to_string(lists) + " <p>",
                kExportAgain);
  }

  void checkText(pugi::xml_node& text) const {
    const std::string_view element = text.parent().name();
    if (element == "p" || element == "vcount") checkIndices(text.value(), element);
    const std::string_view value = text.value();
    const std::size_t first = value.find_first_not_of(" \t\r\n");
    if (first != 0 && first != std::string_view::npos && text == text.parent().first_child()) {
      text.set_value(std::string(value.substr(first)).c_str());
    }
  }

  /// Assimp never returns from a list of indices that contains anything else, and reads numbers beyond 31
  /// bits as 0.
  void checkIndices(std::string_view list, std::string_view element) const {
    TextWords words(list);
    for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
      std::int64_t index = -1;
      if (parseWhole(word, index) && index >= 0 && index <= std::numeric_limits<std::int32_t>::max())
        continue;
      throw Error(path_,
                  "a <" + std::string(element) + "> contains " + inQuotes(word) + ", which is not an index",
                  kExportAgain);
    }
  }

  std::size_t file_size_;
  const std::string& path_;
  std::map<std::string, std::int64_t> array_sizes_;
  std::vector<Accessor> accessors_;
};

}  // namespace

std::string plainDae(std::string_view content, const std::string& path) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(content.data(), content.size());
  if (!result) {
    throw Error(path,
                std::string("the DAE file is no complete XML: ") + result.description() + " at byte " +
                    std::to_string(result.offset),
                kExportAgain);
  }
  DaeChecks checks(content.size(), path);
  document.traverse(checks);
  checks.limitAccessors();
  TextWriter writer;
  document.save(writer, "", pugi::format_raw, pugi::encoding_utf8);
  return std::move(writer.text);
}

}  // namespace concave_distance::detail

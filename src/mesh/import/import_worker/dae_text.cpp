#include "dae_text.h"

#include <cstdint>
#include <limits>
#include <pugixml.hpp>

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
      const std::string_view name = node.name();
      if (name == "float_array" || name == "accessor") checkCount(node);
      if (name == "ph") {
        throw Error(path_, "a polygon has holes (<ph>)",
                    "cut its faces into triangles in the program that made the mesh, and export it again");
      }
    }
    return true;
  }

 private:
  /// Assimp reads out of bounds when an array does not state its length, and reserves what it states.
  void checkCount(const pugi::xml_node& node) const {
    const pugi::xml_attribute attribute = node.attribute("count");
    const std::string tag = "a <" + std::string(node.name()) + ">";
    if (!attribute) throw Error(path_, tag + " does not state its count", kExportAgain);
    TextWords words(attribute.value());
    const std::string_view word = words.word();
    std::int64_t count = -1;
    if (!parseWhole(word, count) || count < 0 || static_cast<std::uint64_t>(count) > file_size_) {
      throw Error(path_,
                  tag + " states a count of " + quoted(word) + " in a file of " + std::to_string(file_size_) +
                      " bytes",
                  kExportAgain);
    }
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
                  "a <" + std::string(element) + "> contains " + quoted(word) + ", which is not an index",
                  kExportAgain);
    }
  }

  std::size_t file_size_;
  const std::string& path_;
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
  TextWriter writer;
  document.save(writer, "", pugi::format_raw, pugi::encoding_utf8);
  return std::move(writer.text);
}

}  // namespace concave_distance::detail

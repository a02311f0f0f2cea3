#include "mesh_readers.h"

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/number_text.h"
#include "binary_numbers.h"
#include "concave_distance/base/error.h"
#include "file_mesh.h"
#include "text_words.h"

namespace concave_distance::detail {
namespace {

constexpr std::size_t kHeader = 84;  ///< bytes: 80 of text, 4 of a count
constexpr std::size_t kFacet = 50;   ///< bytes: a normal, three corners, 2 more

class TextReader {
 public:
  TextReader(std::string_view text, const std::string& path) : words_(text), path_(path), mesh_({"line"}) {}

  /// Reads as far as the first facet or end of a solid; false when there is none.
  static bool isText(std::string_view content) {
    TextWords words(content);
    if (!equalsInAnyCase(words.word(), "solid")) return false;
    if (hasFacet(words.line())) return true;
    const std::string_view first = words.word();
    for (const char* word : {"facet", "endsolid", "end", "color"}) {
      if (equalsInAnyCase(first, word)) return true;
    }
    return false;
  }

  TriangleSoup read(std::uint64_t most_triangles) {
    while (readSolid()) {
    }
    return mesh_.takeTriangles(path_, most_triangles);
  }

 private:
  /// A solid's name may contain the word facet.
  static bool hasFacet(std::string_view line) {
    TextWords words(line);
    for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
      if (equalsInAnyCase(word, "facet") && equalsInAnyCase(words.word(), "normal")) return true;
    }
    return false;
  }

  [[noreturn]] void refuse(std::string_view word, const std::string& expected) const {
    const std::string line = "line " + std::to_string(words_.lineNumber());
    if (word.empty()) {
      throw Error(path_, "the STL file breaks off in " + line + ", where " + expected + " is missing",
                  kExportAgain);
    }
    throw Error(path_, line + " has " + inQuotes(word) + " instead of " + expected, kExportAgain);
  }

  void expect(const char* wanted) {
    const std::string_view word = words_.word();
    if (!equalsInAnyCase(word, wanted)) refuse(word, "'" + std::string(wanted) + "'");
  }

  /// Reads "endloop", also as two words.
  void expectEnd(std::string_view word, const std::string& of) {
    if (equalsInAnyCase(word, "end")) return expect(of.c_str());
    if (!equalsInAnyCase(word, "end" + of)) refuse(word, "'end" + of + "'");
  }

  double number() {
    const std::string_view word = words_.word();
    const std::optional<double> value = parseNumber(word);
    if (!value) refuse(word, "a number");
    return *value;
  }

  /// Passes over the rest of the line, which is a name, but not over facets that follow in the same line.
  void passName(const char* next) {
    if (!hasFacet(TextWords(words_).line())) {
      words_.line();
      return;
    }
    TextWords ahead = words_;
    for (std::string_view word = ahead.word(); !word.empty() && !equalsInAnyCase(word, next);
         word = ahead.word()) {
      words_ = ahead;
    }
  }

  /// False after the last one.
  bool readSolid() {
    const TextWords before = words_;
    if (!equalsInAnyCase(words_.word(), "solid")) {
      checkTail(before);
      return false;
    }
    passName("facet");
    for (;;) {
      const std::string_view word = words_.word();
      if (equalsInAnyCase(word, "facet")) {
        readFacet();
      } else if (equalsInAnyCase(word, "color")) {
        words_.line();
      } else {
        expectEnd(word, "solid");
        passName("solid");
        return true;
      }
    }
  }

  void readFacet() {
    const std::uint64_t line = words_.lineNumber();
    expect("normal");
    // The corners decide; writers of empty facets give no numbers.
    for (int k = 0; k < 3; ++k) words_.word();
    expect("outer");
    expect("loop");
    corners_.clear();
    std::string_view word = words_.word();
    for (; equalsInAnyCase(word, "vertex"); word = words_.word()) {
      corners_.push_back(static_cast<std::int64_t>(mesh_.vertices().size()));
      const double x = number();
      const double y = number();
      mesh_.vertices().emplace_back(x, y, number());
    }
    expectEnd(word, "loop");
    if (corners_.size() < 3) {
      throw Error(path_,
                  "the facet in line " + std::to_string(line) + " has " + std::to_string(corners_.size()) +
                      " corners",
                  kExportAgain);
    }
    expectEnd(words_.word(), "facet");
    mesh_.addFace(corners_, line);
  }

  /// After the last solid anything may follow that no reader could take for a part of the body.
  void checkTail(TextWords tail) const {
    for (std::string_view word = tail.word(); !word.empty(); word = tail.word()) {
      if (!equalsInAnyCase(word, "facet")) continue;
      throw Error(
          path_, "line " + std::to_string(tail.lineNumber()) + " has a facet after the end of the last solid",
          kExportAgain);
    }
  }

  TextWords words_;
  const std::string& path_;
  FileMesh mesh_;
  std::vector<std::int64_t> corners_;
};

TriangleSoup readBinaryStl(std::string_view content, std::uint64_t facets) {
  TriangleSoup soup;
  soup.vertices.reserve(3 * facets);
  soup.triangles.reserve(facets);
  for (std::uint64_t f = 0; f < facets; ++f) {
    const std::string_view facet = content.substr(kHeader + kFacet * f, kFacet);
    const auto first = static_cast<std::uint32_t>(3 * f);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto coordinate = [&](std::size_t axis) {
        return brokenNumber(facet.substr(12 * (k + 1) + 4 * axis, 4), true);
      };
      soup.vertices.emplace_back(coordinate(0), coordinate(1), coordinate(2));
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

/// @return the number of facets
std::uint64_t checkBinaryStl(std::string_view content, const std::string& path,
                             std::uint64_t most_triangles) {
  const std::string size = std::to_string(content.size()) + " bytes";
  if (content.size() < kHeader) {
    throw Error(path, "the STL file breaks off: " + size + " are less than a header", kExportAgain);
  }
  const std::uint64_t facets = wholeNumber(content.substr(80, 4), true);
  const std::uint64_t wanted = kHeader + kFacet * facets;
  const std::string announced = "its header announces " + std::to_string(facets) + " triangles";
  if (wanted > content.size()) {
    throw Error(path,
                "the STL file breaks off or is neither binary nor text: " + announced + ", it has " + size,
                kExportAgain);
  }
  if (content.size() >= wanted + kFacet && !isPadding(content.substr(wanted))) {
    throw Error(path,
                "the STL file has more than it announces: " + announced + ", which take " +
                    std::to_string(wanted) + " of its " + size,
                kExportAgain);
  }
  checkTriangleCount(facets, most_triangles, path);
  return facets;
}

}  // namespace

TriangleSoup readStl(std::string_view content, const std::string& path, std::uint64_t most_triangles) {
  // Some writers begin the header of a binary file with "solid": its size decides first.
  const bool has_binary_size = content.size() >= kHeader &&
                               content.size() == kHeader + kFacet * wholeNumber(content.substr(80, 4), true);
  const std::string_view text = withoutByteOrderMark(content);
  if (!has_binary_size && TextReader::isText(text)) return TextReader(text, path).read(most_triangles);
  TriangleSoup soup = readBinaryStl(content, checkBinaryStl(content, path, most_triangles));
  checkVertices(soup.vertices, {}, path);
  checkSinglePrecision({boxOf(soup.vertices)}, path);
  return soup;
}

}  // namespace concave_distance::detail

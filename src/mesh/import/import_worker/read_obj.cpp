#include "mesh_readers.h"

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "file_mesh.h"
#include "text_words.h"

namespace concave_distance::detail {
namespace {

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& path)
      : words_(text), path_(path), mesh_({"line", "", 1}) {}

  TriangleSoup read(std::uint64_t most_triangles) {
    for (; !words_.rest().empty(); endStatement()) readStatement();
    return mesh_.takeTriangles(path_, most_triangles);
  }

 private:
  void readStatement() {
    line_ = words_.lineNumber();
    has_ended_ = false;
    const std::string_view statement = nextWord();
    if (statement == "v") {
      readVertex();
    } else if (statement == "f" || statement == "fo") {
      readFace();
    } else if (statement == "surf" || statement == "bsp" || statement == "bzp" || statement == "cdc" ||
               statement == "cdp" || statement == "res") {
      throw Error(
          path_, "line " + std::to_string(line_) + " is a surface of free form (" + inQuotes(statement) + ")",
          "export the mesh with its surfaces as polygons");
    }
  }

  /// The next word of the statement, which a backslash at the end of a line continues on the next one. Empty
  /// at its end or before a comment.
  std::string_view nextWord() {
    while (!has_ended_) {
      std::string_view word = words_.wordInLine();
      has_ended_ = word.empty() || word.front() == '#';
      if (has_ended_) break;
      if (word.back() != '\\' || !endsLine()) return word;
      words_.line();
      word.remove_suffix(1);
      if (!word.empty()) return word;
    }
    return {};
  }

  bool endsLine() const { return TextWords(words_).wordInLine().empty(); }

  void endStatement() {
    while (!nextWord().empty()) {
    }
    words_.line();
  }

  [[noreturn]] void refuse(std::string_view word, const std::string& expected) const {
    throw Error(path_,
                "line " + std::to_string(line_) + " has " + (word.empty() ? "an end" : inQuotes(word)) +
                    " instead of " + expected,
                kExportAgain);
  }

  double number(std::string_view word) const {
    const std::optional<double> value = parseNumber(word);
    if (!value) refuse(word, "a number");
    return *value;
  }

  void readVertex() {
    Eigen::Vector3d place;
    for (Eigen::Index axis = 0; axis < 3; ++axis) place[axis] = number(nextWord());
    const std::string_view fourth = nextWord();
    // More than four numbers: a colour follows.
    if (!fourth.empty() && nextWord().empty()) {
      const double weight = number(fourth);
      if (weight == 0.0) refuse(fourth, "a weight other than 0");
      place /= weight;
    }
    mesh_.vertices().push_back(place);
  }

  void readFace() {
    corners_.clear();
    for (std::string_view word = nextWord(); !word.empty(); word = nextWord()) {
      // A corner is the number of a vertex, perhaps with those of a texture coordinate and a normal: 1/2/3.
      std::int64_t vertex = 0;
      if (!parseWhole(word.substr(0, word.find('/')), vertex) || vertex == 0) refuse(word, "a vertex");
      const auto count = static_cast<std::int64_t>(mesh_.vertices().size());
      if (vertex < -count) refuse(word, "one of the " + std::to_string(count) + " vertices before it");
      corners_.push_back(vertex > 0 ? vertex - 1 : count + vertex);
    }
    mesh_.addFace(corners_, line_);
  }

  TextWords words_;
  const std::string& path_;
  FileMesh mesh_;
  std::vector<std::int64_t> corners_;
  std::uint64_t line_ = 1;  ///< of the statement's beginning
  bool has_ended_ = false;
};

}  // namespace

TriangleSoup readObj(std::string_view content, const std::string& path, std::uint64_t most_triangles) {
  return ObjReader(withoutByteOrderMark(content), path).read(most_triangles);
}

}  // namespace concave_distance::detail

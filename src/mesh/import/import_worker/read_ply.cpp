#include "mesh_readers.h"

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "base/number_text.h"
#include "binary_numbers.h"
#include "concave_distance/base/error.h"
#include "file_mesh.h"
#include "ply_header.h"
#include "text_words.h"

namespace concave_distance::detail {
namespace {

/// The numbers of a PLY body, one after the other.
class PlyNumbers {
 public:
  PlyNumbers(const PlyHeader& header, const std::string& path)
      : header_(header), path_(path), words_(header.body), bytes_(header.body) {}

  void begin(const PlyElement& element, std::uint64_t index) {
    element_ = &element;
    index_ = index;
  }

  double number(const PlyType& type) {
    if (!header_.is_text) {
      const std::string_view bytes = take(type.size);
      return type.is_whole ? static_cast<double>(wholeOf(bytes, type))
                           : brokenNumber(bytes, header_.little_endian);
    }
    const std::string_view word = nextWord();
    const std::optional<double> value = parseNumber(word);
    if (!value) refuseWord(word, "a number");
    return *value;
  }

  std::int64_t whole(const PlyType& type) {
    if (!header_.is_text) return wholeOf(take(type.size), type);
    const std::string_view word = nextWord();
    std::int64_t value = 0;
    if (!parseWhole(word, value)) refuseWord(word, "a whole number");
    return value;
  }

  std::size_t listSize(const PlyProperty& property) {
    const std::int64_t count = whole(property.count);
    if (count < 0) refuse("has a list of length " + std::to_string(count));
    return static_cast<std::size_t>(count);
  }

  void pass(const PlyType& type, std::size_t count) {
    if (!header_.is_text) {
      if (count > bytes_.size()) refuseEnd();  // so that no product overflows
      take(count * type.size);
      return;
    }
    for (std::size_t i = 0; i < count; ++i) nextWord();
  }

  /// In a text every element has lines of its own.
  void endRecord() {
    if (!header_.is_text) return;
    const std::string_view word = words_.wordInLine();
    if (!word.empty()) refuse("is followed by " + inQuotes(word) + " in line " + line());
  }

  void endBody() const {
    if (header_.is_text) {
      TextWords rest = words_;
      if (!isPadding(rest.word())) {
        throw Error(path_, "the PLY file has more elements than its header announces", kExportAgain);
      }
    } else if (element_ != nullptr && bytes_.size() >= element_->leastSize() && !isPadding(bytes_)) {
      throw Error(path_,
                  "the PLY file has " + std::to_string(bytes_.size()) +
                      " bytes after the last element that its header announces",
                  kExportAgain);
    }
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(path_,
                "the PLY element " + inQuotes(element_->name) + " " + std::to_string(index_) + " " + what,
                kExportAgain);
  }

 private:
  [[noreturn]] void refuseEnd() const {
    throw Error(path_,
                "the PLY file breaks off in " + inQuotes(element_->name) + " " + std::to_string(index_) +
                    " of " + std::to_string(element_->count),
                kExportAgain);
  }

  [[noreturn]] void refuseWord(std::string_view word, const std::string& expected) const {
    refuse("has " + inQuotes(word) + " instead of " + expected + " in line " + line());
  }

  std::string line() const { return std::to_string(header_.body_line + words_.lineNumber() - 1); }

  std::string_view nextWord() {
    const std::string_view word = words_.word();
    if (word.empty()) refuseEnd();
    return word;
  }

  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) refuseEnd();
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }

  std::int64_t wholeOf(std::string_view bytes, const PlyType& type) const {
    const std::uint64_t value = wholeNumber(bytes, header_.little_endian);
    const std::uint64_t half = std::uint64_t{1} << (8 * type.size - 1);
    return static_cast<std::int64_t>(value) -
           (type.is_signed && value >= half ? static_cast<std::int64_t>(2 * half) : 0);
  }

  const PlyHeader& header_;
  const std::string& path_;
  TextWords words_;
  std::string_view bytes_;
  const PlyElement* element_ = nullptr;
  std::uint64_t index_ = 0;
};

class PlyReader {
 public:
  PlyReader(const PlyHeader& header, const std::string& path)
      : header_(header), numbers_(header, path), mesh_({"face"}) {}

  TriangleSoup read(const std::string& path, std::uint64_t most_triangles) {
    for (const PlyElement& element : header_.elements) {
      for (std::uint64_t i = 0; i < element.count; ++i) readRecord(element, i);
    }
    numbers_.endBody();
    if (has_single_precision_) checkSinglePrecision({boxOf(mesh_.vertices())}, path);
    return mesh_.takeTriangles(path, most_triangles);
  }

 private:
  void readRecord(const PlyElement& element, std::uint64_t index) {
    numbers_.begin(element, index);
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (const PlyProperty& property : element.properties) {
      switch (property.role) {
        case PlyRole::X:
          has_single_precision_ = !header_.is_text && property.value.size == 4;
          place.x() = numbers_.number(property.value);
          break;
        case PlyRole::Y:
          place.y() = numbers_.number(property.value);
          break;
        case PlyRole::Z:
          place.z() = numbers_.number(property.value);
          break;
        case PlyRole::Corners:
          readCorners(property);
          mesh_.addFace(corners_, index);
          break;
        case PlyRole::Strip:
          readCorners(property);
          addStrips(index);
          break;
        case PlyRole::None:
          numbers_.pass(property.value, property.is_list ? numbers_.listSize(property) : 1);
          break;
      }
    }
    numbers_.endRecord();
    if (element.name == "vertex") mesh_.vertices().push_back(place);
  }

  void readCorners(const PlyProperty& property) {
    const std::size_t count = numbers_.listSize(property);
    corners_.clear();
    for (std::size_t i = 0; i < count; ++i) corners_.push_back(numbers_.whole(property.value));
  }

  /// Each corner after the second makes a triangle with the two before, of which every other one is turned;
  /// -1, also as the largest number without a sign, begins a new strip.
  void addStrips(std::uint64_t number) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] == -1 || corners_[i] == std::numeric_limits<std::uint32_t>::max()) {
        begin = i + 1;
      } else if (i >= begin + 2) {
        const bool is_turned = (i - begin) % 2 == 1;
        triangle_ = {corners_[i - (is_turned ? 1 : 2)], corners_[i - (is_turned ? 2 : 1)], corners_[i]};
        // Repeated corners lead from one part of a strip to another.
        if (triangle_[0] == triangle_[1] || triangle_[1] == triangle_[2] || triangle_[2] == triangle_[0])
          continue;
        mesh_.addFace(triangle_, number);
      }
    }
  }

  const PlyHeader& header_;
  PlyNumbers numbers_;
  FileMesh mesh_;
  std::vector<std::int64_t> corners_;
  std::vector<std::int64_t> triangle_;
  bool has_single_precision_ = false;
};

}  // namespace

TriangleSoup readPly(std::string_view content, const std::string& path, std::uint64_t most_triangles) {
  const PlyHeader header = readPlyHeader(content, path);
  return PlyReader(header, path).read(path, most_triangles);
}

}  // namespace concave_distance::detail

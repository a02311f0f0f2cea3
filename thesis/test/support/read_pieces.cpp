#include "thesis/test/support/read_pieces.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "concave_distance/base/error.h"

namespace concave_distance::test {
namespace {

/// A piece while its lines are read. OBJ counts corners and normals from 1 through the whole file.
struct OpenPiece {
  std::string where;
  std::size_t first_vertex;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<std::uint32_t>> facets;
  std::vector<Eigen::Vector3d> outward;
};

class PieceReader {
 public:
  explicit PieceReader(const std::string& path) : path_(path) {}

  void readLine(const std::string& line) {
    ++line_;
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "o") {
      close();
      std::string name;
      words >> name;
      open_ = OpenPiece{path_ + ", piece " + name, vertex_count_, {}, {}, {}};
    } else if (key == "v") {
      piece().vertices.push_back(readVector(words));
      ++vertex_count_;
    } else if (key == "vn") {
      normals_.push_back(readVector(words));
    } else if (key == "f") {
      readFacet(words);
    }
  }

  std::vector<ConvexPiece> finish() {
    close();
    if (pieces_.empty()) throw Error(path_, "there is no piece in the file", "each begins with an `o` line");
    return std::move(pieces_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw Error(path_ + ", line " + std::to_string(line_), what, remedy);
  }

  OpenPiece& piece() {
    if (!open_) fail("a corner or facet outside of any piece", "begin each piece with an `o` line");
    return *open_;
  }

  Eigen::Vector3d readVector(std::istringstream& words) const {
    Eigen::Vector3d v;
    if (!(words >> v.x() >> v.y() >> v.z())) fail("three numbers are expected", "write x y z");
    return v;
  }

  void readFacet(std::istringstream& words) {
    OpenPiece& open = piece();
    std::vector<std::uint32_t> facet;
    std::size_t normal = 0;
    for (std::string corner; words >> corner;) {
      std::size_t vertex = 0;
      char slash = ' ';
      std::istringstream numbers(corner);
      numbers >> vertex;
      if (numbers >> slash >> slash) numbers >> normal;
      if (vertex <= open.first_vertex || vertex > open.first_vertex + open.vertices.size()) {
        fail("'" + corner + "' is not a corner of this piece", "list a piece's corners after its `o` line");
      }
      facet.push_back(static_cast<std::uint32_t>(vertex - open.first_vertex - 1));
    }
    open.facets.push_back(std::move(facet));
    if (normal == 0) return;
    if (normal > normals_.size() || normals_[normal - 1].norm() == 0.0) {
      fail("normal " + std::to_string(normal) + " does not exist or is zero", "write its `vn` line before");
    }
    open.outward.push_back(normals_[normal - 1]);
  }

  void close() {
    if (!open_) return;
    pieces_.push_back(
        open_->outward.empty()
            ? makeConvexPiece(std::move(open_->vertices), std::move(open_->facets), open_->where)
            : makeConvexPiece(std::move(open_->vertices), std::move(open_->facets), open_->outward,
                              open_->where));
    open_.reset();
  }

  std::string path_;
  std::size_t line_ = 0;
  std::size_t vertex_count_ = 0;
  std::vector<Eigen::Vector3d> normals_;
  std::optional<OpenPiece> open_;
  std::vector<ConvexPiece> pieces_;
};

}  // namespace

ConvexPartition readPieces(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(path, "the file cannot be read", "give pieces as mesh_tool partition writes them");
  PieceReader reader(path);
  for (std::string line; std::getline(file, line);) reader.readLine(line);
  ConvexPartition partition;
  partition.name = std::filesystem::path(path).stem().string();
  partition.pieces = reader.finish();
  return partition;
}

}  // namespace concave_distance::test

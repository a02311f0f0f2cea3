#include "constraint_tree_file.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <istream>
#include <limits>
#include <map>
#include <ostream>

#include "base/output_file.h"
#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

using ObjectId = std::vector<std::uint32_t>;

std::string place(const YAML::Node& node, const std::string& where) {
  return where + ":" + std::to_string(node.Mark().line + 1);
}

YAML::Node required(const YAML::Node& map, const std::string& key, const std::string& where) {
  if (!map.IsMap() || !map[key]) {
    throw Error(place(map, where), "the key '" + key + "' is missing",
                "see constraint_tree_file.h for the form");
  }
  return map[key];
}

template <typename Value>
Value valueOf(const YAML::Node& node, const std::string& what, const std::string& where) {
  try {
    return node.as<Value>();
  } catch (const YAML::Exception&) {
    throw Error(place(node, where), what + " cannot be read", "see constraint_tree_file.h for the form");
  }
}

Eigen::Vector3d pointOf(const std::vector<double>& numbers, const YAML::Node& node,
                        const std::string& where) {
  if (numbers.size() != 3) {
    throw Error(place(node, where), "a point has " + std::to_string(numbers.size()) + " numbers",
                "give three");
  }
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::AlignedBox3d boxOf(const YAML::Node& node, const std::string& where) {
  const auto corners = valueOf<std::vector<std::vector<double>>>(node, "bounding_box", where);
  if (corners.size() != 2) {
    throw Error(place(node, where), "bounding_box has " + std::to_string(corners.size()) + " corners",
                "give the lowest and the highest");
  }
  return {pointOf(corners[0], node, where), pointOf(corners[1], node, where)};
}

std::vector<LinearConstraint> constraintsOf(const YAML::Node& node, const std::string& where) {
  std::vector<LinearConstraint> constraints;
  for (const YAML::Node& row : node) {
    const auto numbers = valueOf<std::vector<double>>(row, "a constraint", where);
    if (numbers.size() != 4) {
      throw Error(place(row, where), "a constraint has " + std::to_string(numbers.size()) + " numbers",
                  "give a_x, a_y, a_z, b");
    }
    constraints.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
  }
  return constraints;
}

/// A piece as the file has it, before it is put below its parent.
struct FilePiece {
  ObjectId id;
  std::vector<LinearConstraint> constraints;
  std::vector<std::size_t> children;
};

PieceDescription assembled(const std::vector<FilePiece>& pieces, std::size_t piece) {
  PieceDescription description{pieces[piece].constraints, {}};
  for (const std::size_t child : pieces[piece].children) {
    description.children.push_back(assembled(pieces, child));
  }
  return description;
}

int levelAtDepth(std::size_t depth) {
  const int level = static_cast<int>(depth);
  return level % 2 == 1 ? level : -level;
}

std::vector<FilePiece> piecesOf(const YAML::Node& list, const std::string& where) {
  std::vector<FilePiece> pieces;
  std::map<ObjectId, std::size_t> number;
  for (const YAML::Node& node : list) {
    FilePiece piece;
    piece.id = valueOf<ObjectId>(required(node, "object_id", where), "object_id", where);
    piece.constraints = constraintsOf(required(node, "constraints", where), where);
    const int level = valueOf<int>(required(node, "level", where), "level", where);
    if (piece.id.empty() || level != levelAtDepth(piece.id.size())) {
      throw Error(place(node, where), "level " + std::to_string(level) + " is not that of the object_id",
                  "levels are 1, -2, 3, -4 ... with the length of the object_id");
    }
    const ObjectId parent(piece.id.begin(), piece.id.end() - 1);
    const auto above = number.find(parent);
    const bool is_root = pieces.empty() && piece.id == ObjectId{1};
    if (!is_root && (above == number.end() || piece.id.back() != pieces[above->second].children.size() + 1)) {
      throw Error(place(node, where), "a piece comes before its parent or out of its parent's order",
                  "list the root [1] first, and children in order");
    }
    if (!is_root) {
      pieces[above->second].children.push_back(pieces.size());
    }
    number.emplace(piece.id, pieces.size());
    pieces.push_back(std::move(piece));
  }
  if (pieces.empty()) {
    throw Error(place(list, where), "there is no piece", "give at least the root");
  }
  return pieces;
}

}  // namespace

void writeConstraintTree(const ConstraintTree& tree, std::ostream& stream) {
  const auto row = [&](const Eigen::Vector3d& v) -> std::ostream& {
    return stream << v.x() << ", " << v.y() << ", " << v.z();
  };
  const auto flags = stream.flags();
  const auto precision = stream.precision(std::numeric_limits<double>::max_digits10);
  stream << "tolerance: " << tree.tolerance() << "\nbounding_box: [[";
  row(tree.boundingBox().min()) << "], [";
  row(tree.boundingBox().max()) << "]]\npieces:\n";
  for (std::uint32_t i = 0; i < tree.pieces().size(); ++i) {
    const TreePiece& piece = tree.pieces()[i];
    stream << "  - object_id: [";
    const char* separator = "";
    for (const std::uint32_t number : tree.objectId(i)) {
      stream << separator << number;
      separator = ", ";
    }
    stream << "]\n    level: " << piece.level << "\n    constraints:\n";
    for (std::uint32_t k = 0; k < piece.constraint_count; ++k) {
      const LinearConstraint& constraint = tree.constraints()[piece.first_constraint + k];
      stream << "      - [";
      row(constraint.normal) << ", " << constraint.offset << "]\n";
    }
  }
  stream.precision(precision);
  stream.flags(flags);
}

void writeConstraintTreeFile(const ConstraintTree& tree, const std::string& path) {
  OutputFile file(path);
  writeConstraintTree(tree, file.stream());
  file.finish();
}

ConstraintTree readConstraintTree(std::istream& stream, const std::string& where) {
  YAML::Node file;
  try {
    file = YAML::Load(stream);
  } catch (const YAML::Exception& problem) {
    throw Error(where + ":" + std::to_string(problem.mark.line + 1), "this is not YAML: " + problem.msg,
                "see constraint_tree_file.h for the form");
  }
  const std::vector<FilePiece> pieces = piecesOf(required(file, "pieces", where), where);
  return ConstraintTree(assembled(pieces, 0), boxOf(required(file, "bounding_box", where), where),
                        valueOf<double>(required(file, "tolerance", where), "tolerance", where), where);
}

ConstraintTree readConstraintTreeFile(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) {
    throw Error(path, "the file cannot be read", "check its name and permissions");
  }
  return readConstraintTree(stream, path);
}

}  // namespace concave_distance

#pragma once

#include <iosfwd>
#include <string>

#include "constraint_tree.h"

namespace concave_distance {

/// Writes a tree as YAML, 17 digits, so that reading gives the same tree to the bit:
///
///     tolerance: 1.0e-12
///     bounding_box: [[0, 0, 0], [1, 1, 1]]      # metres, body frame
///     pieces:                                    # breadth first
///       - object_id: [1]
///         level: 1
///         constraints:                           # rows [a_x, a_y, a_z, b] of a . p + b >= 0, a a unit
///         vector
///           - [1, 0, 0, 0]
///       - object_id: [1, 1]
///         level: -2
///         ...
void writeConstraintTree(const ConstraintTree& tree, std::ostream& stream);

/// @throws Error naming the path when it cannot be written
void writeConstraintTreeFile(const ConstraintTree& tree, const std::string& path);

/// @param where named in errors, e.g. the file the text came from
/// @throws Error with the line when a key is missing, a number is none, a piece comes before its parent or
/// its level
///         is not its depth with the alternating sign, and as ConstraintTree does
ConstraintTree readConstraintTree(std::istream& stream, const std::string& where);

/// @throws Error naming the path when it cannot be read, and as above
ConstraintTree readConstraintTreeFile(const std::string& path);

}  // namespace concave_distance

#pragma once

#include <concave_distance/Constraints.h>

#include "concave_distance/kinematics/constraint_rows.h"

namespace concave_distance {

/// The rows of a cycle; header, distance and problems are the caller's.
void fillConstraints(const ConstraintRows& rows, Constraints& message);

}  // namespace concave_distance

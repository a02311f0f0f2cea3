#pragma once

#include <string>
#include <vector>

#include "benchmark/support/interference_trials.h"
#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance::benchmark {

struct InterferenceScene {
  std::string name;
  InterferencePair pair;
};

/// Boxes crossing edge over edge, a ball on a plate, combs, the battery pushed into its fixture, bumpy rings
/// of 1000 to 100,000 triangles.
std::vector<InterferenceScene> interferenceScenes();

/// Depth as engines take it from vertices: the farthest that a vertex of one body lies inside the other,
/// metres.
double vertexDepth(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);

/// Contacts that FCL's collide enumerates between the meshes, and the seconds of one such query.
struct FclContacts {
  std::size_t count;
  double deepest;  ///< as FCL has it, metres
  double seconds;
};
FclContacts fclContacts(const InterferencePair& pair);

}  // namespace concave_distance::benchmark

#include <concave_distance/mesh/body_mesh.h>
#include <concave_distance/mesh/primitives.h>

#include <cmath>
#include <cstdio>

// A unit cube with a search grid; exits with 0 when the library measures it right.
int main() {
  using namespace concave_distance;
  BodyMeshOptions options;
  options.max_edge_length = 0.25;
  const BodyMesh cube("cube", makeBox({1, 1, 1}), options);
  std::printf("diameter %.17g m, %zu nodes\n", cube.diameter(), cube.grid().vertexCount());
  return std::abs(cube.diameter() - std::sqrt(3.0)) < 1e-12 && cube.grid().vertexCount() > 8 ? 0 : 1;
}

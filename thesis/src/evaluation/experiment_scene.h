#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace concave_distance::detail {
class YamlValue;
}

namespace concave_distance::evaluation {

/// What the search's nodes are.
enum class NodeSource : std::uint8_t {
  Mesh,          ///< of the even grid
  RandomPoints,  ///< on the surface, vertices and edges included (Carretero, sec. 3.1.1)
  PlainRandomPoints,
  Volume  ///< the grid's and a lattice inside the body (sec. 3.1.2)
};

/// Which poses of a file.
struct Instants {
  std::uint32_t first = 0;  ///< from 0
  std::uint32_t count = 1;
  std::uint32_t step = 1;
};

/// Two bodies at a pose, or along a motion.
struct ExperimentScene {
  std::string name;
  std::string thesis_scene;  ///< of meshes/thesis, whose bodies, trees and pose are taken; or empty
  std::string mesh_a;        ///< mesh files, where it is not the thesis's
  std::string mesh_b;
  std::string poses;  ///< t,x,y,z,qx,qy,qz,qw: B in A's frame (doc/distance_query.md)
  Instants instants;
  std::optional<double> max_edge_length;  ///< of the grid, metres; empty: automatic
  NodeSource nodes = NodeSource::Mesh;
  std::uint64_t node_seed = 1;                    ///< of random points
  std::optional<double> lattice_edge;             ///< of a volume, metres; empty: max_edge_length
  std::optional<std::uint64_t> evaluation_limit;  ///< of every search here without one in its own row
  std::optional<std::uint32_t> population_size;   ///< of every GA here

  bool isMotion() const { return instants.count > 1; }
};

/// `name: 0.05`, a scene of meshes/thesis and its grid; or `name: {...}`.
/// @param folder what relative file names start from
/// @throws Error naming file, line and what is allowed
ExperimentScene readScene(const std::string& name, const detail::YamlValue& value, const std::string& folder);

}  // namespace concave_distance::evaluation

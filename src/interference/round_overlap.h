#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/union_find.h"
#include "concave_distance/interference/interference.h"
#include "distance/bound/round_certificate.h"
#include "round_section.h"
#include "round_volume.h"
#include "shallow_round_volume.h"

namespace concave_distance::detail {

/// Regions of overlap of a round solid and a mesh, from the mesh's surface inside the solid
/// (doc/interference.md). Keeps buffers.
class RoundOverlap {
 public:
  /// Exactly one of the bodies has a shape. Fills all of `result` but its rounding bound, which is read.
  void find(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b, Interference& result,
            WorkLimit& limit);

 private:
  /// A triangle that enters the solid.
  struct Entry {
    TriangleIndex triangle;
    std::uint32_t patch;   ///< first of those that hang together inside
    std::uint32_t region;  ///< first patch of the region
    LowestPoint lowest;
    TrianglePoints corners;
    Eigen::Vector3d normal;
    bool leaves;  ///< the solid
    bool hidden;  ///< inside another shell of the mesh: no surface
  };
  struct Crossing {
    double at;
    double outward;  ///< > 0 where the line leaves the mesh
    std::uint32_t patch;
  };
  struct ShellVolume {
    std::uint32_t shell = 0;
    RoundVolume volume;
  };
  /// Samples of one region, in samples_.
  struct Group {
    const Entry* first;
    const Entry* last;
    const Entry* last_hidden;  ///< those that are hidden follow
    std::size_t first_sample;
    std::size_t last_sample;
  };

  bool collect(WorkLimit& limit);
  void joinEntries();
  void joinPatches();
  void joinHidden();
  void joinAlong(const Entry& from, const Entry& to);
  void findCrossings(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  bool meshHolds(const Eigen::Vector3d& point) const;

  void addSwallowedShape(Interference& result);
  static const Entry& deepestOf(const Entry* first, const Entry* last);
  static bool has(const Group& group, std::uint32_t patch);
  void gatherSamples(Group& group);
  void addRegion(Group group, bool is_only, Interference& result);
  RoundVolume& volumeOfShell(TriangleIndex triangle);
  void addShells(InterferenceRegion& region) const;
  bool isCavity(std::uint32_t shell) const;
  void measureVolume(const Group& group, bool is_only, InterferenceRegion& region);
  void measureShallowVolume(const Group& group, bool is_only, int side, InterferenceRegion& region);
  void setVolume(double volume, const Eigen::Vector3d& moment, double area, InterferenceRegion& region) const;
  double leastFromCore(int side) const;
  int sideOf() const;
  void addCore(const Group& group, bool is_only, ShallowRoundVolume& volume);
  bool holdsCentre(const Group& group, bool is_only);
  void addLoops(const Group& group, Interference& result, InterferenceRegion& region);
  void chooseNormal(const Group& group, double surface, const Eigen::Vector3d& vector_area,
                    InterferenceRegion& region);
  void measureDepths(const Group& group, InterferenceRegion& region);
  void lookAtBottom(const Group& group, const Eigen::Vector3d& out_of_mesh, InterferenceRegion& region);
  void addSamples(const Group& group, Interference& result, InterferenceRegion& region) const;
  void addFacets(const Group& group, Interference& result, InterferenceRegion& region) const;
  double depthAlong(const Group& group, const Eigen::Vector3d& out_of_mesh, Eigen::Vector3d* at) const;
  Eigen::Vector3d outOfMesh(const Eigen::Vector3d& normal_in_a) const;
  Eigen::Vector3d inA(const Eigen::Vector3d& point) const { return a_from_shape_ * point; }
  void place(const Eigen::Vector3d& on_mesh, const Eigen::Vector3d& on_shape, Eigen::Vector3d& on_a,
             Eigen::Vector3d& on_b) const;

  std::optional<RoundAndMesh> pair_;
  bool shape_is_a_ = false;
  Eigen::Isometry3d a_from_shape_ = Eigen::Isometry3d::Identity();
  double rounding_ = 0.0;
  std::vector<std::uint32_t> stack_;
  std::vector<Entry> entries_;
  UnionFind patches_;                             ///< of entries
  std::vector<std::uint32_t> place_of_triangle_;  ///< in entries_, where the stamp is the present one
  std::vector<std::uint32_t> stamps_;
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> deepest_;  ///< entry of each patch
  std::vector<Crossing> crossings_;
  std::vector<RoundSample> samples_;        ///< of the present region
  std::vector<TrianglePoints> fan_;         ///< of the present region's entries, one after the other
  std::vector<std::size_t> fan_ends_;       ///< by entry of the region
  std::vector<std::size_t> patch_samples_;  ///< where those of each of its patches begin, and their end
  RoundSection section_;
  std::vector<ShellVolume> volumes_;  ///< of the present region
  std::size_t volume_count_ = 0;
};

}  // namespace concave_distance::detail

#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "concave_distance/mesh/body_mesh.h"
#include "exact_niches.h"
#include "niche_archive.h"
#include "niche_search.h"

namespace concave_distance {

/// Two surfaces that a pair's niches are found on, and what is kept of them from cycle to cycle: the meshes
/// of the bodies or, where one is a sphere or a capsule, its core, with the radius as a margin.
struct NicheBasis {
  NicheBasis(std::shared_ptr<const BodyMesh> of_a, std::shared_ptr<const BodyMesh> of_b)
      : a(std::move(of_a)), b(std::move(of_b)), search(*a, *b) {}

  /// Returns the cores of spheres and capsules with the meshes of what is none; nullptr where neither is one.
  static std::unique_ptr<NicheBasis> ofCores(const std::shared_ptr<const BodyMesh>& a,
                                             const std::shared_ptr<const BodyMesh>& b);

  /// Returns the pose of `b` in the frame of `a` for one of the bodies.
  Eigen::Isometry3d poseOf(const Eigen::Isometry3d& a_from_b) const {
    return a_from_body * a_from_b * body_from_b;
  }
  /// Returns how much nearer to each other the solids are than these surfaces, metres.
  double margin() const { return margin_a + margin_b; }

  /// Forgets the last cycles.
  void reset() {
    archive.clear();
    niches.clear();
    search.restart();
  }

  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  Eigen::Isometry3d a_from_body = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d body_from_b = Eigen::Isometry3d::Identity();
  double margin_a = 0.0;   ///< metres
  double margin_b = 0.0;   ///< metres
  double thickness = 0.0;  ///< metres, of both cores: what a distance less the margin may be off
  NicheSearch search;
  ExactNiches niches;
  NicheArchive archive;
  bool is_search_prepared = false;
};

}  // namespace concave_distance

#include "benchmark/support/circling_pair.h"

#include <algorithm>
#include <filesystem>

#include "concave_distance/loading/load_body_mesh.h"

namespace concave_distance::benchmark {
namespace {

Eigen::Isometry3d circling(double t, double radius, const Eigen::Vector3d& centre_a,
                           const Eigen::Vector3d& centre_b) {
  const Eigen::AngleAxisd round(2.0 * t, Eigen::Vector3d(0.3, -0.5, 0.8).normalized());
  const Eigen::AngleAxisd turn(1.5 * t, Eigen::Vector3d(0.7, 0.6, -0.2).normalized());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn.toRotationMatrix();
  pose.translation() =
      centre_a + radius * (round * Eigen::Vector3d(0.8, 0.6, 0.0)) - pose.linear() * centre_b;
  return pose;
}

}  // namespace

BenchmarkPair makeCirclingPair(const std::string& name, const std::string& file_a, const std::string& file_b,
                               std::optional<double> max_edge_length) {
  constexpr int kInstants = 32;
  LoadMeshOptions options;
  options.body.max_edge_length = max_edge_length;
  BenchmarkPair pair;
  pair.name = name;
  pair.a = loadBodyMesh(file_a, 1.0, options).mesh;
  pair.b = loadBodyMesh(file_b, 1.0, options).mesh;
  pair.fcl_a = makeFclModel(pair.a->surface());
  pair.fcl_b = makeFclModel(pair.b->surface());
  const Eigen::Vector3d centre_a = pair.a->surface().boundingBox().center();
  const Eigen::Vector3d centre_b = pair.b->surface().boundingBox().center();
  const double apart = 0.5 * (pair.a->diameter() + pair.b->diameter());
  double radius = 0.0;
  for (int k = 0; k <= kInstants; ++k) {
    double meets = 0.0;
    double clear = apart;
    while (clear - meets > 1e-3 * apart) {
      const double middle = 0.5 * (meets + clear);
      const Eigen::Isometry3d pose = circling(static_cast<double>(k) / kInstants, middle, centre_a, centre_b);
      (fclDistance(*pair.fcl_a, *pair.fcl_b, pose).distance > 0.0 ? clear : meets) = middle;
    }
    radius = std::max(radius, clear);
  }
  radius *= 1.02;
  pair.motion = [=](double t) { return circling(t, radius, centre_a, centre_b); };
  return pair;
}

BenchmarkPair makeCirclingPair(const std::string& files) {
  const std::size_t colon = files.find(':');
  const auto stem = [](const std::string& path) { return std::filesystem::path(path).stem().string(); };
  const std::string file_a = files.substr(0, colon);
  const std::string file_b = colon == std::string::npos ? file_a : files.substr(colon + 1);
  return makeCirclingPair(stem(file_a) + "-" + stem(file_b), file_a, file_b);
}

}  // namespace concave_distance::benchmark

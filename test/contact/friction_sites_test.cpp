#include "contact/friction_sites.h"

#include <gtest/gtest.h>

#include <vector>

namespace concave_distance::friction_sites_test {
namespace {

/// As a triangle of a mesh is sampled that lies whole in the overlap: at the middles of its edges.
std::vector<OverlapSample> samplesOf(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                     const Eigen::Vector3d& r) {
  const double area = 0.25 * (q - p).cross(r - p).norm();  // half of it: both surfaces count half
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::vector<OverlapSample> samples;
  for (const Eigen::Vector3d& sum : {Eigen::Vector3d(p + q), Eigen::Vector3d(q + r), Eigen::Vector3d(r + p)})
    samples.push_back({0.5 * sum, up, up, area / 3.0, 1e-3});
  return samples;
}

TEST(FrictionSites, ATriangleIsSpreadOverTheCellsThatItCovers) {
  const std::vector<OverlapSample> samples = samplesOf({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  FrictionSites sites;
  sites.gather(samples.data(), samples.data() + samples.size(), {1.0, 1.0, 1.0}, 0.2);
  double force = 0.0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (const FrictionSite& site : sites.all()) {
    EXPECT_GT(site.force, 0.0);
    EXPECT_LT(site.spread, 0.2);
    force += site.force;
    place += site.force * site.point_in_a;
  }
  EXPECT_GT(sites.all().size(), 10U);
  EXPECT_NEAR(force, 3.0, 1e-12);
  EXPECT_NEAR((place / force - Eigen::Vector3d(1.0 / 3.0, 1.0 / 3.0, 0.0)).norm(), 0.0, 1e-12);
}

// A cylinder that hardly touches a plane: cells as wide as the strip, which is a million times as long.
TEST(FrictionSites, AStripHasFewSites) {
  for (const double width : {1e-6, 1e-9, 1e-12, 1e-15}) {
    const std::vector<OverlapSample> samples = samplesOf({0, 0, 0}, {1, 0, 0}, {0.5, width, 0});
    FrictionSites sites;
    sites.gather(samples.data(), samples.data() + samples.size(), {1.0, 1.0, 1.0}, 0.1 * width);
    double force = 0.0;
    for (const FrictionSite& site : sites.all()) force += site.force;
    EXPECT_NEAR(force, 3.0, 1e-9) << width;
    EXPECT_LT(sites.all().size(), 40U) << width;
  }
}

}  // namespace
}  // namespace concave_distance::friction_sites_test

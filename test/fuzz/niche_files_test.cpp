// Every pair of test/data/niches at its poses, alone and as a motion, against the enumeration: small inputs
// whose lists were wrong once.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "concave_distance/loading/load_body_mesh.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "fuzz/niche_comparison.h"
#include "loading/query_poses.h"

namespace concave_distance::test::niche_files_test {
namespace {

constexpr std::size_t kMostEnumerated = 13;  // poses of a file; all are solved

struct Files {
  const char* name;
  const char* a;
  const char* b;
  const char* poses;
};

std::string pathOf(const std::string& file) {
  return CONCAVE_DISTANCE_TEST_DATA "/niches/" + file;
}

/// Settings that were toggled or combined where lists were wrong. The last one's count is cut in some cycles.
std::vector<TrackerParameters> settingsOfTheCases() {
  std::vector<TrackerParameters> settings(6);
  settings[1].largest_niche_count = 3;
  settings[2].hidden = true;
  settings[2].prominence_limit = 0.5;
  settings[3].hidden = true;
  settings[3].least_prominence = 0.0;
  settings[4].hidden = true;
  settings[4].keep_through_material = true;
  return settings;
}

class NicheFiles : public testing::TestWithParam<Files> {};

TEST_P(NicheFiles, ListsAreThoseOfTheEnumerationColdAndTracked) {
  const auto a = loadBodyMesh(pathOf(GetParam().a) + ".obj").mesh;
  const auto b = loadBodyMesh(pathOf(GetParam().b) + ".obj").mesh;
  const WideBody wide_a(a->surface());
  const WideBody wide_b(b->surface());
  const std::vector<QueryPose> path = readQueryPoses(pathOf(GetParam().poses) + ".csv");
  std::vector<TrackerParameters> settings = settingsOfTheCases();
  std::vector<PairTracker> trackers;
  for (const TrackerParameters& parameters : settings) trackers.emplace_back("case", a, b, parameters);
  PairSolution tracked;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Eigen::Isometry3d pose = poseOf(path[k]).value();
    const bool is_enumerated = path.size() <= kMostEnumerated || k < 2 || k % 8 == 7;
    settings.back().largest_niche_count = k % 4 == 1 ? 2 : 64;
    trackers.back().setParameters(settings.back());
    std::optional<NicheEnumeration> enumeration;
    if (is_enumerated) enumeration.emplace(wide_a, wide_b, pose);
    for (std::size_t i = 0; i < settings.size(); ++i) {
      SCOPED_TRACE("pose " + std::to_string(k) + ", settings " + std::to_string(i));
      trackers[i].update(pose, 0.01 * static_cast<double>(k), tracked);
      const PairSolution cold = solveOnce("case", a, b, settings[i], pose);
      ASSERT_EQ(tracked.niches.size(), cold.niches.size());
      if (!enumeration) continue;
      EXPECT_EQ(complaintAbout(cold, settings[i], *enumeration), "");
      EXPECT_EQ(complaintAbout(tracked, settings[i], *enumeration), "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, NicheFiles,
                         testing::Values(Files{"near_edge", "near_edge_a", "near_edge_b", "near_edge_poses"},
                                         Files{"near_edge_far_above", "near_edge_far_above_a",
                                               "near_edge_far_above_b", "near_edge_far_above_poses"},
                                         Files{"far", "far_a", "far_b", "far_poses"},
                                         Files{"rings", "rings_a", "rings_b", "rings_poses"},
                                         Files{"plain", "plain", "tjunction_probe", "tjunction_poses"},
                                         Files{"tjunction", "tjunction", "tjunction_probe",
                                               "tjunction_poses"},
                                         Files{"coplanar_0", "coplanar_a0", "coplanar_b", "coplanar_poses"},
                                         Files{"coplanar_1", "coplanar_a1", "coplanar_b", "coplanar_poses"},
                                         Files{"coplanar_2", "coplanar_a2", "coplanar_b", "coplanar_poses"},
                                         Files{"coplanar_3", "coplanar_a3", "coplanar_b", "coplanar_poses"},
                                         Files{"coplanar_4", "coplanar_a4", "coplanar_b", "coplanar_poses"}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace concave_distance::test::niche_files_test

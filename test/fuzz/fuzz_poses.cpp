// Any bytes as the poses of distance_query: poses, or an Error with file and line.

#include "concave_distance/base/error.h"
#include "fuzz/fuzz_input.h"
#include "loading/query_poses.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace concave_distance;
  const std::string path = test::fuzzFolder().write("poses.csv", test::textOf(data, size));
  try {
    for (const QueryPose& query : readQueryPoses(path)) {
      const auto pose = poseOf(query);
      if (!pose) continue;
      const Eigen::Matrix3d r = pose->linear();
      if (!((r.transpose() * r - Eigen::Matrix3d::Identity()).norm() < 1e-14)) test::broken("a rotation");
      if (!pose->translation().allFinite()) test::broken("a finite pose");
    }
  } catch (const Error& error) {
    if (error.where().rfind(path, 0) != 0) test::broken("an Error names the file");
  }
  return 0;
}

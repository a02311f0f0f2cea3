#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "support/body_bytes.h"
#include "support/concave_shapes.h"

namespace concave_distance::parallel_build_test {
namespace {

/// A bumpy torus: enough triangles that its trees are built in several tasks on several levels.
SurfaceMesh makeLargeTorus(std::uint32_t around, std::uint32_t across) {
  return test::makeRingOfTube(0.5, around, across, [](double along, double over) {
    return 0.2 + 0.02 * std::sin(9.0 * along) * std::cos(5.0 * over);
  });
}

std::map<std::string, test::Bytes> buildWithThreads(std::size_t threads, const SurfaceMesh& surface,
                                                    const BodyMeshOptions& options) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  return test::bytesOf(BodyMesh("torus", surface, options));
}

TEST(ParallelBuild, EveryPartIsTheSameWhateverTheNumberOfThreads) {
  const SurfaceMesh large = makeLargeTorus(420, 160);  // 134,400 triangles: two levels of tasks
  BodyMeshOptions fine;
  fine.max_edge_length = 0.1;  // the surface is its own grid, too many nodes for matrices
  for (const BodyMeshOptions& options : {BodyMeshOptions(), fine}) {
    const auto alone = buildWithThreads(1, large, options);
    for (const std::size_t threads :
         options.max_edge_length ? std::vector<std::size_t>{2} : std::vector<std::size_t>{2, 3}) {
      const auto together = buildWithThreads(threads, large, options);
      for (const auto& [part, bytes] : alone) {
        EXPECT_TRUE(bytes == together.at(part)) << part << " with " << threads << " threads";
      }
    }
  }
}

TEST(ParallelBuild, ErrorsNameTheBodyAndLeaveNoHalfBuiltPartsBehind) {
  BodyMeshOptions options;
  options.max_edge_length = -1.0;
  try {
    // Refused while the trees are being built in tasks of their own.
    const BodyMesh body("torus", makeLargeTorus(420, 160), options);
    FAIL() << "a negative edge length was accepted";
  } catch (const std::exception& error) {
    EXPECT_EQ(std::string(error.what()).rfind("torus", 0), 0U) << error.what();
  }
}

}  // namespace
}  // namespace concave_distance::parallel_build_test

// What the differential program writes can be replayed: distance_query, with the files and the command that
// are printed, answers the very question that was asked.
#include "fuzz/reproducer.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "support/csv_table.h"
#include "support/exact_query.h"
#include "support/query_bound.h"

namespace concave_distance::test::reproducer_test {
namespace {

constexpr std::uint64_t kScenes = 20;

TEST(Reproducer, IsAnsweredByDistanceQueryAsTheSceneWas) {
  const TemporaryFolder folder;
  const std::string program = "distance_query";
  int same = 0;
  int apart = 0;
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(streamSeed(seed, "differential", 0));
    const DifferentialScene scene = drawScene(engine);
    const std::string command = writeReproducer(scene, seed, "what was wrong", folder.path("findings"));
    ASSERT_EQ(command.substr(0, program.size()), program);
    const std::string line = CONCAVE_DISTANCE_DISTANCE_QUERY + command.substr(program.size()) + " > " +
                             folder.path("log") + " 2>&1";
    const int status = std::system(line.c_str());
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << line << contentOf(folder.path("log"));

    const std::string mark = "_" + std::to_string(seed);
    const std::string report = contentOf(folder.path("findings/report" + mark + ".txt"));
    EXPECT_NE(report.find("what was wrong"), std::string::npos);
    EXPECT_NE(report.find(command), std::string::npos);
    const std::vector<Row> rows = readTable(folder.path("findings/answer" + mark + ".csv"));
    ASSERT_EQ(rows.size(), 1U);
    const std::string& state = rows[0].at("status");
    EXPECT_TRUE(state == "ok" || state == "penetrating") << state;
    // The rare scene that a file cannot bring back says so, and how to replay it otherwise.
    if (report.find("--count 1 instead") != std::string::npos) continue;
    ++same;
    const auto truth = static_cast<double>(exactSurfaceDistance(scene.a, scene.b, scene.b_in_a));
    const double bound = queryBound(scene.a, scene.b, scene.b_in_a.translation, truth);
    const auto point = [&](const char* body) {
      return Eigen::Vector3d(number(rows[0], std::string(body) + "x"),
                             number(rows[0], std::string(body) + "y"),
                             number(rows[0], std::string(body) + "z"));
    };
    // Where one body has swallowed the other the points still tell the distance of the surfaces.
    EXPECT_NEAR((point("b") - point("a")).norm(), truth, 4.0 * bound);
    if (state == "ok") {
      EXPECT_NEAR(number(rows[0], "distance"), truth, bound);
      EXPECT_LE(number(rows[0], "lower_bound"), truth);
      ++apart;
    }
  }
  EXPECT_GE(same, 0.9 * kScenes);
  EXPECT_GE(apart, 0.4 * kScenes);
}

}  // namespace
}  // namespace concave_distance::test::reproducer_test

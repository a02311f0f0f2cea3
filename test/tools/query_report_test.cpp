#include "tools/query_report.h"

#include <gtest/gtest.h>

#include "concave_distance/base/error.h"
#include "support/temporary_folder.h"

namespace concave_distance::tools::query_report_test {
namespace {

using test::contentOf;
using test::TemporaryFolder;

TEST(AnswerWriter, WritesTheAgreedColumnsAndLeavesEmptyWhatWasNotComputed) {
  const TemporaryFolder folder;
  AnswerWriter writer(folder.path("out.csv"));
  QueryAnswer answer;
  answer.status = "invalid_pose";
  writer.write(0, answer);
  answer.status = "ok";
  answer.distance = 0.25;
  answer.point_a_in_a = Eigen::Vector3d(1, 2, 3);
  answer.point_b_in_a = Eigen::Vector3d(1, 2, 3.25);
  answer.niche_count = 0;
  answer.time_us = 12.5;
  writer.write(1, answer);
  answer.status = "penetrating";
  answer.distance = answer.lower_bound = 0.0;
  answer.point_b_in_a = answer.point_a_in_a;
  answer.niche_count.reset();
  answer.meeting_triangles = TrianglePair{TriangleIndex{7U}, TriangleIndex{11U}};
  writer.write(2, answer);
  writer.finish();
  EXPECT_EQ(contentOf(folder.path("out.csv")),
            "index,distance,lower_bound,ax,ay,az,bx,by,bz,niche_count,status,time_us,triangle_a,triangle_b\n"
            "0,,,,,,,,,,invalid_pose,,,\n"
            "1,0.25,,1,2,3,1,2,3.25,0,ok,12.5,,\n"
            "2,0,0,1,2,3,1,2,3,,penetrating,12.5,7,11\n");
}

TEST(NicheWriter, WritesNumbersThatReadBackAsTheSameDouble) {
  const TemporaryFolder folder;
  TrackedNiche niche;
  niche.distance = 0.1 + 0.2;
  niche.point_a_in_a = Eigen::Vector3d(1.0 / 3.0, 1e-300, -1e22);
  niche.point_b_in_a = Eigen::Vector3d(-0.0, 5e-324, 1.7976931348623157e308);
  niche.kind = NicheKind::Segment;
  niche.extent = 0.75;
  niche.outward = Outwardness::Unknown;
  niche.visible = false;
  niche.origin = NicheOrigin::FromCones;
  NicheWriter writer(folder.path("niches.csv"));
  writer.write(3, 12345678901234567890ULL, niche, true);
  niche.prominence = 0.5;
  writer.write(4, 1, niche, true);
  writer.write(5, 2, niche, false);
  writer.finish();
  const std::string text = contentOf(folder.path("niches.csv"));
  EXPECT_EQ(
      text,
      "index,niche,distance,ax,ay,az,bx,by,bz,kind,extent,outward,visible,prominence,origin\n"
      "3,12345678901234567890,0.30000000000000004,0.33333333333333331,1e-300,"
      "-1e+22,-0,4.9406564584124654e-324,1.7976931348623157e+308,segment,0.75,unknown,0,,from_cones\n"
      "4,1,0.30000000000000004,0.33333333333333331,1e-300,"
      "-1e+22,-0,4.9406564584124654e-324,1.7976931348623157e+308,segment,0.75,unknown,0,0.5,from_cones\n"
      "5,2,0.30000000000000004,0.33333333333333331,1e-300,"
      "-1e+22,-0,4.9406564584124654e-324,1.7976931348623157e+308,,,,,,\n");
}

TEST(AnswerWriter, SaysWhereItCannotWrite) {
  try {
    AnswerWriter writer("/nowhere/out.csv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "/nowhere/out.csv");
  }
}

}  // namespace
}  // namespace concave_distance::tools::query_report_test

#include "kinematics/frame_name.h"

#include <gtest/gtest.h>

#include "concave_distance/base/error.h"

namespace concave_distance::frame_name_test {
namespace {

TEST(FrameName, TakesWhatTf2CanLookUp) {
  for (const char* name : {"world", "/world", "robot/arm_1", "left-hand", "map.2", "w\u00f6rld"}) {
    EXPECT_EQ(requireFrameName(name, "frame"), withoutLeadingSlash(name));
  }
}

TEST(FrameName, RefusesTheRestAndSaysWhere) {
  for (const std::string& name :
       {std::string(), std::string("/"), std::string("///"), std::string("//a"), std::string(1, '\0'),
        std::string("a\0b", 3), std::string("a b"), std::string(" "), std::string("a\n"), std::string("a\tb"),
        std::string("a\x7f"), std::string(256, 'x')}) {
    try {
      requireFrameName(name, "pose_a.header.frame_id");
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), "pose_a.header.frame_id");
    }
  }
}

TEST(FrameName, OfAnotherPublisherMayHaveBlanks) {
  EXPECT_EQ(tfFrameProblem("my robot"), "");
  EXPECT_NE(tfFrameProblem("my\nrobot"), "");
}

}  // namespace
}  // namespace concave_distance::frame_name_test

#include "ros/callback_guard.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "base/log_throttle.h"

namespace concave_distance::callback_guard_test {
namespace {

TEST(CallbackGuard, KeepsEveryExceptionInside) {
  EXPECT_TRUE(guarded("test", [] {}));
  EXPECT_FALSE(guarded("test", [] { throw std::runtime_error("Duration is out of dual 32-bit range"); }));
  EXPECT_FALSE(guarded("test", [] { throw 1; }));
}

TEST(LogThrottle, LetsOneMessageOfASubjectThrough) {
  LogThrottle throttle;
  EXPECT_TRUE(throttle.isDue("a"));
  EXPECT_FALSE(throttle.isDue("a"));
  EXPECT_FALSE(throttle.isDue("b")) << "one a second of all";
}

TEST(Printable, WritesControlCharactersAsCodesAndCutsLongTexts) {
  EXPECT_EQ(printable(std::string("a\0b\n", 4)), "a\\x00b\\x0a");
  EXPECT_EQ(printable(std::string(100, 'x')), std::string(80, 'x') + "...");
}

}  // namespace
}  // namespace concave_distance::callback_guard_test

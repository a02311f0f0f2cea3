#include "base/number_text.h"

#include <gtest/gtest.h>

#include <string>

namespace concave_distance::number_text_test {
namespace {

std::string zeros(std::size_t count) {
  return std::string(count, '0');
}

TEST(ParseNumber, WhatIsTooSmallForADoubleIsZeroHoweverItIsWritten) {
  for (const std::string& text :
       {std::string("1e-400"), std::string("-1E-400"), std::string("+1e-400"), "0." + zeros(400) + "1",
        "." + zeros(400) + "1e+5", "1" + zeros(400) + "e-1000", "1" + zeros(400) + ".5e-99999999999999999999",
        std::string("0.5e-99999999999999999999"), std::string("0e-99999")}) {
    EXPECT_EQ(parseNumber(text), 0.0) << text;
  }
}

TEST(ParseNumber, WhatIsTooLargeForADoubleIsNoNumberHoweverItIsWritten) {
  for (const std::string& text :
       {std::string("1e400"), std::string("-1E+400"), "1" + zeros(400), "1" + zeros(400) + "e-5",
        "0." + zeros(400) + "1e1000", std::string("0.5e99999999999999999999")}) {
    EXPECT_EQ(parseNumber(text), std::nullopt) << text;
  }
}

TEST(ParseNumber, TheSmallestAndLargestDoublesAreRead) {
  EXPECT_EQ(parseNumber("4.9406564584124654e-324"), 0x1.0p-1074);
  EXPECT_EQ(parseNumber("1.7976931348623157e308"), 0x1.fffffffffffffp+1023);
  EXPECT_EQ(parseNumber(zeros(400) + ".5"), 0.5);
  EXPECT_EQ(parseNumber("5" + zeros(399) + "e-399"), 5.0);
}

TEST(ParseNumber, WhatIsNotWhollyANumberIsNone) {
  for (const char* text : {"", "+", "-", "+-1", "++1", "1 ", " 1", "1e", "1,5", "0x10", "1e-400x", "e-400"}) {
    EXPECT_EQ(parseNumber(text), std::nullopt) << "'" << text << "'";
  }
}

}  // namespace
}  // namespace concave_distance::number_text_test

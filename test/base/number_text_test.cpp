#include "base/number_text.h"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include "base/number_characters.h"

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

// The library's own reading and writing, for compilers without <charconv> for doubles, beside that of
// <charconv>.
#if defined(__cpp_lib_to_chars)

TEST(NumbersByC, AreWrittenAsCharconvWritesThem) {
  std::mt19937_64 engine(7);
  std::array<char, 700> ours{};
  std::array<char, 700> theirs{};
  for (int i = 0; i < 200000; ++i) {
    double value = 0.0;
    const std::uint64_t bits = engine();
    std::memcpy(&value, &bits, sizeof value);
    if (i % 2 == 0) value = static_cast<double>(static_cast<std::int64_t>(bits) >> (bits % 64)) / 1024.0;
    const int precision = static_cast<int>(bits % 19);
    const auto view = [](const std::array<char, 700>& text, const char* end) {
      return std::string_view(text.data(), static_cast<std::size_t>(end - text.data()));
    };
    const auto written = [&](std::chars_format format) {
      return view(theirs,
                  std::to_chars(theirs.data(), theirs.data() + theirs.size(), value, format, precision).ptr);
    };
    ASSERT_EQ(view(ours, detail::writeGeneralByC(ours.data(), ours.data() + ours.size(), value, precision)),
              written(std::chars_format::general));
    ASSERT_EQ(view(ours, detail::writeFixedByC(ours.data(), ours.data() + ours.size(), value, precision)),
              written(std::chars_format::fixed));
  }
}

void expectTheSameReading(const std::string& text) {
  double ours = -7.0;
  double theirs = -7.0;
  const auto read = detail::readCharactersByC(text.data(), text.data() + text.size(), ours);
  const auto wanted = std::from_chars(text.data(), text.data() + text.size(), theirs);
  ASSERT_EQ(read.ptr, wanted.ptr) << text;
  ASSERT_EQ(read.ec == std::errc(), wanted.ec == std::errc()) << text;
  if (wanted.ec == std::errc::invalid_argument) {
    ASSERT_EQ(read.ec, wanted.ec) << text;
  }
  if (wanted.ec == std::errc()) {
    ASSERT_EQ(std::memcmp(&ours, &theirs, sizeof ours), 0) << text;
  }
}

TEST(NumbersByC, AreReadAsCharconvReadsThem) {
  for (const char* text :
       {"",          "-",        "+1",        ".",       "-.",     ".5",
        "5.",        "-5.e",     "1e",        "1e+",     "1e5x",   "1E-5",
        "0x10",      "inf",      "-INFinity", "infinit", "nan",    "-nan",
        "nan(12_a)", "nan(1",    "NAN()",     " 1",      "1 ",     "1,5",
        "1.5.5",     "0e999",    "-0",        "1e400",   "1e-400", "-1e400",
        "2e-320",    "4.9e-324", "1e-323",    "--1",     "e5",     "1e99999999999999999999"}) {
    expectTheSameReading(text);
  }
  std::mt19937_64 engine(11);
  constexpr std::string_view kCharacters = "0123456789012345678901234567890123456789..--+eE ,xinf";
  for (int i = 0; i < 200000; ++i) {
    std::string text;
    const std::size_t length = 1 + engine() % 24;
    while (text.size() < length) text += kCharacters[engine() % kCharacters.size()];
    expectTheSameReading(text);
  }
}

TEST(NumbersByC, AreReadBackToTheLastBit) {
  std::mt19937_64 engine(13);
  for (int i = 0; i < 200000; ++i) {
    double value = 0.0;
    const std::uint64_t bits = engine();
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    std::array<char, 40> text{};
    const char* end = detail::writeGeneralByC(text.data(), text.data() + text.size(), value, 17);
    double read = 0.0;
    ASSERT_EQ(detail::readCharactersByC(text.data(), end, read).ptr, end);
    ASSERT_EQ(read, value);
  }
}

#endif

}  // namespace
}  // namespace concave_distance::number_text_test

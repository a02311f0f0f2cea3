#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace concave_distance {
namespace {

std::string readText(const std::string& path) {
  std::ifstream stream(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/" + path);
  EXPECT_TRUE(stream.is_open()) << path;
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  std::set<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match) {
    found.insert((*match)[1]);
  }
  return found;
}

// The names in the first column of the table.
std::set<std::string> documentedParameters() {
  std::set<std::string> names;
  for (const std::string& cell : matches(readText("doc/parameters.md"), "\\n\\| (`[^|]*) \\|")) {
    names.merge(matches(cell, "`(\\w+)`"));
  }
  return names;
}

TEST(ParameterDocumentation, NamesEveryParameterThatTheNodeReadsAndNoOther) {
  std::set<std::string> read =
      matches(readText("src/ros/node_parameters.cpp"), R"(reader\.\w+\(\s*"(\w+)\")");
  EXPECT_GT(read.size(), 20U);
  EXPECT_EQ(documentedParameters(), read);
}

TEST(ParameterDocumentation, NamesEveryLimitThatTheNodeReadsAndNoOther) {
  const std::set<std::string> read =
      matches(readText("src/ros/limits_reader.cpp"), R"(reader\.\w+\(\s*"(\w+)\")");
  EXPECT_GT(read.size(), 5U);
  EXPECT_EQ(matches(readText("doc/parameters.md"), "\n\\| `limits/(\\w+)` \\|"), read);
}

TEST(ParameterDocumentation, MarksWhatMayChangeWhileRunning) {
  const std::set<std::string> marked = matches(readText("doc/parameters.md"), "`(\\w+)`\\*");
  EXPECT_EQ(marked, matches(readText("config/ConcaveDistance.cfg"), "gen\\.add\\(\"(\\w+)\""));
}

TEST(TestingDocumentation, NamesEveryRostestCaseAndNoOther) {
  std::set<std::string> cases;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/test/ros/rostest")) {
    const std::string name = entry.path().filename();
    if (name.size() < 13 || name.substr(name.size() - 12) != "_rostest.cpp") {
      continue;
    }
    const std::string text = readText("test/ros/rostest/" + name);
    cases.merge(matches(text, "TEST(?:_[FP])?\\(\\w+, (\\w+)\\)"));
  }
  EXPECT_GT(cases.size(), 30U);
  EXPECT_EQ(matches(readText("doc/testing.md"), "\\b([A-Z]\\w*[a-z]{2}[A-Z]\\w*)\\b"), cases);
}

}  // namespace
}  // namespace concave_distance

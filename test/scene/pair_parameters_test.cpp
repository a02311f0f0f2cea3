#include "scene/pair_parameters.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "search/genetic_parameter_table.h"
#include "support/temporary_folder.h"
#include "tracking/tracker_parameter_table.h"

namespace concave_distance::pair_parameters_test {
namespace {

// The members of a struct of plain parameters, read from its header.
std::set<std::string> membersOf(const std::string& header, const std::string& name) {
  const std::string text =
      test::contentOf(std::string(CONCAVE_DISTANCE_SOURCE_DIR "/include/concave_distance/") + header);
  const std::size_t begin = text.find("struct " + name + " {");
  const std::string body = text.substr(begin, text.find("\n};", begin) - begin);
  const std::regex member(R"(\n  [A-Za-z_:<>0-9]+ ([a-z_]+)( =[^;]*)?;)");
  std::set<std::string> members;
  for (std::sregex_iterator it(body.begin(), body.end(), member), end; it != end; ++it)
    members.insert((*it)[1]);
  return members;
}

template <typename Settings>
std::set<std::string> namesOf(const ParameterTable<Settings>& table) {
  std::set<std::string> names;
  for (const Parameter<Settings>& parameter : table) names.insert(parameter.info.name);
  return names;
}

TEST(PairParameters, DeclareEveryMemberAndGiveItsDefault) {
  EXPECT_EQ(namesOf(geneticParameters()), membersOf("search/genetic_parameters.h", "GeneticParameters"));
  std::set<std::string> tracker = membersOf("tracking/tracker_parameters.h", "TrackerParameters");
  // Listeners decide what is wanted; cold, warm and margins have tables of their own.
  for (const char* name : {"niches_wanted", "cold", "warm"}) tracker.erase(name);
  for (const std::string& name : namesOf(marginParameters())) EXPECT_EQ(tracker.erase(name), 1U) << name;
  tracker.insert({"warning_distance", "warning_hysteresis"});
  EXPECT_EQ(namesOf(pairParameters()), tracker);
  PairSettings settings;
  for (const Parameter<PairSettings>& parameter : pairParameters()) {
    const ParameterValue value = parameter.get(PairSettings());
    EXPECT_EQ(parseParameter(parameter.info, toText(value)), value) << parameter.info.name;
    EXPECT_NO_THROW(parameter.assign(settings, value, "")) << parameter.info.name;
    EXPECT_EQ(parameter.get(settings), value) << parameter.info.name;
  }
}

}  // namespace
}  // namespace concave_distance::pair_parameters_test

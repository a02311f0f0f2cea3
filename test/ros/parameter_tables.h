#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "base/parameter.h"

namespace concave_distance::test {

/// A row of a Markdown table: name, default, values, meaning.
inline std::string tableRow(const ParameterInfo& info, const ParameterValue& value,
                            const std::string& prefix) {
  std::string shown = toText(value);
  const bool is_text = info.type == ParameterType::Text;
  const bool is_list = info.type == ParameterType::List;
  if (is_list) shown = "unset";
  if (is_text) shown = shown.empty() ? "\"\"" : "`" + shown + "`";
  if (info.type == ParameterType::Choice || shown == info.word) shown = "`" + shown + "`";
  std::string values = allowedValues(info);
  if (info.type == ParameterType::Choice) {
    values.clear();
    for (const std::string& one : info.choices) values += (values.empty() ? "`" : ", `") + one + "`";
  }
  if (info.type == ParameterType::Flag) values.clear();
  const std::string star = info.at_run_time ? "*" : "";
  const std::string of = info.models.empty() ? "" : "of " + modelsOf(info, "and", "`") + ": ";
  return "| `" + prefix + info.name + "`" + star + " | " + shown + " | " + values + " | " + of +
         info.sentence + " |\n";
}

template <typename Settings>
std::string tableRows(const ParameterTable<Settings>& table, bool is_expert, const std::string& prefix = "",
                      const Settings& defaults = {}) {
  std::string rows;
  for (const Parameter<Settings>& parameter : table) {
    if (parameter.info.is_expert != is_expert) continue;
    rows += tableRow(parameter.info, parameter.get(defaults), prefix);
  }
  return rows;
}

inline std::string tableHead() {
  return "| parameter | default | values | meaning |\n|---|---|---|---|\n";
}

inline std::string pathOf(const std::string& name) {
  return std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/" + name;
}

inline std::string readText(const std::string& name) {
  std::ifstream stream(pathOf(name));
  EXPECT_TRUE(stream.is_open()) << name;
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void expectText(const std::string& name, const std::string& before, const std::string& made) {
  if (std::getenv("CONCAVE_DISTANCE_WRITE_TABLES") != nullptr) {
    std::ofstream(pathOf(name)) << made;
  } else {
    EXPECT_EQ(before, made) << name << ": run scripts/build.sh tables";
  }
}

/// What stands between `<!-- table: <name> -->` and `<!-- end -->`.
inline void expectTable(const std::string& file, const std::string& name, const std::string& rows) {
  const std::string text = readText(file);
  const std::string begin = "<!-- table: " + name + " -->\n";
  const std::size_t from = text.find(begin);
  ASSERT_NE(from, std::string::npos) << file << " has no " << begin;
  const std::size_t to = text.find("<!-- end -->", from);
  ASSERT_NE(to, std::string::npos) << file << ": no end of " << begin;
  expectText(file, text, text.substr(0, from) + begin + tableHead() + rows + text.substr(to));
}

}  // namespace concave_distance::test

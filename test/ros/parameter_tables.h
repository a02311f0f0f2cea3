#pragma once

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

}  // namespace concave_distance::test

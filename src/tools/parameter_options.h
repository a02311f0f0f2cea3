#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

#include "base/parameter.h"
#include "option_names.h"

namespace concave_distance::tools {

/// Adds the parameter as an option that sets it. @param settings outlives `app`; its value is the default
/// @param name of the option, where it is not the parameter's
template <typename Settings>
CLI::Option* addParameter(CLI::App& app, const Parameter<Settings>& parameter, Settings& settings,
                          std::string name = "") {
  if (name.empty()) name = optionName(parameter.info.name);
  const auto assign = [&parameter, &settings, name](const std::string& text) {
    const ParameterValue value = parseParameter(parameter.info, text);
    if (!isAllowed(parameter.info, value)) {
      throw CLI::ValidationError(name, "'" + text + "' (allowed: " + allowedValues(parameter.info) + ")");
    }
    parameter.set(settings, value);
  };
  return app
      .add_option_function<std::string>(
          name, assign, withoutMarkdown(parameter.info.sentence) + " (" + allowedValues(parameter.info) + ")")
      ->default_str(toText(parameter.get(settings)))
      ->type_name("");
}

/// The same of the parameter with this name. @throws std::logic_error when the table has none
template <typename Settings>
CLI::Option* addParameter(CLI::App& app, const ParameterTable<Settings>& table, const std::string& parameter,
                          Settings& settings, std::string name = "") {
  const Parameter<Settings>* found = findParameter(table, parameter);
  if (found == nullptr) throw std::logic_error("no parameter " + parameter);
  return addParameter(app, *found, settings, std::move(name));
}

}  // namespace concave_distance::tools

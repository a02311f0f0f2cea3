#include "reconfiguration.h"

#include <dynamic_reconfigure/Config.h>

#include <algorithm>
#include <string>

#include "concave_distance/base/error.h"
#include "loading/settings_reader.h"
#include "node_parameter_table.h"
#include "scene/pair_parameters.h"

namespace concave_distance {
namespace {

using Message = dynamic_reconfigure::Config;

// Shown to clients as the end of a range without end.
constexpr double kHighestShown = 1e6;

Message messageOf(const ConcaveDistanceConfig& config) {
  Message message;
  config.__toMessage__(message);
  return message;
}

template <typename Values>
auto* findValue(Values& values, const std::string& name) {
  const auto found =
      std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.name == name; });
  return found == values.end() ? nullptr : &*found;
}

// Numbers that may be a word are texts.
ParameterValue valueIn(const Message& message, const ParameterInfo& info) {
  if (const auto* text = findValue(message.strs, info.name)) return parseParameter(info, text->value);
  if (const auto* number = findValue(message.doubles, info.name)) return double{number->value};
  if (const auto* flag = findValue(message.bools, info.name)) return flag->value != 0;
  if (const auto* count = findValue(message.ints, info.name)) {
    if (count->value >= 0) return static_cast<std::uint64_t>(count->value);
    return static_cast<double>(count->value);
  }
  throw Error(info.name, "dynamic_reconfigure does not know this parameter", "build the package again");
}

void setIn(Message& message, const ParameterInfo& info, const ParameterValue& value) {
  if (auto* text = findValue(message.strs, info.name)) text->value = toText(value);
  if (auto* number = findValue(message.doubles, info.name)) number->value = std::get<double>(value);
  if (auto* flag = findValue(message.bools, info.name)) flag->value = std::get<bool>(value) ? 1 : 0;
  if (auto* count = findValue(message.ints, info.name)) {
    count->value = static_cast<int>(std::get<std::uint64_t>(value));
  }
}

/// Calls visit(parameter) for each that may change while the node runs.
template <typename Settings, typename Visit>
void visitRunTime(const ParameterTable<Settings>& table, Visit&& visit) {
  for (const Parameter<Settings>& parameter : table) {
    if (parameter.info.at_run_time) visit(parameter);
  }
}

ParameterValue endOfRange(const ParameterInfo& info, bool highest) {
  if (info.type == ParameterType::Flag) return highest;
  if (!info.word.empty()) return info.word;
  const double end = highest ? std::min(info.highest, kHighestShown) : info.lowest;
  if (info.type == ParameterType::Count) return static_cast<std::uint64_t>(end);
  return end;
}

ConcaveDistanceConfig rangeEnd(bool highest) {
  Message message = messageOf(ConcaveDistanceConfig::__getDefault__());
  const auto set = [&](const auto& parameter) {
    setIn(message, parameter.info, endOfRange(parameter.info, highest));
  };
  visitRunTime(nodeParameterTable(), set);
  visitRunTime(pairParameters(), set);
  ConcaveDistanceConfig config = ConcaveDistanceConfig::__getDefault__();
  config.__fromMessage__(message);
  return config;
}

}  // namespace

ConcaveDistanceConfig toConfig(const NodeParameters& parameters) {
  Message message = messageOf(ConcaveDistanceConfig::__getDefault__());
  visitRunTime(nodeParameterTable(), [&](const Parameter<NodeParameters>& parameter) {
    setIn(message, parameter.info, parameter.get(parameters));
  });
  visitRunTime(pairParameters(), [&](const Parameter<PairSettings>& parameter) {
    setIn(message, parameter.info, parameter.get(parameters.pair));
  });
  ConcaveDistanceConfig config = ConcaveDistanceConfig::__getDefault__();
  config.__fromMessage__(message);
  return config;
}

void setCutoff(ConcaveDistanceConfig& config, double cutoff) {
  PairSettings settings;
  settings.tracker.cutoff = cutoff;
  const Parameter<PairSettings>& parameter = *findParameter(pairParameters(), "cutoff");
  Message message = messageOf(config);
  setIn(message, parameter.info, parameter.get(settings));
  config.__fromMessage__(message);
}

ConcaveDistanceConfig lowestConfig() {
  return rangeEnd(false);
}

ConcaveDistanceConfig highestConfig() {
  return rangeEnd(true);
}

void checkConfig(const ConcaveDistanceConfig& config) {
  const Message message = messageOf(config);
  const auto check = [&](const auto& parameter) {
    requireAllowed(parameter.info, valueIn(message, parameter.info), "~");
  };
  visitRunTime(nodeParameterTable(), check);
  visitRunTime(pairParameters(), check);
}

void applyChanges(const ConcaveDistanceConfig& before, const ConcaveDistanceConfig& after,
                  PairSettings& settings) {
  const Message was = messageOf(before);
  const Message is = messageOf(after);
  visitRunTime(pairParameters(), [&](const Parameter<PairSettings>& parameter) {
    const ParameterValue value = valueIn(is, parameter.info);
    if (value != valueIn(was, parameter.info)) parameter.assign(settings, value, "~");
  });
}

void applyChanges(const ConcaveDistanceConfig& before, const ConcaveDistanceConfig& after, Scene& scene) {
  if (!concernsPairs(before, after)) return;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    applyChanges(before, after, scene.pairs.edit(i).settings);
  }
  for (PairSettings& settings : scene.rules.settings) applyChanges(before, after, settings);
  applyChanges(before, after, scene.defaults.pairs);
}

void applyRequest(const ConcaveDistanceConfig& before, const ConcaveDistanceConfig& after,
                  PairSettings& settings) {
  applyChanges(before, after, settings);
  settings.tracker.validate("reconfigure");
  if (before.cutoff != after.cutoff) detail::validatePairSettings(settings, "reconfigure");
}

bool concernsPairs(const ConcaveDistanceConfig& before, const ConcaveDistanceConfig& after) {
  const Message was = messageOf(before);
  const Message is = messageOf(after);
  bool differs = false;
  visitRunTime(pairParameters(), [&](const Parameter<PairSettings>& parameter) {
    differs = differs || valueIn(is, parameter.info) != valueIn(was, parameter.info);
  });
  return differs;
}

}  // namespace concave_distance

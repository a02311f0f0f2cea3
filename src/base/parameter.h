#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "concave_distance/base/error.h"
#include "parameter_info.h"

namespace concave_distance {

/// A parameter of a struct of settings.
template <typename Settings>
struct Parameter {
  ParameterInfo info;
  std::function<ParameterValue(const Settings&)> get;
  std::function<void(Settings&, const ParameterValue&)> set;  ///< of an allowed value

  /// @throws Error naming `where` and the parameter, the value seen and what is allowed
  void assign(Settings& settings, const ParameterValue& value, const std::string& where) const {
    requireAllowed(info, value, where);
    set(settings, value);
  }

  Parameter& inUnit(std::string unit) {
    info.unit = std::move(unit);
    return *this;
  }
  Parameter& from(double lowest) {
    info.lowest = lowest;
    return *this;
  }
  Parameter& above(double lowest) {
    info.lowest = lowest;
    info.above_lowest = true;
    return *this;
  }
  Parameter& to(double highest) {
    info.highest = highest;
    return *this;
  }
  Parameter& below(double highest) {
    info.highest = highest;
    info.below_highest = true;
    return *this;
  }
  Parameter& even() {
    info.is_even = true;
    return *this;
  }
  Parameter& ofModels(std::vector<std::string> models) {
    info.models = std::move(models);
    return *this;
  }
  Parameter& atRunTime() {
    info.at_run_time = true;
    return *this;
  }
  Parameter& forExperts() {
    info.is_expert = true;
    return *this;
  }
};

template <typename Settings>
using ParameterTable = std::vector<Parameter<Settings>>;

namespace detail {

template <typename Settings>
Parameter<Settings> declared(std::string name, ParameterType type, std::string sentence) {
  Parameter<Settings> parameter;
  parameter.info.name = std::move(name);
  parameter.info.type = type;
  parameter.info.sentence = std::move(sentence);
  return parameter;
}

/// A number, or a word that stands for `meant`.
template <typename Settings, typename Member>
Parameter<Settings> numberOrWord(std::string name, const std::string& word, double meant, Member member,
                                 std::string sentence) {
  auto parameter = declared<Settings>(std::move(name), ParameterType::Number, std::move(sentence));
  parameter.info.word = word;
  parameter.get = [member, word, meant](const Settings& settings) -> ParameterValue {
    if (member(settings) == meant) return word;
    return member(settings);
  };
  parameter.set = [member, meant](Settings& settings, const ParameterValue& value) {
    const double* number = std::get_if<double>(&value);
    member(settings) = number == nullptr ? meant : *number;
  };
  return parameter;
}

/// A parameter whose value is stored as it is. @param Value what files and services give
template <typename Value, typename Settings, typename Member>
Parameter<Settings> stored(std::string name, ParameterType type, Member member, std::string sentence) {
  using Stored = std::decay_t<decltype(member(std::declval<Settings&>()))>;
  auto parameter = declared<Settings>(std::move(name), type, std::move(sentence));
  parameter.get = [member](const Settings& settings) {
    return ParameterValue(static_cast<Value>(member(settings)));
  };
  parameter.set = [member](Settings& settings, const ParameterValue& value) {
    member(settings) = static_cast<Stored>(std::get<Value>(value));
  };
  return parameter;
}

}  // namespace detail

/// A number. @param member generic: gives a reference to it, of settings and of constant settings
template <typename Settings, typename Member>
Parameter<Settings> number(std::string name, Member member, std::string sentence) {
  return detail::stored<double, Settings>(std::move(name), ParameterType::Number, member,
                                          std::move(sentence));
}

/// A number, or "none" for an infinite one.
template <typename Settings, typename Member>
Parameter<Settings> limit(std::string name, Member member, std::string sentence) {
  return detail::numberOrWord<Settings>(std::move(name), "none", std::numeric_limits<double>::infinity(),
                                        member, std::move(sentence));
}

/// A number, or the word for an empty one. @param member gives a std::optional<double>
template <typename Settings, typename Member>
Parameter<Settings> optionalNumber(std::string name, std::string word, Member member, std::string sentence) {
  auto parameter = detail::declared<Settings>(std::move(name), ParameterType::Number, std::move(sentence));
  parameter.info.word = word;
  parameter.get = [member, word](const Settings& settings) -> ParameterValue {
    if (!member(settings)) return word;
    return *member(settings);
  };
  parameter.set = [member](Settings& settings, const ParameterValue& value) {
    const double* number = std::get_if<double>(&value);
    if (number == nullptr) {
      member(settings).reset();
    } else {
      member(settings) = *number;
    }
  };
  return parameter;
}

/// A whole number.
template <typename Settings, typename Member>
Parameter<Settings> count(std::string name, Member member, std::string sentence) {
  using Integer = std::decay_t<decltype(member(std::declval<Settings&>()))>;
  auto parameter = detail::stored<std::uint64_t, Settings>(std::move(name), ParameterType::Count, member,
                                                           std::move(sentence));
  parameter.info.highest = static_cast<double>(std::numeric_limits<Integer>::max());
  return parameter;
}

/// true or false.
template <typename Settings, typename Member>
Parameter<Settings> flag(std::string name, Member member, std::string sentence) {
  return detail::stored<bool, Settings>(std::move(name), ParameterType::Flag, member, std::move(sentence));
}

/// One of several words. @param choices the word of each enumerator
template <typename Settings, typename Enum, typename Member>
Parameter<Settings> choice(std::string name, std::vector<std::pair<std::string, Enum>> choices, Member member,
                           std::string sentence) {
  auto parameter = detail::declared<Settings>(std::move(name), ParameterType::Choice, std::move(sentence));
  for (const auto& one : choices) parameter.info.choices.push_back(one.first);
  parameter.get = [member, choices](const Settings& settings) -> ParameterValue {
    for (const auto& [word, value] : choices) {
      if (value == member(settings)) return word;
    }
    return std::string();
  };
  parameter.set = [member, choices](Settings& settings, const ParameterValue& value) {
    for (const auto& [word, enumerator] : choices) {
      if (word == std::get<std::string>(value)) member(settings) = enumerator;
    }
  };
  return parameter;
}

/// A number, or a word where it is 0: chosen by the program.
template <typename Settings, typename Member>
Parameter<Settings> automatic(std::string name, Member member, std::string sentence,
                              const std::string& word = "auto") {
  auto parameter = detail::numberOrWord<Settings>(std::move(name), word, 0.0, member, std::move(sentence));
  parameter.info.above_lowest = true;
  return parameter;
}

/// Any text. @param allowed said of it in messages and documents, e.g. "a path"
template <typename Settings, typename Member>
Parameter<Settings> text(std::string name, std::string allowed, Member member, std::string sentence) {
  auto parameter = detail::stored<std::string, Settings>(std::move(name), ParameterType::Text, member,
                                                         std::move(sentence));
  parameter.info.word = std::move(allowed);
  return parameter;
}

/// A list of texts. @param member gives a std::optional<std::vector<std::string>>
template <typename Settings, typename Member>
Parameter<Settings> list(std::string name, std::string allowed, Member member, std::string sentence) {
  auto parameter = detail::declared<Settings>(std::move(name), ParameterType::List, std::move(sentence));
  parameter.info.word = std::move(allowed);
  parameter.get = [member](const Settings& settings) -> ParameterValue {
    return member(settings).value_or(std::vector<std::string>());
  };
  parameter.set = [member](Settings& settings, const ParameterValue& value) {
    member(settings) = std::get<std::vector<std::string>>(value);
  };
  return parameter;
}

/// The same parameter of a struct that holds the settings. @param member gives a reference to them
template <typename Whole, typename Settings, typename Member>
Parameter<Whole> partOf(const Parameter<Settings>& parameter, Member member) {
  Parameter<Whole> outer;
  outer.info = parameter.info;
  outer.get = [get = parameter.get, member](const Whole& whole) { return get(member(whole)); };
  outer.set = [set = parameter.set, member](Whole& whole, const ParameterValue& value) {
    set(member(whole), value);
  };
  return outer;
}

/// @throws Error naming `where` and the first parameter that has a value that is not allowed
template <typename Settings>
void requireAllowed(const ParameterTable<Settings>& table, const Settings& settings,
                    const std::string& where) {
  for (const Parameter<Settings>& parameter : table) {
    const ParameterValue value = parameter.get(settings);
    if (isAllowed(parameter.info, value)) continue;
    throw Error(where, parameter.info.name + " is " + toText(value),
                "allowed: " + allowedValues(parameter.info));
  }
}

template <typename Settings>
ParameterTable<Settings> joined(const std::vector<ParameterTable<Settings>>& tables) {
  ParameterTable<Settings> all;
  for (const ParameterTable<Settings>& table : tables) all.insert(all.end(), table.begin(), table.end());
  return all;
}

/// The parameter of this name, or null.
template <typename Settings>
const Parameter<Settings>* findParameter(const ParameterTable<Settings>& table, const std::string& name) {
  for (const Parameter<Settings>& parameter : table) {
    if (parameter.info.name == name) return &parameter;
  }
  return nullptr;
}

}  // namespace concave_distance

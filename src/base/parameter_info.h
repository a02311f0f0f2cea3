#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace concave_distance {

/// A parameter's value as files, services and command lines give it. A text is one of the parameter's choices
/// or its word.
using ParameterValue = std::variant<double, std::uint64_t, bool, std::string, std::vector<std::string>>;

enum class ParameterType : std::uint8_t { Number, Count, Flag, Choice, Text, List };

/// The declaration of a parameter: readers, messages and documents are made from it.
struct ParameterInfo {
  std::string name;
  ParameterType type = ParameterType::Number;
  std::string unit;     ///< of a number, e.g. "m"; empty: none
  double lowest = 0.0;  ///< of numbers and counts
  double highest = std::numeric_limits<double>::infinity();
  bool above_lowest = false;   ///< the lowest number itself is not allowed
  bool below_highest = false;  ///< nor is the highest
  bool is_even = false;        ///< of counts
  /// This word stands for "no number": "none" (no limit) or "auto" (chosen by the program); empty: there is
  /// none. A text or list says here what it has to be.
  std::string word;
  std::vector<std::string> choices;
  /// Words of the parameter `model` of the same table to which it belongs; empty: to every one.
  std::vector<std::string> models;
  std::string sentence;      ///< what it does; Markdown
  bool at_run_time = false;  ///< may change while the node runs
  bool is_expert = false;    ///< below `expert`
};

/// "greater than 0, m, or none": what a value may be, for messages and documents.
std::string allowedValues(const ParameterInfo& info);
/// The value as it would be written in a file.
std::string toText(const ParameterValue& value);
/// The value that a text means for this parameter; any other text is returned as it is and
/// refused by requireAllowed().
ParameterValue parseParameter(const ParameterInfo& info, const std::string& text);
bool isAllowed(const ParameterInfo& info, const ParameterValue& value);
/// Returns whether a parameter means something to a model.
bool belongsTo(const ParameterInfo& info, const std::string& model);
/// The models that it belongs to: "a", "a and b", "a, b and c". @param last between the last two, "and"
/// @param quote around each
std::string modelsOf(const ParameterInfo& info, const std::string& last, const std::string& quote = "");
/// @throws Error naming `where` and the parameter, the value seen and what is allowed
void requireAllowed(const ParameterInfo& info, const ParameterValue& value, const std::string& where);

}  // namespace concave_distance

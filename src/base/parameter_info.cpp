#include "parameter_info.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "concave_distance/base/error.h"
#include "number_text.h"

namespace concave_distance {
namespace {

constexpr double kPlainBelow = 1e6;  // whole numbers are written without an exponent

/// The shortest text that reads back as the same number.
std::string shortest(double value) {
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  if (std::isnan(value)) return "nan";
  if (value == std::floor(value) && std::fabs(value) < kPlainBelow) {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  std::string text;
  for (int count = 1; count <= 17; ++count) {
    text = numberText(value, count);
    if (parseNumber(text) == value) break;
  }
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos) {  // 1e+06 and 1e-06 are 1e6 and 1e-6
    std::size_t first = exponent + (text[exponent + 1] == '+' ? 1 : 2);
    if (text[exponent + 1] == '+') text.erase(first, 1);
    while (text[first] == '0') text.erase(first, 1);
  }
  return text;
}

std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

std::string rangeOf(const ParameterInfo& info) {
  const bool is_count = info.type == ParameterType::Count;
  const double widest = is_count ? static_cast<double>(std::numeric_limits<std::uint32_t>::max()) : 1e300;
  std::string text = is_count ? (info.is_even ? "an even number " : "a whole number ") : "";
  if (info.highest >= widest) {
    text += info.above_lowest ? "greater than " + shortest(info.lowest) : shortest(info.lowest) + " or more";
  } else if (info.above_lowest) {
    text += "greater than " + shortest(info.lowest) + ", at most " + shortest(info.highest);
  } else {
    text += "from " + shortest(info.lowest) + (info.below_highest ? " to below " : " to ") +
            shortest(info.highest);
  }
  return text;
}

bool isInRange(const ParameterInfo& info, double value) {
  return std::isfinite(value) && (info.below_highest ? value < info.highest : value <= info.highest) &&
         (info.above_lowest ? value > info.lowest : value >= info.lowest);
}

}  // namespace

std::string allowedValues(const ParameterInfo& info) {
  std::string text;
  switch (info.type) {
    case ParameterType::Flag:
      return "true, false";
    case ParameterType::Choice:
      for (const std::string& choice : info.choices) text += (text.empty() ? "" : ", ") + choice;
      return text;
    case ParameterType::Text:
    case ParameterType::List:
      return info.word;
    case ParameterType::Number:
    case ParameterType::Count:
      text = rangeOf(info);
  }
  if (!info.unit.empty()) text += " (" + info.unit + ")";
  if (!info.word.empty()) text += ", or " + info.word;
  return text;
}

bool belongsTo(const ParameterInfo& info, const std::string& model) {
  return info.models.empty() || std::find(info.models.begin(), info.models.end(), model) != info.models.end();
}

std::string modelsOf(const ParameterInfo& info, const std::string& last, const std::string& quote) {
  std::string text;
  for (std::size_t i = 0; i < info.models.size(); ++i) {
    if (i > 0) text += i + 1 < info.models.size() ? ", " : " " + last + " ";
    text += quote;
    text += info.models[i];
    text += quote;
  }
  return text;
}

std::string toText(const ParameterValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* count = std::get_if<std::uint64_t>(&value)) return std::to_string(*count);
  if (const auto* list = std::get_if<std::vector<std::string>>(&value)) {
    std::string text;
    for (const std::string& one : *list) text += (text.empty() ? "" : ", ") + one;
    return "[" + text + "]";
  }
  return shortest(std::get<double>(value));
}

bool isAllowed(const ParameterInfo& info, const ParameterValue& value) {
  if (info.type == ParameterType::Text) return std::holds_alternative<std::string>(value);
  if (info.type == ParameterType::List) return std::holds_alternative<std::vector<std::string>>(value);
  if (const auto* text = std::get_if<std::string>(&value)) {
    if (!info.word.empty() && *text == info.word) return true;
    return std::find(info.choices.begin(), info.choices.end(), *text) != info.choices.end();
  }
  switch (info.type) {
    case ParameterType::Number:
      return std::holds_alternative<double>(value) && isInRange(info, std::get<double>(value));
    case ParameterType::Count: {
      const auto* count = std::get_if<std::uint64_t>(&value);
      return count != nullptr && isInRange(info, static_cast<double>(*count)) &&
             !(info.is_even && *count % 2 != 0);
    }
    case ParameterType::Flag:
      return std::holds_alternative<bool>(value);
    case ParameterType::Choice:
    case ParameterType::Text:
    case ParameterType::List:
      return false;
  }
  return false;
}

ParameterValue parseParameter(const ParameterInfo& info, const std::string& text) {
  switch (info.type) {
    case ParameterType::Number: {
      const std::optional<double> value = parseNumber(text);
      return value ? ParameterValue(*value) : ParameterValue(text);
    }
    case ParameterType::Count: {
      std::uint64_t value = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      const bool is_count = error == std::errc() && end == text.data() + text.size();
      return is_count ? ParameterValue(value) : ParameterValue(text);
    }
    case ParameterType::Flag:
      if (text == "true" || text == "false") return text == "true";
      return text;
    case ParameterType::Choice:
    case ParameterType::Text:
    case ParameterType::List:
      return text;
  }
  return text;
}

void requireAllowed(const ParameterInfo& info, const ParameterValue& value, const std::string& where) {
  if (isAllowed(info, value)) return;
  const bool is_text = std::holds_alternative<std::string>(value);
  throw Error(where + info.name, "the value is " + (is_text ? quoted(toText(value)) : toText(value)),
              "allowed: " + allowedValues(info));
}

}  // namespace concave_distance

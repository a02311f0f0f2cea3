#include "parameter_reader.h"

#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

std::string shown(const XmlRpc::XmlRpcValue& value) {
  TextStream text;
  value.write(text);
  return text.str();
}

std::optional<ParameterValue> listOf(XmlRpc::XmlRpcValue& value) {
  std::vector<std::string> list;
  for (int i = 0; i < value.size(); ++i) {
    if (value[i].getType() != XmlRpc::XmlRpcValue::TypeString) {
      return std::nullopt;
    }
    list.push_back(static_cast<std::string>(value[i]));
  }
  return list;
}

// Nothing for a value of a type that no parameter has. A single text counts as a list of one. Of a number
// that may be a word, dynamic_reconfigure leaves the number as a text on the parameter server, too.
std::optional<ParameterValue> valueOf(XmlRpc::XmlRpcValue& value, const ParameterInfo& info) {
  const ParameterType type = info.type;
  const bool is_number = type == ParameterType::Number || type == ParameterType::Count;
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeDouble: {
      const double number = static_cast<double>(value);
      const bool is_count =
          type == ParameterType::Count && number >= 0.0 && number == std::floor(number) && number < 1e15;
      return is_count ? ParameterValue(static_cast<std::uint64_t>(number)) : ParameterValue(number);
    }
    case XmlRpc::XmlRpcValue::TypeInt: {
      const int number = static_cast<int>(value);
      const bool is_count = type == ParameterType::Count && number >= 0;
      return is_count ? ParameterValue(static_cast<std::uint64_t>(number))
                      : ParameterValue(static_cast<double>(number));
    }
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return ParameterValue(static_cast<bool>(value));
    case XmlRpc::XmlRpcValue::TypeString:
      if (type == ParameterType::List) return std::vector<std::string>{static_cast<std::string>(value)};
      if (is_number && !info.word.empty()) return parseParameter(info, static_cast<std::string>(value));
      return ParameterValue(static_cast<std::string>(value));
    case XmlRpc::XmlRpcValue::TypeArray:
      return type == ParameterType::List ? listOf(value) : std::nullopt;
    default:
      return std::nullopt;
  }
}

}  // namespace

ParameterReader::ParameterReader(XmlRpc::XmlRpcValue values, std::string prefix)
    : values_(std::move(values)), prefix_(std::move(prefix)) {
  if (values_.valid() && values_.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    throw Error(prefix_, "the value is " + shown(values_), "allowed: a namespace with parameters in it");
  }
}

bool ParameterReader::has(const std::string& name) {
  read_.insert(name);
  return values_.valid() && values_.hasMember(name);
}

std::optional<ParameterValue> ParameterReader::take(const ParameterInfo& info) {
  if (!has(info.name)) {
    return std::nullopt;
  }
  const std::optional<ParameterValue> value = valueOf(values_[info.name], info);
  if (!value || !isAllowed(info, *value)) {
    throw Error(prefix_ + info.name, "the value is " + shown(values_[info.name]),
                "allowed: " + allowedValues(info));
  }
  return value;
}

ParameterReader ParameterReader::group(const std::string& name) {
  return {has(name) ? values_[name] : XmlRpc::XmlRpcValue(), prefix_ + name + "/"};
}

void ParameterReader::adoptUnread(const ParameterReader& reader, const std::string& prefix) {
  for (const std::string& name : reader.unread({})) {
    unread_in_groups_.push_back(prefix + name);
  }
}

std::vector<std::string> ParameterReader::unread(const std::set<std::string>& known) const {
  std::vector<std::string> names = unread_in_groups_;
  if (!values_.valid()) {
    return names;
  }
  XmlRpc::XmlRpcValue values = values_;  // iterating needs a value that may be written to
  for (const auto& entry : values) {
    if (read_.count(entry.first) == 0 && known.count(entry.first) == 0) {
      names.push_back(entry.first);
    }
  }
  return names;
}

}  // namespace concave_distance

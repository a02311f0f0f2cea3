#include "concave_distance/ros/parameter_reader.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

std::string shown(const XmlRpc::XmlRpcValue& value) {
  std::ostringstream text;
  value.write(text);
  return text.str();
}

template <typename Number>
std::string rangeText(Number lowest, Number highest) {
  std::ostringstream text;
  text << "allowed: " << lowest << " to " << highest;
  return text.str();
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

double ParameterReader::number(const std::string& name, double fallback, double lowest, double highest) {
  if (!has(name)) {
    return fallback;
  }
  XmlRpc::XmlRpcValue& value = values_[name];
  double number = std::numeric_limits<double>::quiet_NaN();
  if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) {
    number = static_cast<double>(value);
  } else if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) {
    number = static_cast<int>(value);
  }
  if (!(number >= lowest && number <= highest)) {
    throw Error(prefix_ + name, "the value is " + shown(value), rangeText(lowest, highest));
  }
  return number;
}

std::uint32_t ParameterReader::count(const std::string& name, std::uint32_t fallback, std::uint32_t lowest,
                                     std::uint32_t highest) {
  const double value = number(name, fallback, lowest, highest);
  if (value != std::floor(value)) {
    throw Error(prefix_ + name, "the value is " + shown(values_[name]), "allowed: a whole number");
  }
  return static_cast<std::uint32_t>(value);
}

bool ParameterReader::flag(const std::string& name, bool fallback) {
  if (!has(name)) {
    return fallback;
  }
  XmlRpc::XmlRpcValue& value = values_[name];
  if (value.getType() != XmlRpc::XmlRpcValue::TypeBoolean) {
    throw Error(prefix_ + name, "the value is " + shown(value), "allowed: true, false");
  }
  return static_cast<bool>(value);
}

std::string ParameterReader::text(const std::string& name, const std::string& fallback) {
  if (!has(name)) {
    return fallback;
  }
  XmlRpc::XmlRpcValue& value = values_[name];
  if (value.getType() != XmlRpc::XmlRpcValue::TypeString) {
    throw Error(prefix_ + name, "the value is " + shown(value), "allowed: a text");
  }
  return static_cast<std::string>(value);
}

std::vector<std::string> ParameterReader::texts(const std::string& name) {
  std::vector<std::string> list;
  if (!has(name)) {
    return list;
  }
  XmlRpc::XmlRpcValue& value = values_[name];
  if (value.getType() == XmlRpc::XmlRpcValue::TypeString) {
    return {static_cast<std::string>(value)};
  }
  const auto refuse = [&] {
    throw Error(prefix_ + name, "the value is " + shown(value), "allowed: a list of texts");
  };
  if (value.getType() != XmlRpc::XmlRpcValue::TypeArray) {
    refuse();
  }
  for (int i = 0; i < value.size(); ++i) {
    if (value[i].getType() != XmlRpc::XmlRpcValue::TypeString) {
      refuse();
    }
    list.push_back(static_cast<std::string>(value[i]));
  }
  return list;
}

std::size_t ParameterReader::choice(const std::string& name, std::size_t fallback,
                                    const std::vector<std::string>& choices) {
  const std::string value = text(name, choices[fallback]);
  const auto found = std::find(choices.begin(), choices.end(), value);
  if (found == choices.end()) {
    std::string allowed = "allowed:";
    for (const std::string& one : choices) {
      allowed += " " + one;
    }
    throw Error(prefix_ + name, "the value is '" + value + "'", allowed);
  }
  return static_cast<std::size_t>(found - choices.begin());
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

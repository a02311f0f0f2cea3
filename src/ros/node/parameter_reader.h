#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/parameter.h"

namespace concave_distance {

/// Reads named values out of an XML-RPC struct; every refusal is an Error with the parameter's name, the
/// value seen and what is allowed. Remembers what was read, so that spelling mistakes can be reported.
class ParameterReader {
 public:
  /// @param values a struct; anything invalid (nothing set) counts as an empty one
  /// @param prefix put before names in messages, e.g. "~"
  ParameterReader(XmlRpc::XmlRpcValue values, std::string prefix);

  /// Sets what is given and leaves the rest.
  /// @param is_expert which parameters of the table: those for experts, or the others
  /// @throws Error naming the parameter, the value seen and what is allowed
  template <typename Settings>
  void read(const ParameterTable<Settings>& table, bool is_expert, Settings& settings) {
    for (const Parameter<Settings>& parameter : table) {
      if (parameter.info.is_expert != is_expert) continue;
      if (const auto value = take(parameter.info)) parameter.set(settings, *value);
    }
  }
  bool has(const std::string& name);

  /// The parameters of a namespace within this one; an empty reader when it is not set.
  ParameterReader group(const std::string& name);
  /// Adds the unread names of `reader` to those of this one. @param prefix put before them
  void adoptUnread(const ParameterReader& reader, const std::string& prefix);

  /// Names present that nobody asked for, `known` excepted.
  std::vector<std::string> unread(const std::set<std::string>& known) const;

 private:
  /// Nothing when it is not set.
  std::optional<ParameterValue> take(const ParameterInfo& info);

  XmlRpc::XmlRpcValue values_;
  std::string prefix_;
  std::set<std::string> read_;
  std::vector<std::string> unread_in_groups_;
};

}  // namespace concave_distance

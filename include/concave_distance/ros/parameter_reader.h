#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace concave_distance {

/// Reads named values out of an XML-RPC struct; every refusal is an Error with the parameter's name, the
/// value seen and what is allowed. Remembers what was read, so that spelling mistakes can be told.
class ParameterReader {
 public:
  /// @param values a struct; anything invalid (nothing set) counts as an empty one
  /// @param prefix put before names in messages, e.g. "~"
  ParameterReader(XmlRpc::XmlRpcValue values, std::string prefix);

  bool has(const std::string& name);
  /// Doubles; integers are accepted.
  double number(const std::string& name, double fallback, double lowest, double highest);
  std::uint32_t count(const std::string& name, std::uint32_t fallback, std::uint32_t lowest,
                      std::uint32_t highest);
  bool flag(const std::string& name, bool fallback);
  std::string text(const std::string& name, const std::string& fallback);
  /// A list of texts; a single text counts as a list of one. Empty when it is not set.
  std::vector<std::string> texts(const std::string& name);
  /// Index into `choices`.
  std::size_t choice(const std::string& name, std::size_t fallback, const std::vector<std::string>& choices);

  /// The parameters of a namespace within this one; an empty reader when it is not set.
  ParameterReader group(const std::string& name);
  /// Adds the unread names of `reader` to those of this one. @param prefix put before them
  void adoptUnread(const ParameterReader& reader, const std::string& prefix);

  /// Names present that nobody asked for, `known` excepted.
  std::vector<std::string> unread(const std::set<std::string>& known) const;

 private:
  XmlRpc::XmlRpcValue values_;
  std::string prefix_;
  std::set<std::string> read_;
  std::vector<std::string> unread_in_groups_;
};

}  // namespace concave_distance

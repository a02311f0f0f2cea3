#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace concave_distance::detail {

/// A value of a YAML text that knows its place, so that an error can name it.
class YamlValue {
 public:
  /// Parses one document. @throws Error with file and line when it is none
  static YamlValue parse(const std::string& yaml, const std::string& file);

  /// "file:line, key.of[3].value"
  std::string where() const;
  /// The value as the text has it, shortened; for messages.
  std::string seen() const;
  /// @throws Error(where, "<what>", remedy), always
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;
  /// @throws Error("... is <seen>", "allowed: <allowed>"), always
  [[noreturn]] void refuse(const std::string& allowed) const;

  bool isScalar() const { return node_.IsScalar(); }
  bool isList() const { return node_.IsSequence(); }
  bool isMap() const { return node_.IsMap(); }
  bool isText(const char* text) const;
  /// The text of a scalar; empty where it is quoted or none.
  std::string plainText() const;

  /// A number, plain and finite or infinite (.inf); quoted ones are texts. @throws Error if it is none
  double number(const std::string& allowed) const;
  /// A number that the predicate accepts. @throws Error saying what is allowed
  template <typename Predicate>
  double number(const std::string& allowed, const Predicate& accepts) const {
    const double value = number(allowed);
    if (!accepts(value)) refuse(allowed);
    return value;
  }
  /// A whole number in [least, most].
  std::uint64_t count(std::uint64_t least, std::uint64_t most, const std::string& remark = "") const;
  bool boolean() const;
  /// A text that is not empty.
  std::string text() const;
  /// One of the names of a table.
  template <typename Enum, std::size_t N>
  Enum choice(const std::pair<const char*, Enum> (&table)[N]) const {
    std::string allowed;
    for (const auto& [name, value] : table) {
      if (isText(name)) return value;
      allowed += (allowed.empty() ? "" : ", ") + std::string(name);
    }
    refuse(allowed);
  }
  /// Finite numbers, as many as asked for.
  std::vector<double> numbers(std::size_t size, const std::string& allowed) const;
  Eigen::Vector3d vector3(const std::string& allowed) const;
  /// The elements of a list; each is named by its number, from 0.
  std::vector<YamlValue> list(const std::string& allowed) const;

 private:
  friend class YamlMap;
  YamlValue(const YAML::Node& node, int line, std::string key, std::shared_ptr<const std::string> file)
      : node_(node), line_(line), key_(std::move(key)), file_(std::move(file)) {}

  YAML::Node node_;
  int line_;  ///< from 1
  std::string key_;
  std::shared_ptr<const std::string> file_;
};

/// A map whose keys are asked for one by one; what nobody asked for is refused at the end.
class YamlMap {
 public:
  /// @throws Error when the value is no map, a key is no text or stands twice
  YamlMap(const YamlValue& value, const std::string& expected);
  const YamlValue& value() const { return value_; }

  /// Returns the value of a key; nothing when it is missing.
  std::optional<YamlValue> take(const std::string& key);
  YamlValue require(const std::string& key, const std::string& remedy);
  /// Returns what stands in the map, in its order; for maps whose keys are names.
  const std::vector<std::pair<std::string, YamlValue>>& entries() const { return entries_; }
  /// @throws Error naming the first key that nobody took, and all that somebody asked for
  void finish() const;

 private:
  YamlValue value_;
  std::vector<std::pair<std::string, YamlValue>> entries_;
  std::unordered_map<std::string, std::size_t> index_;  ///< into entries_
  std::vector<std::string> asked_;
};

}  // namespace concave_distance::detail

#include "yaml_value.h"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <system_error>

#include "base/number_text.h"
#include "concave_distance/base/error.h"

namespace concave_distance::detail {
namespace {

constexpr std::size_t kLongestSeen = 60;
// A document may have this many values; 20,000 boxes and 50,000 pairs take 650,000.
constexpr std::size_t kMostValues = 1'000'000;

// yaml-cpp gives an empty value the place of what follows; the key's own line serves better.
int lineOf(const YAML::Node& node, int line_of_key) {
  return node.IsNull() || node.Mark().is_null() ? line_of_key : node.Mark().line + 1;
}

std::optional<double> numberOf(const std::string& text) {
  if (text == ".inf" || text == "+.inf" || text == ".Inf" || text == ".INF") {
    return std::numeric_limits<double>::infinity();
  }
  if (text == "-.inf" || text == "-.Inf" || text == "-.INF") {
    return -std::numeric_limits<double>::infinity();
  }
  const std::optional<double> value = parseNumber(text);
  // "inf" and "nan" without the dot are texts in YAML.
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// A document has more values than are allowed.
struct TooManyValues {};

// Counts values without keeping them: a node of yaml-cpp takes half a kilobyte.
class ValueCounter : public YAML::EventHandler {
 public:
  using Mark = YAML::Mark;
  using Anchor = YAML::anchor_t;
  using Style = YAML::EmitterStyle::value;
  std::size_t count() const { return count_; }

  void OnDocumentStart(const Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const Mark& /*mark*/, Anchor /*anchor*/) override {}
  void OnAlias(const Mark& /*mark*/, Anchor /*anchor*/) override { add(); }
  void OnScalar(const Mark& /*mark*/, const std::string& /*tag*/, Anchor /*anchor*/,
                const std::string& /*value*/) override {
    add();
  }
  void OnSequenceStart(const Mark& /*mark*/, const std::string& /*tag*/, Anchor /*anchor*/,
                       Style /*style*/) override {
    add();
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const Mark& /*mark*/, const std::string& /*tag*/, Anchor /*anchor*/,
                  Style /*style*/) override {
    add();
  }
  void OnMapEnd() override {}

 private:
  void add() {
    if (++count_ > kMostValues) throw TooManyValues();
  }
  std::size_t count_ = 0;
};

// 0, 1, or 2 for more; stops at an empty one, because YAML::LoadAll never returns from the text ",".
// @throws YAML::Exception when it is no YAML, TooManyValues
std::size_t countDocuments(const std::string& yaml) {
  std::istringstream stream(yaml);
  YAML::Parser parser(stream);
  std::size_t count = 0;
  for (ValueCounter counter; count < 2 && parser.HandleNextDocument(counter) && counter.count() > 0;
       counter = ValueCounter()) {
    ++count;
  }
  return count;
}

}  // namespace

YamlValue YamlValue::parse(const std::string& yaml, const std::string& file) {
  std::size_t documents = 0;
  YAML::Node root;
  try {
    documents = countDocuments(yaml);
    if (documents > 0) root = YAML::Load(yaml);
  } catch (const TooManyValues&) {
    throw Error(file, "more than " + std::to_string(kMostValues) + " values", "leave out what is not needed");
  } catch (const YAML::Exception& exception) {
    throw Error(file + ":" + std::to_string(exception.mark.line + 1), "no YAML: " + exception.msg,
                "mend the syntax");
  }
  if (documents > 1) throw Error(file, "2 YAML documents or more", "one is expected");
  const int line = lineOf(root, 1);
  return YamlValue(root, line, "", std::make_shared<const std::string>(file));
}

std::string YamlValue::where() const {
  return *file_ + ":" + std::to_string(line_) + (key_.empty() ? "" : ", " + key_);
}

std::string YamlValue::seen() const {
  if (!node_.IsDefined() || node_.IsNull()) return "empty";
  if (node_.IsScalar()) {
    std::string text = node_.Scalar();
    if (text.size() > kLongestSeen) text = text.substr(0, kLongestSeen) + "...";
    return "'" + text + "'" + (node_.Tag() == "!" ? " (quoted, so a text)" : "");
  }
  return (node_.IsSequence() ? "a list of " : "a map of ") + std::to_string(node_.size());
}

void YamlValue::fail(const std::string& what, const std::string& remedy) const {
  throw Error(where(), what, remedy);
}

void YamlValue::refuse(const std::string& allowed) const {
  fail("the value is " + seen(), "allowed: " + allowed);
}

bool YamlValue::isText(const char* text) const {
  return node_.IsScalar() && node_.Scalar() == text;
}

std::string YamlValue::plainText() const {
  return node_.IsScalar() && node_.Tag() != "!" ? node_.Scalar() : std::string();
}

double YamlValue::number(const std::string& allowed) const {
  if (!node_.IsScalar() || node_.Tag() == "!" || node_.Scalar().empty()) refuse(allowed);
  const std::optional<double> value = numberOf(node_.Scalar());
  if (!value) refuse(allowed);
  return *value;
}

std::uint64_t YamlValue::count(std::uint64_t least, std::uint64_t most, const std::string& remark) const {
  const std::string allowed =
      "a whole number from " + std::to_string(least) +
      (most == std::numeric_limits<std::uint64_t>::max() ? "" : " to " + std::to_string(most)) +
      (remark.empty() ? "" : ", " + remark);
  if (!node_.IsScalar() || node_.Tag() == "!") refuse(allowed);
  const std::string& text = node_.Scalar();
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > most) {
    refuse(allowed);
  }
  return value;
}

bool YamlValue::boolean() const {
  bool value = false;
  if (!node_.IsScalar() || node_.Tag() == "!" || !YAML::convert<bool>::decode(node_, value)) {
    refuse("true or false");
  }
  return value;
}

std::string YamlValue::text() const {
  if (!node_.IsScalar() || node_.Scalar().empty()) refuse("a text");
  return node_.Scalar();
}

std::vector<double> YamlValue::numbers(std::size_t size, const std::string& allowed) const {
  if (!isList() || node_.size() != size) refuse(allowed);
  std::vector<double> values;
  for (const YamlValue& element : list(allowed)) {
    values.push_back(element.number("a finite number", [](double v) { return std::isfinite(v); }));
  }
  return values;
}

Eigen::Vector3d YamlValue::vector3(const std::string& allowed) const {
  const std::vector<double> values = numbers(3, allowed);
  return {values[0], values[1], values[2]};
}

std::vector<YamlValue> YamlValue::list(const std::string& allowed) const {
  if (!isList()) refuse(allowed);
  std::vector<YamlValue> elements;
  for (const YAML::Node& element : node_) {
    const std::string key = key_ + "[" + std::to_string(elements.size()) + "]";
    elements.push_back(YamlValue(element, lineOf(element, line_), key, file_));
  }
  return elements;
}

YamlMap::YamlMap(const YamlValue& value, const std::string& expected) : value_(value) {
  if (!value.isMap()) value.refuse(expected);
  for (const auto& entry : value.node_) {
    const int line = lineOf(entry.first, value.line_);
    if (!entry.first.IsScalar()) {
      throw Error(*value.file_ + ":" + std::to_string(line), "a key that is no text", "write key: value");
    }
    const std::string& key = entry.first.Scalar();
    const std::string path = value.key_.empty() ? key : value.key_ + "." + key;
    YamlValue child(entry.second, lineOf(entry.second, line), path, value.file_);
    const auto [same, is_new] = index_.emplace(key, entries_.size());
    if (!is_new) {
      child.line_ = line;
      child.fail("the key stands twice, first in line " + std::to_string(entries_[same->second].second.line_),
                 "remove one of them");
    }
    entries_.emplace_back(key, std::move(child));
  }
}

std::optional<YamlValue> YamlMap::take(const std::string& key) {
  asked_.push_back(key);
  const auto found = index_.find(key);
  if (found == index_.end()) return std::nullopt;
  return entries_[found->second].second;
}

YamlValue YamlMap::require(const std::string& key, const std::string& remedy) {
  std::optional<YamlValue> value = take(key);
  if (!value) value_.fail("'" + key + "' is missing", remedy);
  return *value;
}

void YamlMap::finish() const {
  for (const auto& [name, value] : entries_) {
    if (std::find(asked_.begin(), asked_.end(), name) == asked_.end()) {
      value.fail("key '" + name + "' is not known", "allowed: " + joinedText(asked_, ", "));
    }
  }
}

}  // namespace concave_distance::detail

#include "yaml_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/ascii.h"
#include "base/number_text.h"
#include "base/parameter_info.h"

namespace concave_distance::detail {
namespace {

bool isPlain(const std::string& text) {
  if (text.empty() || !(isLetter(text.front()) || text.front() == '_')) return false;
  const auto allowed = [](char c) {
    return isLetterOrDigit(c) || c == '_' || c == '/' || c == '.' || c == '-';
  };
  if (!std::all_of(text.begin(), text.end(), allowed)) return false;
  std::string lower = text;
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  const std::array<const char*, 9> words = {"true", "false", "yes", "no", "on", "off", "null", "y", "n"};
  return std::find(words.begin(), words.end(), lower) == words.end();
}

std::string listOf(const std::vector<std::string>& texts) {
  return "[" + joinedText(texts, ", ") + "]";
}

}  // namespace

std::string yamlNumber(double value) {
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  return concave_distance::toText(ParameterValue(value));
}

std::string yamlNumbers(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(yamlNumber(value));
  return listOf(texts);
}

std::string yamlText(const std::string& text) {
  if (isPlain(text)) return text;
  const char* digits = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quoted += '\\';
    if (code < 0x20 || code == 0x7f) {
      quoted += std::string("\\x") + digits[code / 16] + digits[code % 16];
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string yamlTexts(const std::vector<std::string>& texts) {
  std::vector<std::string> written;
  for (const std::string& text : texts) written.push_back(yamlText(text));
  return listOf(written);
}

std::string yamlPose(const Eigen::Isometry3d& pose) {
  YamlItems items;
  const Eigen::Vector3d at = pose.translation();
  items.add("xyz", yamlNumbers({at.x(), at.y(), at.z()}));
  const Eigen::Matrix3d turn = pose.linear();
  const Eigen::Quaterniond q(turn);
  if (q.normalized().toRotationMatrix() == turn) {
    if (turn != Eigen::Matrix3d::Identity())
      items.add("quaternion", yamlNumbers({q.x(), q.y(), q.z(), q.w()}));
  } else {
    std::vector<double> rows;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) rows.push_back(turn(row, column));
    }
    items.add("rotation", yamlNumbers(rows));
  }
  return items.flow();
}

std::string YamlItems::flow() const {
  return "{" + joinedText(items_, ", ") + "}";
}

}  // namespace concave_distance::detail

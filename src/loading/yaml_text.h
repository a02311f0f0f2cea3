#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace concave_distance::detail {

/// Values as YAML has them: each reads back as it was, numbers to the last bit.

std::string yamlNumber(double value);
/// A list of numbers in one line.
std::string yamlNumbers(const std::vector<double>& values);
/// A text, quoted where YAML would take it for something else.
std::string yamlText(const std::string& text);
/// A list of texts in one line.
std::string yamlTexts(const std::vector<std::string>& texts);
/// A map of xyz, and of quaternion or rotation where the pose turns: the quaternion where it gives the same
/// matrix.
std::string yamlPose(const Eigen::Isometry3d& pose);

/// Writes `key: value` items as a map in one line.
class YamlItems {
 public:
  void add(const std::string& key, const std::string& value) { items_.push_back(key + ": " + value); }
  /// "{a: 1, b: 2}"
  std::string flow() const;

 private:
  std::vector<std::string> items_;
};

}  // namespace concave_distance::detail

#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace concave_distance {

/// The one exception type of this package, thrown by loading and configuration only; a solve never throws.
class Error : public std::runtime_error {
 public:
  /// @param where file, parameter key or element the problem was found in
  /// @param what_is_wrong the problem, with the value seen
  /// @param remedy what the user can do about it
  Error(std::string where, std::string what_is_wrong, std::string remedy)
      : std::runtime_error(withoutNul(where + ": " + what_is_wrong + " (" + remedy + ")")),
        where_(std::move(where)),
        what_is_wrong_(std::move(what_is_wrong)),
        remedy_(std::move(remedy)) {}

  const std::string& where() const { return where_; }
  const std::string& whatIsWrong() const { return what_is_wrong_; }
  const std::string& remedy() const { return remedy_; }

 private:
  // what() would end at the first one, and names in requests may have some.
  static std::string withoutNul(std::string text) {
    std::replace(text.begin(), text.end(), '\0', '?');
    return text;
  }

  std::string where_;
  std::string what_is_wrong_;
  std::string remedy_;
};

}  // namespace concave_distance

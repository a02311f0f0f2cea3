#pragma once

#include <string>
#include <string_view>

namespace concave_distance {

/// Returns why a text cannot be the id of a tf frame (without a leading slash): it is empty, longer than 255
/// bytes, begins with a slash or contains a control character. Returns an empty text when it can.
std::string tfFrameProblem(std::string_view frame);

/// `/base` in tf is `base` in tf2.
std::string withoutLeadingSlash(const std::string& frame);

/// The same for a frame named by a user: blanks are errors, too.
std::string frameNameProblem(std::string_view frame);

/// The frame named by a user, without a leading slash. @throws Error when the name is not valid
std::string requireFrameName(const std::string& frame, const std::string& where);

}  // namespace concave_distance

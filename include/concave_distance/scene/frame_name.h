#pragma once

#include <string>
#include <string_view>

namespace concave_distance {

/// What keeps a text from being the id of a tf frame, as tf2 can look it up (without a leading slash): it is
/// empty, longer than 255 bytes, begins with a slash or holds a control character. Empty: nothing does.
std::string tfFrameProblem(std::string_view frame);

/// `/base` of the first tf is tf2's `base`.
std::string withoutLeadingSlash(const std::string& frame);

/// The same for a frame that a user names: blanks count as mistakes, too.
std::string frameNameProblem(std::string_view frame);

/// The frame that a user has named, without a leading slash. @throws Error when there can be none
std::string requireFrameName(const std::string& frame, const std::string& where);

}  // namespace concave_distance

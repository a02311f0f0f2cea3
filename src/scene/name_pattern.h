#pragma once

#include <string>

namespace concave_distance::detail {

/// True when the text has one of the characters * ? [ that make it a pattern.
bool isPattern(const std::string& text);

/// Shell pattern against a whole name: * any characters (also /), ? one, [a-c] one of these.
/// @throws Error naming `where` for a pattern so long that matching it takes too long
void requirePatternLength(const std::string& pattern, const std::string& where);
bool matchesPattern(const std::string& pattern, const std::string& name);

}  // namespace concave_distance::detail

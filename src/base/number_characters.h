#pragma once

#include <charconv>

namespace concave_distance {

/// Writes at most `digits` significant digits, as %g does, and returns where they end. The room must suffice.
char* writeGeneral(char* first, char* last, double value, int digits);
/// Writes `decimals` digits after the point, as %f does, and returns where they end. The room must suffice.
char* writeFixed(char* first, char* last, double value, int decimals);
/// Reads a number as std::from_chars does, whatever the locale.
std::from_chars_result readCharacters(const char* first, const char* last, double& value);

namespace detail {

/// Does it by the C library in its own locale, for standard libraries that have no <charconv> for doubles
/// (that of GCC before 11).
char* writeGeneralByC(char* first, char* last, double value, int digits);
char* writeFixedByC(char* first, char* last, double value, int decimals);
std::from_chars_result readCharactersByC(const char* first, const char* last, double& value);

}  // namespace detail
}  // namespace concave_distance

#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace concave_distance {

/// Numbers as text and back. A host program may have set any locale, for C or for C++: nothing here depends
/// on it, and nothing outside may write or read numbers in a way that does (test/architecture).

/// A stream for messages. Whole numbers have no separators, others a point and six digits.
class TextStream : public std::ostringstream {
 public:
  TextStream();
};

/// Writes at most this many significant digits, as %g does: 1.5, 1e-07, inf, nan.
std::string numberText(double value, int digits = 6);
/// Writes this many digits after the point, as %f does.
std::string fixedText(double value, int decimals);
/// The number that all of a text stands for: digits with a point, an exponent, inf or nan. One that is too
/// small for a double is 0. Nothing for any other text, also for a number too large for a double or a
/// hexadecimal one.
std::optional<double> parseNumber(std::string_view text);

/// Returns the texts with the separator between each two.
std::string joinedText(const std::vector<std::string>& texts, std::string_view separator);

}  // namespace concave_distance

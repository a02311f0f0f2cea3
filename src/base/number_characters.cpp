#include "number_characters.h"

#include <locale.h>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace concave_distance {
namespace {

locale_t plainLocale() {
  static const locale_t locale = ::newlocale(LC_ALL_MASK, "C", nullptr);
  return locale;
}

char* writeByC(char* first, char* last, const char* format, int precision, double value) {
  const locale_t before = ::uselocale(plainLocale());
  const int length = std::snprintf(first, static_cast<std::size_t>(last - first), format, precision, value);
  ::uselocale(before);
  return first + length;
}

constexpr bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t countDigits(std::string_view text) {
  std::size_t count = 0;
  while (count < text.size() && isDigit(text[count])) ++count;
  return count;
}

bool beginsWith(std::string_view text, std::string_view lower) {
  if (text.size() < lower.size()) return false;
  for (std::size_t i = 0; i < lower.size(); ++i) {
    if ((text[i] | 0x20) != lower[i]) return false;
  }
  return true;
}

/// Returns how many characters of inf, infinity, nan or nan(...) the text begins with.
std::size_t lengthOfWord(std::string_view text) {
  if (beginsWith(text, "infinity")) return 8;
  if (beginsWith(text, "inf")) return 3;
  if (!beginsWith(text, "nan")) return 0;
  if (text.size() < 4 || text[3] != '(') return 3;
  const std::size_t end =
      text.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_", 4);
  return end != std::string_view::npos && text[end] == ')' ? end + 1 : 3;
}

/// Returns how many characters of a decimal number the text begins with: digits, a point, an exponent.
std::size_t lengthOfDecimal(std::string_view text) {
  std::size_t length = countDigits(text);
  std::size_t digits = length;
  if (length < text.size() && text[length] == '.') {
    const std::size_t decimals = countDigits(text.substr(length + 1));
    digits += decimals;
    length += 1 + decimals;
  }
  if (digits == 0) return 0;
  if (length < text.size() && (text[length] | 0x20) == 'e') {
    std::size_t sign = 0;
    if (length + 1 < text.size() && (text[length + 1] == '+' || text[length + 1] == '-')) sign = 1;
    const std::size_t exponent = countDigits(text.substr(length + 1 + sign));
    if (exponent > 0) length += 1 + sign + exponent;
  }
  return length;
}

bool hasOtherDigitThanZero(std::string_view number) {
  return number.substr(0, number.find_first_of("eE")).find_first_of("123456789") != std::string_view::npos;
}

}  // namespace

namespace detail {

char* writeGeneralByC(char* first, char* last, double value, int digits) {
  return writeByC(first, last, "%.*g", digits, value);
}

char* writeFixedByC(char* first, char* last, double value, int decimals) {
  return writeByC(first, last, "%.*f", decimals, value);
}

std::from_chars_result readCharactersByC(const char* first, const char* last, double& value) {
  const std::string_view text(first, static_cast<std::size_t>(last - first));
  const std::size_t sign = !text.empty() && text.front() == '-' ? 1 : 0;
  const std::size_t word = lengthOfWord(text.substr(sign));
  const std::size_t length = word > 0 ? word : lengthOfDecimal(text.substr(sign));
  if (length == 0) return {first, std::errc::invalid_argument};
  const std::string number(text.substr(0, sign + length));
  const double read = ::strtod_l(number.c_str(), nullptr, plainLocale());
  const char* end = first + number.size();
  const bool is_out_of_range =
      word == 0 && (std::isinf(read) || (read == 0.0 && hasOtherDigitThanZero(number)));
  if (is_out_of_range) return {end, std::errc::result_out_of_range};
  value = read;
  return {end, std::errc()};
}

}  // namespace detail

#if defined(__cpp_lib_to_chars)

char* writeGeneral(char* first, char* last, double value, int digits) {
  return std::to_chars(first, last, value, std::chars_format::general, digits).ptr;
}

char* writeFixed(char* first, char* last, double value, int decimals) {
  return std::to_chars(first, last, value, std::chars_format::fixed, decimals).ptr;
}

std::from_chars_result readCharacters(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}

#else

char* writeGeneral(char* first, char* last, double value, int digits) {
  return detail::writeGeneralByC(first, last, value, digits);
}

char* writeFixed(char* first, char* last, double value, int decimals) {
  return detail::writeFixedByC(first, last, value, decimals);
}

std::from_chars_result readCharacters(const char* first, const char* last, double& value) {
  return detail::readCharactersByC(first, last, value);
}

#endif

}  // namespace concave_distance

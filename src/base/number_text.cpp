#include "number_text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <locale>
#include <system_error>

#include "number_characters.h"

namespace concave_distance {
namespace {

template <typename Write>
std::string written(double value, int precision, Write write) {
  // 309 digits before the point, a sign, a point and what stands after it.
  std::string text(320U + static_cast<std::size_t>(precision), '\0');
  const char* end = write(text.data(), text.data() + text.size(), value, precision);
  text.resize(static_cast<std::size_t>(end - text.data()));
  return text;
}

/// Tells a decimal number that is too small for a double, below 1, from one that is too large.
bool isBelowOne(std::string_view text) {
  const std::size_t end = std::min(text.find_first_of("eE"), text.size());
  const std::string_view digits = text.substr(0, end);
  const std::size_t first = digits.find_first_of("123456789");
  if (first == std::string_view::npos) return true;
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const auto power =
      static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first) - (first < point ? 1 : 0);
  std::string_view exponent = text.substr(std::min(end + 1, text.size()));
  const bool is_negative = !exponent.empty() && exponent.front() == '-';
  if (!exponent.empty() && exponent.front() == '+') exponent.remove_prefix(1);
  std::int32_t value = 0;
  const auto read = std::from_chars(exponent.data(), exponent.data() + exponent.size(), value);
  if (read.ec == std::errc::result_out_of_range) return is_negative;
  return power + value < 0;
}

}  // namespace

TextStream::TextStream() {
  imbue(std::locale::classic());
}

std::string numberText(double value, int digits) {
  return written(value, digits, writeGeneral);
}

std::string fixedText(double value, int decimals) {
  return written(value, decimals, writeFixed);
}

std::optional<double> parseNumber(std::string_view text) {
  // readCharacters reads no plus sign.
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  if (has_plus) text.remove_prefix(1);
  const char* last = text.data() + text.size();
  double value = 0.0;
  const auto [end, error] = readCharacters(text.data(), last, value);
  if (end != last) return std::nullopt;
  if (error == std::errc::result_out_of_range && isBelowOne(text)) return 0.0;
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

std::string joinedText(const std::vector<std::string>& texts, std::string_view separator) {
  std::string joined;
  for (const std::string& text : texts) joined.append(joined.empty() ? "" : separator).append(text);
  return joined;
}

}  // namespace concave_distance

#include "number_text.h"

#include <charconv>
#include <limits>
#include <locale>
#include <system_error>

namespace concave_distance {
namespace {

std::string written(double value, std::chars_format format, int precision) {
  // 309 digits before the point, a sign, a point and what stands after it.
  std::string text(320U + static_cast<std::size_t>(precision), '\0');
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, precision).ptr;
  text.resize(static_cast<std::size_t>(end - text.data()));
  return text;
}

}  // namespace

TextStream::TextStream() {
  imbue(std::locale::classic());
}

std::string numberText(double value, int digits) {
  return written(value, std::chars_format::general, digits);
}

std::string fixedText(double value, int decimals) {
  return written(value, std::chars_format::fixed, decimals);
}

std::optional<double> parseNumber(std::string_view text) {
  // from_chars reads no plus sign.
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  if (has_plus) text.remove_prefix(1);
  const char* last = text.data() + text.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

}  // namespace concave_distance

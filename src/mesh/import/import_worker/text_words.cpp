#include "text_words.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace concave_distance::detail {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";
constexpr std::string_view kEndsOfWord = " \t\v\f\r\n";
constexpr std::string_view kEndsOfLine = "\r\n";

std::string_view withoutPlus(std::string_view word) {
  // from_chars reads no plus sign.
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

void TextWords::passBlanks() {
  at_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
}

std::string_view TextWords::wordInLine() {
  passBlanks();
  const std::size_t end = std::min(text_.find_first_of(kEndsOfWord, at_), text_.size());
  const std::string_view found = text_.substr(at_, end - at_);
  at_ = end;
  return found;
}

std::string_view TextWords::word() {
  for (;;) {
    const std::string_view found = wordInLine();
    if (!found.empty() || at_ == text_.size()) return found;
    line();
  }
}

std::string_view TextWords::line() {
  const std::size_t end = std::min(text_.find_first_of(kEndsOfLine, at_), text_.size());
  const std::string_view found = text_.substr(at_, end - at_);
  at_ = end;
  if (at_ == text_.size()) return found;
  at_ += text_.compare(at_, 2, "\r\n") == 0 ? 2 : 1;
  ++line_number_;
  return found;
}

bool parseWhole(std::string_view word, std::int64_t& value) {
  const std::string_view digits = withoutPlus(word);
  const char* last = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  return error == std::errc() && end == last;
}

bool equalsInAnyCase(std::string_view text, std::string_view lower) {
  return text.size() == lower.size() &&
         std::equal(text.begin(), text.end(), lower.begin(), [](char a, char b) {
           return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
         });
}

std::string inQuotes(std::string_view text) {
  std::string shown(text.substr(0, 40));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "'" + shown + "'";
}

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.substr(0, kMark.size()) == kMark) text.remove_prefix(kMark.size());
  return text;
}

bool isPadding(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.find_first_not_of(" \t\r\n\v\f\0\x1a\xff"sv) == std::string_view::npos;
}

}  // namespace concave_distance::detail

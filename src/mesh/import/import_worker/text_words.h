#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace concave_distance::detail {

/// The remedy for a file that is broken.
inline constexpr const char* kExportAgain = "export the mesh again";

/// Reads words from the front of a text and counts its lines, which end with \n, \r\n or \r. Every call takes
/// time linear in what it passes over, and no memory.
class TextWords {
 public:
  explicit TextWords(std::string_view text) : text_(text) {}

  /// Returns the next word, on this line or a later one. Empty at the end of the text.
  std::string_view word();
  /// The next word of this line. Empty at its end.
  std::string_view wordInLine();
  /// Returns what is left of this line; afterwards the next line begins.
  std::string_view line();

  /// Number of the line that the next character is in, from 1.
  std::uint64_t lineNumber() const { return line_number_; }
  std::string_view rest() const { return text_.substr(at_); }

 private:
  void passBlanks();

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint64_t line_number_ = 1;
};

/// Reads a word that is a whole number, in the same way in every locale. False when it is none or too large.
bool parseWhole(std::string_view word, std::int64_t& value);

/// Compares ASCII letters in any case; `lower` is in lower case.
bool equalsInAnyCase(std::string_view text, std::string_view lower);
/// The text in quotes for an error: at most 40 characters, none of them invisible.
std::string inQuotes(std::string_view text);

/// The text without the byte order mark of UTF-8.
std::string_view withoutByteOrderMark(std::string_view text);
/// True for blanks, zeros and other bytes with which writers fill a file up.
bool isPadding(std::string_view bytes);

}  // namespace concave_distance::detail

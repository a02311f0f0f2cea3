#include "name_pattern.h"

#include <fnmatch.h>

#include <clocale>
#include <cstddef>

#include "concave_distance/base/error.h"

namespace concave_distance::detail {
namespace {

// Ten times the longest name of a pair: the time to match grows with the product of both lengths.
constexpr std::size_t kLongestPattern = 4096;

// fnmatch() reads characters and their order from the thread's locale, which is the host program's; a locale
// of its own for the call leaves other threads alone.
class PlainLocale {
 public:
  PlainLocale() : before_(::uselocale(plain())) {}
  ~PlainLocale() { ::uselocale(before_); }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

 private:
  static locale_t plain() {
    static const locale_t made = ::newlocale(LC_ALL_MASK, "C", nullptr);
    return made;
  }
  locale_t before_;
};

}  // namespace

bool isPattern(const std::string& text) {
  return text.find_first_of("*?[") != std::string::npos;
}

void requirePatternLength(const std::string& pattern, const std::string& where) {
  if (pattern.size() > kLongestPattern) {
    throw Error(where, "the name or pattern has " + std::to_string(pattern.size()) + " characters",
                "allowed: at most " + std::to_string(kLongestPattern));
  }
}

bool matchesPattern(const std::string& pattern, const std::string& name) {
  const PlainLocale locale;
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

}  // namespace concave_distance::detail

#include "log_throttle.h"

#include <cstdio>

#include "ascii.h"

namespace concave_distance {
namespace {

constexpr std::chrono::seconds kBetweenSame(5);
constexpr std::chrono::seconds kBetweenAny(1);
constexpr std::size_t kMostSubjects = 1000;
constexpr std::size_t kLongestText = 80;

}  // namespace

bool LogThrottle::isDue(const std::string& subject) {
  const Time now = std::chrono::steady_clock::now();
  if (last_ != Time::min() && now - last_ < kBetweenAny) return false;
  const auto known = last_of_subject_.find(subject);
  if (known != last_of_subject_.end() && now - known->second < kBetweenSame) return false;
  if (last_of_subject_.size() >= kMostSubjects) last_of_subject_.clear();
  last_ = last_of_subject_[subject] = now;
  return true;
}

std::string printable(const std::string& text) {
  std::string result;
  for (const char c : text.substr(0, kLongestText)) {
    if (!isControl(c)) {
      result += c;
      continue;
    }
    char code[5];
    std::snprintf(code, sizeof(code), "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    result += code;
  }
  return text.size() > kLongestText ? result + "..." : result;
}

}  // namespace concave_distance

#include "concave_distance/scene/body_set.h"

#include <algorithm>

namespace concave_distance {

BodySet::BodySet(const std::vector<std::size_t>& bodies) {
  for (const std::size_t body : bodies) insert(body);
}

BodySet BodySet::before(std::size_t end) {
  BodySet set;
  set.words_.assign(end / kBits, ~std::uint64_t{0});
  if (end % kBits != 0) set.words_.push_back((std::uint64_t{1} << (end % kBits)) - 1);
  return set;
}

BodySet BodySet::marked(const std::vector<bool>& bodies) {
  BodySet set;
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (bodies[body]) set.insert(body);
  }
  return set;
}

std::vector<std::size_t> BodySet::indices() const {
  std::vector<std::size_t> bodies;
  for (std::size_t body = 0; body < kBits * words_.size(); ++body) {
    if (contains(body)) bodies.push_back(body);
  }
  return bodies;
}

std::size_t BodySet::size() const {
  std::size_t size = 0;
  for (const std::uint64_t word : words_) size += static_cast<std::size_t>(__builtin_popcountll(word));
  return size;
}

std::size_t BodySet::first() const {
  std::size_t body = 0;
  while (words_[body / kBits] == 0) body += kBits;
  while (!contains(body)) ++body;
  return body;
}

std::size_t BodySet::last() const {
  std::size_t body = kBits * words_.size() - 1;
  while (!contains(body)) --body;
  return body;
}

bool BodySet::isWithin(const BodySet& other) const {
  for (std::size_t i = 0; i < words_.size(); ++i) {
    if ((words_[i] & ~other.word(i)) != 0) return false;
  }
  return true;
}

void BodySet::insert(std::size_t body) {
  if (body / kBits >= words_.size()) words_.resize(body / kBits + 1, 0);
  words_[body / kBits] |= std::uint64_t{1} << (body % kBits);
}

void BodySet::takeOut(const std::vector<bool>& gone) {
  for (std::size_t body = gone.size(); body-- > 0;) {
    if (gone[body]) erase(body);
  }
  trim();
}

// Moves the bits behind this one down by one.
void BodySet::erase(std::size_t body) {
  std::size_t i = body / kBits;
  if (i >= words_.size()) return;
  const std::uint64_t below = (std::uint64_t{1} << (body % kBits)) - 1;
  words_[i] = (words_[i] & below) | (words_[i] >> 1U & ~below);
  for (++i; i < words_.size(); ++i) {
    words_[i - 1] |= words_[i] << (kBits - 1);
    words_[i] >>= 1U;
  }
}

void BodySet::keepBefore(std::size_t end) {
  if (end / kBits >= words_.size()) return;
  words_.resize(end / kBits + 1);
  words_.back() &= (std::uint64_t{1} << (end % kBits)) - 1;
  trim();
}

void BodySet::trim() {
  while (!words_.empty() && words_.back() == 0) words_.pop_back();
}

BodySet& BodySet::operator&=(const BodySet& other) {
  words_.resize(std::min(words_.size(), other.words_.size()));
  for (std::size_t i = 0; i < words_.size(); ++i) words_[i] &= other.words_[i];
  trim();
  return *this;
}

BodySet& BodySet::operator|=(const BodySet& other) {
  words_.resize(std::max(words_.size(), other.words_.size()), 0);
  for (std::size_t i = 0; i < other.words_.size(); ++i) words_[i] |= other.words_[i];
  return *this;
}

BodySet& BodySet::operator-=(const BodySet& other) {
  const std::size_t common = std::min(words_.size(), other.words_.size());
  for (std::size_t i = 0; i < common; ++i) words_[i] &= ~other.words_[i];
  trim();
  return *this;
}

}  // namespace concave_distance

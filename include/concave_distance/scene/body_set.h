#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace concave_distance {

/// A set of bodies by their index in Scene::bodies.
class BodySet {
 public:
  BodySet() = default;
  explicit BodySet(const std::vector<std::size_t>& bodies);
  /// Returns the set of all bodies before this index.
  static BodySet before(std::size_t end);
  /// Returns those that are marked, one entry for each body.
  static BodySet marked(const std::vector<bool>& bodies);

  bool contains(std::size_t body) const {
    return body / kBits < words_.size() && (words_[body / kBits] >> (body % kBits) & 1U) != 0;
  }
  bool empty() const { return words_.empty(); }
  std::size_t size() const;
  /// Returns the lowest index; the set must not be empty.
  std::size_t first() const;
  /// Returns the highest index; the set must not be empty.
  std::size_t last() const;
  /// Returns the indices in ascending order.
  std::vector<std::size_t> indices() const;
  bool isWithin(const BodySet& other) const;

  void insert(std::size_t body);
  /// Takes out the bodies from this index on.
  void keepBefore(std::size_t end);
  /// Follows bodies that leave the scene: those behind them get lower indices.
  void takeOut(const std::vector<bool>& gone);

  BodySet& operator&=(const BodySet& other);
  BodySet& operator|=(const BodySet& other);
  BodySet& operator-=(const BodySet& other);
  friend BodySet operator&(BodySet l, const BodySet& r) { return l &= r; }
  friend BodySet operator|(BodySet l, const BodySet& r) { return l |= r; }
  friend BodySet operator-(BodySet l, const BodySet& r) { return l -= r; }
  friend bool operator==(const BodySet& l, const BodySet& r) { return l.words_ == r.words_; }

 private:
  static constexpr std::size_t kBits = 64;
  std::uint64_t word(std::size_t i) const { return i < words_.size() ? words_[i] : 0; }
  void erase(std::size_t body);
  void trim();

  std::vector<std::uint64_t> words_;  ///< the last one is not 0
};

}  // namespace concave_distance

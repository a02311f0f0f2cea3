#pragma once

#include <algorithm>
#include <limits>

#include "certificate.h"

namespace concave_distance::detail {

/// Holds the pairs of boxes that a proof has still to open. Under a time limit the least bound comes first,
/// so that the proven bound rises as fast as it can; without one a stack does, which costs less.
class OpenPairs {
 public:
  using OpenPair = CertificateWorkspace::OpenPair;
  using Slot = BoundingVolumeHierarchy::Slot;

  /// `buffer` keeps its size from proof to proof, so that it is rarely grown.
  OpenPairs(std::vector<OpenPair>& buffer, WorkLimit& limit)
      : pairs_(buffer), limit_(limit), timed_(limit.isTimed()) {}

  bool isEmpty() const { return count_ == 0; }
  void clear() { count_ = 0; }

  /// Begins with the pair of the roots. `separation` (metres) is how far apart the bodies are at least.
  void begin(double separation) {
    if (pairs_.empty()) pairs_.resize(BoundingVolumeHierarchy::kWidth);
    // If the proof may be cut short, this bound is certain at once.
    const double certain = timed_ ? std::max(0.0, separation) : 0.0;
    pairs_[0] = {BoundingVolumeHierarchy::kRoot, BoundingVolumeHierarchy::kRoot, certain * certain};
    count_ = 1;
  }

  /// Returns false when the limit admits no more pairs.
  bool add(Slot a, Slot b, double squared_bound) {
    if (pairs_.size() == count_) {
      const std::size_t grown = 2 * pairs_.size() + 256;
      if (!limit_.admits(grown)) return false;
      pairs_.resize(grown);
    }
    // Field by field: a pair put together on the stack first would stall the store buffer.
    OpenPair& pair = pairs_[count_++];
    pair.a = a;
    pair.b = b;
    pair.squared_bound = squared_bound;
    if (timed_) std::push_heap(pairs_.begin(), end(), isFarther);
    return true;
  }

  /// Takes the next pair out; there must be one.
  OpenPair take() {
    if (timed_) std::pop_heap(pairs_.begin(), end(), isFarther);
    return pairs_[--count_];
  }

  /// Returns the least squared bound of all pairs; infinite without any.
  double leastSquaredBound() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) least = std::min(least, pairs_[i].squared_bound);
    return least;
  }

 private:
  static bool isFarther(const OpenPair& l, const OpenPair& r) { return l.squared_bound > r.squared_bound; }
  std::vector<OpenPair>::iterator end() const { return pairs_.begin() + static_cast<std::ptrdiff_t>(count_); }

  std::vector<OpenPair>& pairs_;  ///< the first count_ of it
  WorkLimit& limit_;
  const bool timed_;
  std::size_t count_ = 0;
};

}  // namespace concave_distance::detail

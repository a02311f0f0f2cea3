#pragma once

#include <cstddef>
#include <vector>

#include "sweep_lists.h"

namespace concave_distance::detail {

/// Cuts a long list of pairs into slices that idle threads work on as well. What a slice leaves depends on
/// its pairs alone, and the slices are put together in their order: the answer is the same for any number of
/// threads.
class ConeSlices {
 public:
  static constexpr std::size_t kCount = 16;  ///< that are looked at together
  /// From this length on a list takes longer than it takes to wake a thread (doc/results/cores.csv).
  static constexpr std::size_t kManyExpired = 8192;
  static constexpr std::size_t kManyOpen = 128;
  static constexpr std::size_t kMostKept = 1024;  ///< by a slice

  /// A slice has a fixed size: its sweep ends when its lists are full.
  struct Slice {
    SweepLists lists;
    ExpiredPairs expired{};
  };

  /// Allocates the slices when they are first needed.
  void prepare();

  /// Fills slices with the first pairs of a list. @return how many pairs
  std::size_t takeExpired(const SlotPair* first, std::size_t count);
  /// Fills slices with the last pairs of a list and removes them there.
  void takeOpen(std::vector<SlotPair>& open);

  std::size_t used() const { return used_; }
  Slice& operator[](std::size_t i) { return slices_[i]; }

 private:
  std::vector<Slice> slices_;
  std::size_t used_ = 0;
};

}  // namespace concave_distance::detail

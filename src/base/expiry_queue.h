#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "concave_distance/base/work_limit.h"

namespace concave_distance {

/// Finds which of many entries have expired, each when a counter that never falls has reached its expiry,
/// without looking at the others: a radix heap for each counter (Ahuja, Mehlhorn, Orlin and Tarjan 1990). An
/// entry is moved at most once for each bit by which its expiry differs from its counter. All queues share
/// one pool of chunks.
template <typename Key>
class ExpiryQueues {
 public:
  /// Forgets all entries; every counter begins at 0.
  void begin(std::size_t counter_count) {
    queues_.assign(counter_count, {});
    chunks_.clear();
    free_ = kEnd;
    size_ = 0;
  }

  std::size_t size() const { return size_; }

  /// @param expiry above the counter
  /// @return false when the limit admits no more entries
  bool insert(std::uint32_t counter, std::uint64_t expiry, const Key& key, WorkLimit& limit) {
    if (!limit.admits(size_ + 1)) return false;
    put(queues_[counter], {expiry, key});
    ++size_;
    return true;
  }

  /// Raises a counter and takes out every entry whose expiry it has reached.
  /// @param expired (key) may not insert for this counter
  template <typename Expired>
  void advance(std::uint32_t counter, std::uint64_t to, const Expired& expired) {
    Queue& queue = queues_[counter];
    if (to <= queue.now) return;
    const std::uint64_t highest = highestBit(to ^ queue.now);
    queue.now = to;
    const std::uint64_t passed = queue.occupied & (highest - 1);
    const bool is_mixed = (queue.occupied & highest) != 0;
    queue.occupied &= ~(passed | highest);
    for (std::uint64_t rest = passed; rest != 0; rest &= rest - 1) {
      takeOut(queue.heads[bucketOf(rest & -rest)], [&](const Entry& entry) { report(entry, expired); });
    }
    if (!is_mixed) return;
    takeOut(queue.heads[bucketOf(highest)], [&](const Entry& entry) {
      if (entry.expiry <= to) {
        report(entry, expired);
      } else {
        put(queue, entry);
      }
    });
  }

  /// Calls visit(key) for every entry.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (const Queue& queue : queues_) {
      for (std::uint64_t rest = queue.occupied; rest != 0; rest &= rest - 1) {
        std::uint32_t index = queue.heads[bucketOf(rest & -rest)];
        for (; index != kEnd; index = chunks_[index].next) {
          for (std::uint32_t k = 0; k < chunks_[index].count; ++k) visit(chunks_[index].entries[k].key);
        }
      }
    }
  }

 private:
  static constexpr std::uint32_t kEnd = 0xffffffffU;

  struct Entry {
    std::uint64_t expiry;
    Key key;
  };
  /// A chunk fills two cache lines when keys have 8 bytes.
  struct Chunk {
    std::uint32_t next;
    std::uint32_t count;
    std::array<Entry, 7> entries;
  };
  /// A bucket holds what differs from the counter in one bit and below it.
  struct Queue {
    std::uint64_t now = 0;
    std::uint64_t occupied = 0;  ///< bits of the buckets that hold something
    std::array<std::uint32_t, 64> heads;
  };

  static std::uint64_t highestBit(std::uint64_t value) {
    return std::uint64_t{1} << (63U - static_cast<std::uint32_t>(__builtin_clzll(value)));
  }
  static std::size_t bucketOf(std::uint64_t bit) { return static_cast<std::size_t>(__builtin_ctzll(bit)); }

  template <typename Expired>
  void report(const Entry& entry, const Expired& expired) {
    --size_;
    expired(entry.key);
  }

  void put(Queue& queue, const Entry& entry) {
    const std::uint64_t bit = highestBit(entry.expiry ^ queue.now);
    std::uint32_t& head = queue.heads[bucketOf(bit)];
    if ((queue.occupied & bit) == 0) head = kEnd;
    if (head == kEnd || chunks_[head].count == chunks_[head].entries.size()) {
      std::uint32_t index = free_;
      if (index != kEnd) {
        free_ = chunks_[index].next;
      } else {
        index = static_cast<std::uint32_t>(chunks_.size());
        chunks_.emplace_back();
      }
      chunks_[index].next = head;
      chunks_[index].count = 0;
      head = index;
      queue.occupied |= bit;
    }
    Chunk& chunk = chunks_[head];
    chunk.entries[chunk.count++] = entry;
  }

  /// Frees the chunks of a bucket as it goes.
  template <typename Visit>
  void takeOut(std::uint32_t index, const Visit& visit) {
    while (index != kEnd) {
      const Chunk chunk = chunks_[index];
      chunks_[index].next = free_;
      free_ = index;
      for (std::uint32_t k = 0; k < chunk.count; ++k) visit(chunk.entries[k]);
      index = chunk.next;
    }
  }

  std::vector<Queue> queues_;
  std::vector<Chunk> chunks_;
  std::uint32_t free_ = kEnd;  ///< first of the chain of free chunks
  std::size_t size_ = 0;
};

}  // namespace concave_distance

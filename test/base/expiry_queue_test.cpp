#include "base/expiry_queue.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random_engine.h"

namespace concave_distance {
namespace {

struct Entry {
  std::uint64_t expiry;
  std::uint32_t next;
};

TEST(ExpiryQueue, TakesOutWhatTheClockHasReachedAndNothingElse) {
  RandomEngine engine(5);
  std::vector<Entry> pool;
  std::vector<bool> is_in;
  ExpiryQueue<Entry> queue;
  std::uint64_t clock = 0;
  for (int round = 0; round < 2000; ++round) {
    for (int k = 0; k < 5; ++k) {
      const std::uint64_t ahead = std::uint64_t{1} << uniformIndex(engine, 40);
      pool.push_back(
          {clock + 1 +
               uniformIndex(engine, static_cast<std::uint32_t>(std::min<std::uint64_t>(ahead, 1U << 31U))),
           0});
      is_in.push_back(true);
      queue.insert(pool, static_cast<std::uint32_t>(pool.size() - 1));
    }
    clock += uniformIndex(engine, std::uint32_t{1} << uniformIndex(engine, 24));
    queue.advance(pool, clock, [&](std::uint32_t index) {
      EXPECT_TRUE(is_in[index]);
      EXPECT_LE(pool[index].expiry, clock);
      is_in[index] = false;
    });
    EXPECT_EQ(queue.clock(), clock);
    for (std::size_t i = 0; i < pool.size(); ++i) ASSERT_EQ(is_in[i], pool[i].expiry > clock) << i;
  }
}

TEST(ExpiryQueue, KeepsTheLargestExpiryAndForgetsAllWhenCleared) {
  std::vector<Entry> pool{{~std::uint64_t{0}, 0}, {1, 0}};
  ExpiryQueue<Entry> queue;
  queue.insert(pool, 0);
  queue.insert(pool, 1);
  std::vector<std::uint32_t> expired;
  const auto take = [&](std::uint32_t index) { expired.push_back(index); };
  queue.advance(pool, std::uint64_t{1} << 62U, take);
  EXPECT_EQ(expired, std::vector<std::uint32_t>{1});
  queue.clear();
  queue.advance(pool, ~std::uint64_t{0}, take);
  EXPECT_EQ(expired.size(), 1U);
}

}  // namespace
}  // namespace concave_distance

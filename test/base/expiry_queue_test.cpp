#include "base/expiry_queue.h"

#include <gtest/gtest.h>

#include "base/random_engine.h"

namespace concave_distance::expiry_queue_test {
namespace {

TEST(ExpiryQueues, TakeOutWhatTheirCounterHasReachedAndNothingElse) {
  constexpr std::uint32_t kCounters = 3;
  struct Inserted {
    std::uint32_t counter;
    std::uint64_t expiry;
    bool is_in;
  };
  RandomEngine engine(5);
  WorkLimit none;
  ExpiryQueues<std::uint64_t> queues;
  queues.begin(kCounters);
  std::vector<Inserted> all;
  std::uint64_t now[kCounters] = {};
  for (int round = 0; round < 3000; ++round) {
    const std::uint32_t counter = uniformIndex(engine, kCounters);
    for (int k = 0; k < 5; ++k) {
      const std::uint64_t ahead = std::uint64_t{1} << uniformIndex(engine, 32);
      const std::uint64_t expiry = now[counter] + 1 + uniformIndex(engine, static_cast<std::uint32_t>(ahead));
      ASSERT_TRUE(queues.insert(counter, expiry, all.size(), none));
      all.push_back({counter, expiry, true});
    }
    now[counter] += uniformIndex(engine, std::uint32_t{1} << uniformIndex(engine, 24));
    queues.advance(counter, now[counter], [&](std::uint64_t key) {
      EXPECT_TRUE(all[key].is_in);
      EXPECT_EQ(all[key].counter, counter);
      all[key].is_in = false;
    });
    std::size_t count = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      ASSERT_EQ(all[i].is_in, all[i].expiry > now[all[i].counter]) << i;
      count += all[i].is_in ? 1 : 0;
    }
    ASSERT_EQ(queues.size(), count);
  }
  std::vector<bool> seen(all.size(), false);
  queues.forEach([&](std::uint64_t key) {
    EXPECT_FALSE(seen[key]);
    seen[key] = true;
  });
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(seen[i], all[i].is_in);
}

TEST(ExpiryQueues, KeepTheLargestExpiryAndForgetAllWhenBegunAnew) {
  WorkLimit none;
  ExpiryQueues<std::uint64_t> queues;
  queues.begin(1);
  queues.insert(0, ~std::uint64_t{0}, 10, none);
  queues.insert(0, 1, 11, none);
  std::vector<std::uint64_t> expired;
  const auto take = [&](std::uint64_t key) { expired.push_back(key); };
  queues.advance(0, std::uint64_t{1} << 62U, take);
  EXPECT_EQ(expired, std::vector<std::uint64_t>{11});
  queues.begin(1);
  queues.advance(0, ~std::uint64_t{0}, take);
  EXPECT_EQ(expired.size(), 1U);
}

TEST(ExpiryQueues, HoldAsManyEntriesAsTheLimitAdmits) {
  ExpiryQueues<std::uint64_t> queues;
  queues.begin(2);
  WorkLimit limit(WorkLimit::Clock::now(), 1e12, 100, nullptr);
  for (std::uint64_t key = 0; key < 100; ++key)
    ASSERT_TRUE(queues.insert(key % 2, 1 + 17 * key, key, limit)) << key;
  EXPECT_FALSE(limit.hasRefused());
  EXPECT_FALSE(queues.insert(0, 5, 100, limit));
  EXPECT_TRUE(limit.hasRefusedPairs());
  EXPECT_EQ(queues.size(), 100U);
  queues.advance(0, 1, [](std::uint64_t key) { EXPECT_EQ(key, 0U); });
  EXPECT_TRUE(queues.insert(0, 5, 100, limit)) << "one has gone";
}

}  // namespace
}  // namespace concave_distance::expiry_queue_test

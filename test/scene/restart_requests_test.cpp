#include "scene/restart_requests.h"

#include <gtest/gtest.h>

#include <string>

namespace concave_distance::restart_requests_test {
namespace {

TEST(RestartRequests, KeepEachPairOnceHoweverOftenItIsAskedFor) {
  RestartRequests requests;
  for (int i = 0; i < 1000; ++i) {
    requests.request("arm/table");
    requests.request("arm/shelf");
  }
  const RestartRequests::Pending pending = requests.take();
  EXPECT_EQ(pending.pairs.size(), 2U);
  EXPECT_FALSE(pending.all);
  EXPECT_TRUE(requests.take().pairs.empty()) << "what was taken is done";
}

TEST(RestartRequests, ForgetSinglePairsWhenAllAreAskedFor) {
  RestartRequests requests;
  requests.request("arm/table");
  requests.requestAll();
  requests.request("arm/shelf");
  const RestartRequests::Pending pending = requests.take();
  EXPECT_TRUE(pending.all);
  EXPECT_TRUE(pending.pairs.empty());
}

TEST(RestartRequests, OfEverMorePairsAreOneForAll) {
  RestartRequests requests;
  for (int i = 0; i < 20'000; ++i) requests.request("arm/box_" + std::to_string(i));
  const RestartRequests::Pending pending = requests.take();
  EXPECT_TRUE(pending.all);
  EXPECT_TRUE(pending.pairs.empty());
}

}  // namespace
}  // namespace concave_distance::restart_requests_test

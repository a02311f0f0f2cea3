#include "base/request_gate.h"

#include <gtest/gtest.h>

#include <future>
#include <string>

#include "concave_distance/base/error.h"

namespace concave_distance::request_gate_test {
namespace {

constexpr double kLong = 600.0;  // s

// Enters, says so, and stays until it is let go.
class Request {
 public:
  // The promises are there before the thread that uses them: outcome_ is the last member.
  explicit Request(RequestGate& gate)
      : outcome_(std::async(std::launch::async, [this, &gate]() -> std::string {
          try {
            const RequestGate::Place place = gate.enter();
            entered_.set_value();
            let_go_.get_future().wait();
            return "done";
          } catch (const Error& refusal) {
            return refusal.what();
          }
        })) {}
  void waitUntilIn() { entered_.get_future().wait(); }
  void letGo() { let_go_.set_value(); }
  std::string outcome() { return outcome_.get(); }

 private:
  std::promise<void> entered_;
  std::promise<void> let_go_;
  std::future<std::string> outcome_;
};

TEST(RequestGate, RefusesAtOnceWhatNobodyCanWaitFor) {
  RequestGate gate(1, 0, kLong);
  Request first(gate);
  first.waitUntilIn();
  Request second(gate);
  EXPECT_EQ(second.outcome().find("SERVICE BUSY"), 0U);
  first.letGo();
  EXPECT_EQ(first.outcome(), "done");
  Request third(gate);
  third.letGo();
  EXPECT_EQ(third.outcome(), "done") << "there is room again";
}

TEST(RequestGate, LetsWaitersInOneByOne) {
  RequestGate gate(1, 2, kLong);
  Request first(gate);
  first.waitUntilIn();
  Request second(gate);
  Request third(gate);
  first.letGo();
  EXPECT_EQ(first.outcome(), "done");
  second.letGo();
  third.letGo();
  EXPECT_EQ(second.outcome(), "done");
  EXPECT_EQ(third.outcome(), "done");
}

TEST(RequestGate, RefusesWhoHasWaitedTooLongAndLetsTheOthersIn) {
  RequestGate gate(1, 2, 0.05);
  Request first(gate);
  first.waitUntilIn();
  Request second(gate);
  EXPECT_NE(second.outcome().find("no thread became free"), std::string::npos);
  first.letGo();
  EXPECT_EQ(first.outcome(), "done");
  Request third(gate);
  third.letGo();
  EXPECT_EQ(third.outcome(), "done") << "nobody stands in line any more";
}

TEST(RequestGate, StoppingRefusesThoseWhoWaitOrComeAndSaysSoToThoseWhoWork) {
  RequestGate gate(1, 1, kLong);
  Request first(gate);
  first.waitUntilIn();
  EXPECT_FALSE(gate.stopped());
  Request waiting(gate);
  gate.stop();
  EXPECT_TRUE(gate.stopped());
  EXPECT_NE(waiting.outcome().find("shutting down"), std::string::npos);
  Request late(gate);
  EXPECT_NE(late.outcome().find("shutting down"), std::string::npos);
  first.letGo();
  EXPECT_EQ(first.outcome(), "done");
}

}  // namespace
}  // namespace concave_distance::request_gate_test

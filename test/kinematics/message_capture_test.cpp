#include "kinematics/message_capture.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace concave_distance::message_capture_test {
namespace {

using detail::MessageCapture;

struct KeepingHandler : console_bridge::OutputHandler {
  void log(const std::string& text, console_bridge::LogLevel, const char*, int) override {
    texts.push_back(text);
  }
  std::vector<std::string> texts;
};

/// A handler of the process, as a node has one, put back at the end.
class MessageCaptureTest : public ::testing::Test {
 protected:
  MessageCaptureTest() : before(console_bridge::getOutputHandler()) {
    console_bridge::useOutputHandler(&handler);
  }
  ~MessageCaptureTest() override {
    // Twice, so that console_bridge remembers no handler of a test.
    console_bridge::useOutputHandler(before);
    console_bridge::useOutputHandler(before);
  }
  console_bridge::OutputHandler* before;
  KeepingHandler handler;
};

TEST_F(MessageCaptureTest, KeepsWarningsAndErrorsOfItsThread) {
  const MessageCapture capture;
  CONSOLE_BRIDGE_logWarn("a warning");
  CONSOLE_BRIDGE_logError("an error");
  CONSOLE_BRIDGE_logInform("chatter");
  EXPECT_EQ(capture.messages(), (std::vector<std::string>{"a warning", "an error"}));
  EXPECT_TRUE(handler.texts.empty());
}

TEST_F(MessageCaptureTest, LetsOtherThreadsSpeakToTheHandlerThatWasThere) {
  const MessageCapture capture;
  std::thread other([] { CONSOLE_BRIDGE_logError("from another thread"); });
  other.join();
  EXPECT_TRUE(capture.messages().empty());
  EXPECT_EQ(handler.texts, std::vector<std::string>{"from another thread"});
}

TEST_F(MessageCaptureTest, PutsHandlerAndLevelBack) {
  console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);
  {
    const MessageCapture capture;
    CONSOLE_BRIDGE_logError("heard although the process wants silence");
    EXPECT_EQ(capture.messages().size(), 1U);
  }
  EXPECT_EQ(console_bridge::getOutputHandler(), &handler);
  EXPECT_EQ(console_bridge::getLogLevel(), console_bridge::CONSOLE_BRIDGE_LOG_NONE);
  console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_WARN);
}

TEST_F(MessageCaptureTest, PutsBackWhatTheProcessCouldRestore) {
  KeepingHandler second;
  console_bridge::useOutputHandler(&second);
  { const MessageCapture capture; }
  EXPECT_EQ(console_bridge::getOutputHandler(), &second);
  console_bridge::restorePreviousOutputHandler();
  EXPECT_EQ(console_bridge::getOutputHandler(), &handler);
}

TEST_F(MessageCaptureTest, OneAtATimeInAProcess) {
  constexpr int kThreads = 4;
  std::vector<std::vector<std::string>> heard(kThreads);
  std::vector<std::thread> threads;
  threads.reserve(kThreads);
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&heard, i] {
      const MessageCapture capture;
      for (int k = 0; k < 50; ++k) CONSOLE_BRIDGE_logError("%d", i);
      heard[static_cast<std::size_t>(i)] = capture.messages();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < kThreads; ++i) {
    EXPECT_EQ(heard[static_cast<std::size_t>(i)], std::vector<std::string>(50, std::to_string(i)));
  }
  EXPECT_TRUE(handler.texts.empty());
}

}  // namespace
}  // namespace concave_distance::message_capture_test

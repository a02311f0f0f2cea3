#pragma once

#include <console_bridge/console.h>

#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace concave_distance::detail {

/// While it lives, what this thread says through console_bridge (urdfdom does) is kept instead of printed;
/// other threads' messages go to the handler that was set before. Handler and level are put back at the end.
/// One at a time in a process: the constructor waits for the one before.
class MessageCapture : private console_bridge::OutputHandler {
 public:
  MessageCapture();
  ~MessageCapture() override;
  MessageCapture(const MessageCapture&) = delete;
  MessageCapture& operator=(const MessageCapture&) = delete;

  const std::vector<std::string>& messages() const { return messages_; }

 private:
  void log(const std::string& text, console_bridge::LogLevel level, const char* filename, int line) override;

  std::unique_lock<std::mutex> one_at_a_time_;
  console_bridge::OutputHandler* previous_handler_;
  console_bridge::OutputHandler* handler_before_previous_;
  console_bridge::LogLevel previous_level_;
  std::thread::id thread_ = std::this_thread::get_id();
  std::vector<std::string> messages_;
};

}  // namespace concave_distance::detail

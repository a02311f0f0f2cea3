#include "message_capture.h"

#include <algorithm>

namespace concave_distance::detail {
namespace {

std::mutex& captureMutex() {
  static std::mutex mutex;
  return mutex;
}

// The handler that restorePreviousOutputHandler() would bring back: that function swaps, and twice is once.
console_bridge::OutputHandler* handlerToRestore() {
  console_bridge::restorePreviousOutputHandler();
  console_bridge::OutputHandler* handler = console_bridge::getOutputHandler();
  console_bridge::restorePreviousOutputHandler();
  return handler;
}

}  // namespace

MessageCapture::MessageCapture()
    : one_at_a_time_(captureMutex()),
      previous_handler_(console_bridge::getOutputHandler()),
      handler_before_previous_(handlerToRestore()),
      previous_level_(console_bridge::getLogLevel()) {
  console_bridge::useOutputHandler(this);
  // A process that wants no messages (level NONE) must not keep them from us.
  console_bridge::setLogLevel(std::min(previous_level_, console_bridge::CONSOLE_BRIDGE_LOG_WARN));
}

MessageCapture::~MessageCapture() {
  console_bridge::setLogLevel(previous_level_);
  // Both places that console_bridge remembers, so that neither points at this object afterwards.
  console_bridge::useOutputHandler(handler_before_previous_);
  console_bridge::useOutputHandler(previous_handler_);
}

void MessageCapture::log(const std::string& text, console_bridge::LogLevel level, const char* filename,
                         int line) {
  if (std::this_thread::get_id() != thread_) {
    if (previous_handler_ != nullptr && level >= previous_level_) {
      previous_handler_->log(text, level, filename, line);
    }
    return;
  }
  if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) messages_.push_back(text);
}

}  // namespace concave_distance::detail

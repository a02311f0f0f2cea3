#include "callback_guard.h"

#include <ros/console.h>

#include <mutex>

#include "base/log_throttle.h"

namespace concave_distance {

void reportEscape(const char* callback, const char* reason) noexcept {
  try {
    static std::mutex mutex;
    static LogThrottle throttle;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!throttle.isDue(callback)) return;
    }
    ROS_ERROR("%s failed: %s (the node goes on; please report this)", callback,
              reason == nullptr ? "an exception without a message" : reason);
  } catch (...) {
    // Without memory for a message there is nothing left to do.
  }
}

}  // namespace concave_distance

#pragma once

#include <sys/types.h>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace concave_distance::detail {

struct ChildEnd {
  bool was_late = false;     ///< ended by this program at its deadline
  bool was_stopped = false;  ///< ended by this program because of the stop flag
  bool is_known = false;     ///< false when this program's own handling of SIGCHLD took the status
  int signal = 0;            ///< signal that ended it, 0: none
  int exit_status = 0;
};

/// A child process that reads one open file and answers through a pipe, until a deadline. Its standard
/// streams are /dev/null, its signal handling is the default. The destructor ends it.
class ChildProcess {
 public:
  /// @param stop ends it like the deadline when it becomes true; nullptr: none
  /// @param input becomes the child's `input_number`, the pipe its `output_number`
  /// @throws std::system_error when it cannot be started
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments, int input,
               int input_number, int output_number, double seconds, const std::atomic<bool>* stop);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Waits for the next `size` bytes of its answer. False when they do not come before the deadline.
  bool read(void* data, std::size_t size);
  /// Ends it, if it has not ended by itself, and returns how it ended.
  ChildEnd end();

 private:
  /// Waits for data; false at the deadline or when it is stopped.
  bool waitForOutput();

  int output_ = -1;
  pid_t pid_ = -1;
  std::chrono::steady_clock::time_point deadline_;
  const std::atomic<bool>* stop_;
  ChildEnd end_;
};

}  // namespace concave_distance::detail

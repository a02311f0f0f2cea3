#include "child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

namespace concave_distance::detail {
namespace {

// Above the numbers in the child, so that no dup2 overwrites a descriptor that a later dup2 copies.
constexpr int kFirstOwnDescriptor = 16;

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kStopPeriod(50);  // between two checks of the stop flag
constexpr std::chrono::milliseconds kLongestPoll(60'000);

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// A copy that is not inherited by programs that other threads start.
class HighCopy {
 public:
  explicit HighCopy(int descriptor) : descriptor_(fcntl(descriptor, F_DUPFD_CLOEXEC, kFirstOwnDescriptor)) {
    if (descriptor_ < 0) fail(errno, "a descriptor");
  }
  HighCopy(const HighCopy&) = delete;
  HighCopy& operator=(const HighCopy&) = delete;
  ~HighCopy() { close(descriptor_); }
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

class SpawnSettings {
 public:
  SpawnSettings(int input, int input_number, int output, int output_number) {
    posix_spawn_file_actions_init(&actions_);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
      posix_spawn_file_actions_addopen(&actions_, stream, "/dev/null", O_RDWR, 0);
    }
    posix_spawn_file_actions_adddup2(&actions_, input, input_number);
    posix_spawn_file_actions_adddup2(&actions_, output, output_number);
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }

  pid_t spawn(const std::string& program, const std::vector<std::string>& arguments) const {
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t pid = -1;
    const int error = posix_spawn(&pid, program.c_str(), &actions_, &attributes_, argv.data(), environ);
    if (error != 0) fail(error, program);
    return pid;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments, int input,
                           int input_number, int output_number, double seconds, const std::atomic<bool>* stop)
    : deadline_(Clock::now() +
                std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))),
      stop_(stop) {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) fail(errno, "a pipe");
  try {
    const HighCopy child_input(input);
    const HighCopy child_output(ends[1]);
    pid_ = SpawnSettings(child_input.get(), input_number, child_output.get(), output_number)
               .spawn(program, arguments);
  } catch (...) {
    close(ends[0]);
    close(ends[1]);
    throw;
  }
  close(ends[1]);
  output_ = ends[0];
  fcntl(output_, F_SETPIPE_SZ, 1 << 20);  // fewer switches between the processes; may fail
}

ChildProcess::~ChildProcess() {
  end();
  close(output_);
}

bool ChildProcess::waitForOutput() {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now());
    end_.was_late = left.count() <= 0;
    end_.was_stopped = stop_ != nullptr && *stop_;
    if (end_.was_late || end_.was_stopped) return false;
    const auto wait = std::min(left, stop_ != nullptr ? kStopPeriod : kLongestPoll);
    pollfd output{output_, POLLIN, 0};
    const int ready = poll(&output, 1, static_cast<int>(wait.count()));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

bool ChildProcess::read(void* data, std::size_t size) {
  char* bytes = static_cast<char*>(data);
  while (size > 0) {
    if (!waitForOutput()) return false;
    const ssize_t count = ::read(output_, bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

ChildEnd ChildProcess::end() {
  const pid_t pid = std::exchange(pid_, -1);
  if (pid < 0) return end_;
  // A process that is already ending keeps its status.
  kill(pid, SIGKILL);
  int status = 0;
  pid_t waited = -1;
  do {
    waited = waitpid(pid, &status, 0);
  } while (waited < 0 && errno == EINTR);
  end_.is_known = waited == pid;
  if (end_.is_known && WIFSIGNALED(status)) end_.signal = WTERMSIG(status);
  if (end_.is_known && WIFEXITED(status)) end_.exit_status = WEXITSTATUS(status);
  return end_;
}

}  // namespace concave_distance::detail

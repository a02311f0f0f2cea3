#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <utility>

namespace concave_distance {

/// Processor time that the calling thread has used so far, nanoseconds (CLOCK_THREAD_CPUTIME_ID).
std::int64_t threadCpuNanoseconds();

/// Threads of an arena that may help the one which called begin(), and the processor time that they use. Work
/// that nobody has invited helpers for stays on the caller's thread.
class ThreadTeam {
 public:
  void begin() {
    caller_ = std::this_thread::get_id();
    nanoseconds_ = 0;
  }
  double seconds() const { return 1e-9 * static_cast<double>(nanoseconds_.load()); }

  /// Those invited to the calling thread's work; nullptr: none.
  static ThreadTeam* current() { return current_; }
  /// Threads that may do the caller's work, itself included.
  static std::size_t countHere() {
    if (current_ == nullptr) return 1;
    const auto of_arena = static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    return std::min(of_arena,
                    tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  }

  /// Does a part of the work, on any thread.
  template <typename Work>
  void share(const Work& work) {
    if (current_ == this) {
      work();
      return;
    }
    const Span span(*this);
    work();
  }

 private:
  class Span {
   public:
    explicit Span(ThreadTeam& of)
        : of_(of),
          before_(std::exchange(current_, &of)),
          is_helper_(std::this_thread::get_id() != of.caller_),
          start_(is_helper_ ? threadCpuNanoseconds() : 0) {}
    ~Span() {
      if (is_helper_) of_.nanoseconds_ += threadCpuNanoseconds() - start_;
      current_ = before_;
    }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    ThreadTeam& of_;
    ThreadTeam* before_;
    bool is_helper_;
    std::int64_t start_;
  };

  static thread_local ThreadTeam* current_;

  std::thread::id caller_;
  std::atomic<std::int64_t> nanoseconds_{0};
};

}  // namespace concave_distance

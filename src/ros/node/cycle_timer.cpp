#include "cycle_timer.h"

#include <ros/time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace concave_distance {
namespace {

// A simulated clock may run faster than the real one, so it is read this often.
constexpr std::chrono::milliseconds kSimulatedSlice(1);
constexpr std::chrono::milliseconds kLongestSlice(100);

std::int64_t nowInNanoseconds() {
  return static_cast<std::int64_t>(ros::Time::now().toNSec());
}

std::int64_t periodOf(double rate) {
  return std::llround(1e9 / rate);
}

}  // namespace

CycleTimer::CycleTimer(Callback callback) : callback_(std::move(callback)) {}

CycleTimer::~CycleTimer() {
  stop();
}

void CycleTimer::start(double rate) {
  period_ = periodOf(rate);
  thread_ = std::thread([this] { run(); });
}

void CycleTimer::setRate(double rate) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (due_ != 0) due_ += periodOf(rate) - period_;
  period_ = periodOf(rate);
  changed_.notify_all();
}

void CycleTimer::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

// False when the timer was stopped.
bool CycleTimer::waitUntilDue(std::unique_lock<std::mutex>& lock) {
  while (!stopping_) {
    const std::int64_t now = nowInNanoseconds();
    if (due_ == 0 || now < last_now_) due_ = now + period_;
    last_now_ = now;
    const bool simulated = ros::Time::isSimTime();
    if (now >= due_ && now != 0) return true;
    std::chrono::nanoseconds slice =
        std::min<std::chrono::nanoseconds>(std::chrono::nanoseconds(due_ - now), kLongestSlice);
    if (simulated) slice = kSimulatedSlice;
    changed_.wait_for(lock, slice);
  }
  return false;
}

void CycleTimer::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (waitUntilDue(lock)) {
    const std::int64_t due = due_;
    lock.unlock();
    callback_(due);
    lock.lock();
    due_ += period_;
    // If the clock ran ahead or calls take too long, missed calls are left out.
    due_ = std::max(due_, nowInNanoseconds() - period_);
  }
}

}  // namespace concave_distance

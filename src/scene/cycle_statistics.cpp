#include "cycle_statistics.h"

#include <algorithm>
#include <utility>

namespace concave_distance {
namespace {

void merge(const Series& from, Series& into) {
  into.count += from.count;
  into.sum += from.sum;
  into.largest = std::max(into.largest, from.largest);
}

}  // namespace

void Series::add(double value) {
  ++count;
  sum += value;
  largest = std::max(largest, value);
}

double Series::mean() const {
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(count);
}

void CycleStatistics::begin(double wall_seconds) {
  const std::lock_guard<std::mutex> lock(mutex_);
  cycle_start_ = wall_seconds;
}

void CycleStatistics::add(CycleRecord record) {
  const std::lock_guard<std::mutex> lock(mutex_);
  cycle_start_ = -1.0;
  ++window_.cycles;
  ++total_cycles_;
  window_.late += record.late ? 1 : 0;
  total_late_ += record.late ? 1 : 0;
  window_.duration.add(record.duration);
  window_.cpu.add(record.cpu);
  merge(record.latency, window_.latency);
  window_.total.add(record.report);
  window_.messages += record.messages;
  window_.markers += record.markers;
  window_.last = record.report;
  window_.failing = std::move(record.failing);
}

void CycleStatistics::addFailure() {
  const std::lock_guard<std::mutex> lock(mutex_);
  cycle_start_ = -1.0;
  ++window_.failed;
}

CycleWindow CycleStatistics::take(double wall_seconds) {
  const std::lock_guard<std::mutex> lock(mutex_);
  CycleWindow window = std::move(window_);
  window.seconds = window_start_ < 0.0 ? 0.0 : wall_seconds - window_start_;
  window.running = cycle_start_ < 0.0 ? 0.0 : wall_seconds - cycle_start_;
  window_ = CycleWindow();
  window_start_ = wall_seconds;
  return window;
}

std::uint64_t CycleStatistics::totalCycles() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return total_cycles_;
}

std::uint64_t CycleStatistics::totalLate() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return total_late_;
}

}  // namespace concave_distance

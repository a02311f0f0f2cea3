#include "measurement.h"

#include <ros/transport_hints.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace concave_distance {
namespace {

constexpr std::size_t kStampsKept = 4096;  // of transforms, to find that of a message among
constexpr std::uint32_t kQueueLength = 5000;
constexpr double kMilliseconds = 1e3;

/// Of sorted values, the one that a share of them does not exceed (nearest rank).
double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) {
    return std::nan("");
  }
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

void printTimes(const char* name, std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  if (seconds.empty()) {
    return;
  }
  std::printf("  %-14s median %.2f ms, p99 %.2f ms, p99.9 %.2f ms, largest %.2f ms (%zu)\n", name,
              kMilliseconds * quantile(seconds, 0.5), kMilliseconds * quantile(seconds, 0.99),
              kMilliseconds * quantile(seconds, 0.999), kMilliseconds * quantile(seconds, 1.0),
              seconds.size());
}

}  // namespace

Measurement::Measurement(ros::NodeHandle& node, const std::string& measured, const std::string& topic)
    : name_(measured.substr(1) + ": "),
      transforms_(node.subscribe("/tf", kQueueLength, &Measurement::onTransforms, this,
                                 ros::TransportHints().tcpNoDelay())),
      messages_(topic == "niches"
                    ? node.subscribe(measured + "/niches", kQueueLength, &Measurement::onNiches, this,
                                     ros::TransportHints().tcpNoDelay())
                    : node.subscribe(measured + "/distances", kQueueLength, &Measurement::onDistances, this,
                                     ros::TransportHints().tcpNoDelay())),
      diagnostics_(node.subscribe("/diagnostics", kQueueLength, &Measurement::onDiagnostics, this)) {}

void Measurement::restart() {
  figures_ = Figures();
  last_receipt_ = ros::Time();
  waits_.clear();
}

void Measurement::onTransforms(const ros::MessageEvent<tf2_msgs::TFMessage const>& event) {
  for (const auto& transform : event.getConstMessage()->transforms) {
    received_.emplace(transform.header.stamp, event.getReceiptTime());
  }
  while (received_.size() > kStampsKept) {
    received_.erase(received_.begin());
  }
}

void Measurement::onNiches(const ros::MessageEvent<Niches const>& event) {
  const Niches& niches = *event.getConstMessage();
  nearest_.clear();
  for (const PairNiches& pair : niches.pairs) {
    nearest_.push_back(&pair.nearest);
  }
  if (!isNewAnswer(niches.header.stamp, event.getReceiptTime())) {
    return;
  }
  for (const PairNiches& pair : niches.pairs) {
    if (pair.nearest.has_distance == 0) {
      continue;
    }
    std::uint64_t& wait = waits_[pair.nearest.pair];
    wait = pair.niches_complete != 0 ? 0 : wait + 1;
    ++figures_.lists;
    figures_.complete_lists += wait == 0 ? 1 : 0;
    figures_.longest_wait = std::max(figures_.longest_wait, wait);
    if (pair.solve_time > figures_.longest.solve_time) {
      figures_.longest = pair;
    }
    (pair.warm != 0 ? figures_.warm_times : figures_.cold_times).push_back(pair.solve_time);
  }
}

void Measurement::onDistances(const ros::MessageEvent<Distances const>& event) {
  const Distances& distances = *event.getConstMessage();
  nearest_.clear();
  for (const PairDistance& pair : distances.pairs) {
    nearest_.push_back(&pair);
  }
  isNewAnswer(distances.header.stamp, event.getReceiptTime());
}

bool Measurement::isNewAnswer(ros::Time stamp, ros::Time receipt) {
  ++figures_.messages;
  if (!last_receipt_.isZero()) {
    figures_.largest_gap = std::max(figures_.largest_gap, (receipt - last_receipt_).toSec());
  }
  last_receipt_ = receipt;
  bool has_distance = false;
  for (const PairDistance* pair : nearest_) {
    has_distance = has_distance || pair->has_distance != 0;
    if (pair->has_distance == 0 && pair->status.code != PairStatus::BEYOND_CUTOFF) {
      ++figures_.unsolved;
      figures_.reason = pair->pair + ": " + pair->status.message;
    }
  }
  seen_ = seen_ || has_distance;
  if (!has_distance || stamp == last_stamp_) {
    return false;
  }
  last_stamp_ = stamp;
  figures_.from_stamp.push_back((receipt - stamp).toSec());
  const auto transforms = received_.find(stamp);
  if (transforms != received_.end()) {
    figures_.from_receipt.push_back((receipt - transforms->second).toSec());
  }
  return true;
}

void Measurement::onDiagnostics(const diagnostic_msgs::DiagnosticArray& array) {
  std::map<std::string, double> values;
  for (const auto& status : array.status) {
    if (status.name.rfind(name_, 0) != 0) {
      continue;
    }
    for (const auto& value : status.values) {
      values[value.key] = std::atof(value.value.c_str());
    }
  }
  if (values.count("cycles") == 0) {
    return;
  }
  const double cycles = values["cycles"];
  figures_.cycles += cycles;
  figures_.late += values["late cycles"];
  figures_.solved += values["solves"];
  figures_.cold += values["cold solves"];
  figures_.repeated += values["answers repeated without new transforms"];
  figures_.misses += values["search misses"];
  figures_.watched = values["pairs watched"];
  figures_.cpu_seconds += cycles * values["thread CPU time per cycle mean (ms)"] / kMilliseconds;
  figures_.cpu_largest =
      std::max(figures_.cpu_largest, values["thread CPU time per cycle max (ms)"] / kMilliseconds);
  figures_.duration_seconds += cycles * values["cycle time mean (ms)"] / kMilliseconds;
  figures_.duration_largest =
      std::max(figures_.duration_largest, values["cycle time max (ms)"] / kMilliseconds);
}

void print(const Figures& figures, double rate, double seconds, double process_seconds, const BareTimer& bare,
           const MachineSeconds& machine) {
  const double cycles = std::max(figures.cycles, 1.0);
  const double cpu = figures.cpu_seconds / cycles;
  std::printf("  cycles         %.0f at %.6g Hz, late %.0f: %.3f %%\n", figures.cycles, rate, figures.late,
              100.0 * figures.late / cycles);
  const double core_seconds = seconds * std::thread::hardware_concurrency();
  std::printf("  bare timer     late %lu: %.3f %%; cores idle %.0f %%, stolen %.2f %%\n",
              static_cast<unsigned long>(bare.late()),
              100.0 * static_cast<double>(bare.late()) / static_cast<double>(bare.cycles()),
              100.0 * machine.idle / core_seconds, 100.0 * machine.stolen / core_seconds);
  std::printf("  messages       %lu in %.1f s, largest gap %.2f ms\n",
              static_cast<unsigned long>(figures.messages), seconds, kMilliseconds * figures.largest_gap);
  std::printf(
      "  pairs          %.0f watched; a cycle %.2f solved (%.4f cold), %.2f repeated; search misses %.0f\n",
      figures.watched, figures.solved / cycles, figures.cold / cycles, figures.repeated / cycles,
      figures.misses);
  std::printf("  cycle time     mean %.3f ms, largest %.2f ms\n",
              kMilliseconds * figures.duration_seconds / cycles, kMilliseconds * figures.duration_largest);
  std::printf("  thread CPU     mean %.3f ms, %.1f %% of the period; largest %.2f ms\n", kMilliseconds * cpu,
              100.0 * cpu * rate, kMilliseconds * figures.cpu_largest);
  std::printf("  process CPU    %.1f %% of a core\n", 100.0 * process_seconds / seconds);
  if (figures.lists > 0) {
    std::printf("  lists          %.3f %% complete; a pair without one for at most %lu cycles\n",
                100.0 * static_cast<double>(figures.complete_lists) / static_cast<double>(figures.lists),
                static_cast<unsigned long>(figures.longest_wait));
  }
  if (figures.unsolved > 0) {
    std::printf("  unsolved       %lu pairs in these messages; the last: %s\n",
                static_cast<unsigned long>(figures.unsolved), figures.reason.c_str());
  }
  printTimes("warm solves", figures.warm_times);
  printTimes("cold solves", figures.cold_times);
  if (!figures.longest.nearest.pair.empty()) {
    std::printf("  the longest    %s: %lu evaluations, %zu niches, distance %.4f m\n",
                figures.longest.nearest.pair.c_str(), static_cast<unsigned long>(figures.longest.evaluations),
                figures.longest.niches.size(), figures.longest.nearest.distance);
  }
  printTimes("from stamp", figures.from_stamp);
  printTimes("from receipt", figures.from_receipt);
}

}  // namespace concave_distance

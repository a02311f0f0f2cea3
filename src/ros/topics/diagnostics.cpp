#include "diagnostics.h"

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <algorithm>

namespace concave_distance {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kNotableLateShare = 0.01;
constexpr double kNotableRateShare = 0.9;
// Pairs and problems that are listed one by one.
constexpr std::size_t kListed = 20;

void addSeries(const std::string& name, const Series& series,
               diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (series.count == 0) {
    return;
  }
  status.addf(name + " mean (ms)", "%.3f", 1e3 * series.mean());
  status.addf(name + " max (ms)", "%.3f", 1e3 * series.largest);
}

}  // namespace

void describeCycle(const CycleWindow& window, double wanted_rate,
                   diagnostic_updater::DiagnosticStatusWrapper& status) {
  const double rate = window.seconds > 0.0 ? static_cast<double>(window.cycles) / window.seconds : 0.0;
  const auto cycles = static_cast<double>(std::max<std::uint64_t>(window.cycles, 1));
  if (window.failed > 0) {
    status.summary(DiagnosticStatus::ERROR, "errors ended cycles (see the node's log)");
  } else if (window.cycles == 0 && window.running > 0.0) {
    status.summaryf(DiagnosticStatus::WARN, "a cycle has been running for %.1f s", window.running);
  } else if (window.cycles == 0) {
    status.summary(DiagnosticStatus::WARN, "no cycle ran (waiting for the scene, or the clock stands still)");
  } else if (window.last.watched == 0) {
    status.summary(DiagnosticStatus::OK, "nobody subscribes: nothing is computed");
  } else if (static_cast<double>(window.late) > kNotableLateShare * cycles) {
    status.summaryf(DiagnosticStatus::WARN, "%.1f %% of the cycles were late",
                    100.0 * static_cast<double>(window.late) / cycles);
  } else if (window.seconds > 0.0 && rate < kNotableRateShare * wanted_rate) {
    status.summaryf(DiagnosticStatus::WARN, "%.1f cycles a second instead of %.1f", rate, wanted_rate);
  } else {
    status.summary(DiagnosticStatus::OK, "on time");
  }
  status.addf("rate wanted (Hz)", "%.3f", wanted_rate);
  status.addf("rate achieved (Hz)", "%.3f", rate);
  status.add("cycles", window.cycles);
  status.add("late cycles", window.late);
  status.add("failed cycles", window.failed);
  addSeries("cycle time", window.duration, status);
  addSeries("thread CPU time per cycle", window.cpu, status);
  addSeries("latency from transform to message", window.latency, status);
}

void describePairs(const CycleWindow& window, diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (window.failing.empty()) {
    status.summaryf(DiagnosticStatus::OK, "%u pairs watched", window.last.watched);
  } else {
    status.summaryf(DiagnosticStatus::WARN, "%zu of %u pairs have no or stale transforms",
                    window.failing.size(), window.last.watched);
  }
  status.add("pairs watched", window.last.watched);
  status.add("pairs beyond the cutoff", window.last.beyond_cutoff);
  status.add("pairs whose niches are being prepared", window.last.unprepared);
  status.add("pairs without transforms", window.failing.size());
  for (const CycleCounter& counter : cycleCounters()) status.add(counter.key, window.total.*counter.count);
  for (const auto& counter : SearchCost::counters()) status.add(counter.key, counter.of(window.total.cost));
  for (const auto& counter : CertificateCost::counters())
    status.add(counter.key, counter.of(window.total.proof_cost));
  for (std::size_t i = 0; i < kNicheOriginCount; ++i) {
    status.add("niches " + std::string(toString(static_cast<NicheOrigin>(i))), window.total.niches[i]);
  }
  status.add("pairs turned into messages", window.messages);
  status.add("markers built", window.markers);
  for (std::size_t index = 0; index < std::min(window.failing.size(), kListed); ++index) {
    status.add("no transforms " + std::to_string(index + 1), window.failing[index]);
  }
}

void describeTransforms(const TransformReport& report, diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (report.refused > 0) {
    status.summaryf(DiagnosticStatus::WARN, "%llu transforms were refused; the last: %s",
                    static_cast<unsigned long long>(report.refused), report.last_refusal.c_str());
  } else {
    status.summaryf(DiagnosticStatus::OK, "%zu frames", report.frames);
  }
  status.add("frames", report.frames);
  status.add("transforms taken", report.taken);
  status.add("transforms refused", report.refused);
  status.add("transforms refused since the start", report.refused_in_all);
  status.add("last refusal", report.last_refusal);
}

void describeMoves(const MoveReport& report, diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (report.refused > 0) {
    status.summaryf(DiagnosticStatus::WARN, "%llu moves were refused; the last: %s",
                    static_cast<unsigned long long>(report.refused), report.last_refusal.c_str());
  } else {
    status.summary(DiagnosticStatus::OK, "no move was refused");
  }
  status.add("moves taken", report.taken);
  status.add("moves refused", report.refused);
  status.add("moves refused since the start", report.refused_in_all);
  status.add("last refusal", report.last_refusal);
}

void describeClouds(const std::vector<CloudReport>& clouds,
                    diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.summary(DiagnosticStatus::OK, clouds.empty() ? "the scene has no clouds" : "no cloud was refused");
  for (const CloudReport& cloud : clouds) {
    if (cloud.refused_lately > 0) {
      status.summaryf(DiagnosticStatus::WARN, "%llu messages of '%s' were refused; the last: %s",
                      static_cast<unsigned long long>(cloud.refused_lately), cloud.name.c_str(),
                      cloud.last_refusal.c_str());
    } else if (cloud.taken == 0) {
      status.summaryf(DiagnosticStatus::WARN, "nothing has come on '%s' yet for cloud '%s'",
                      cloud.topic.c_str(), cloud.name.c_str());
    } else if (!cloud.remark.empty()) {
      status.summaryf(DiagnosticStatus::WARN, "cloud '%s': %s", cloud.name.c_str(), cloud.remark.c_str());
    }
    const std::string& name = cloud.name;
    status.add(name + " topic", cloud.topic);
    status.add(name + " taken", cloud.taken);
    status.add(name + " passed over for a newer one", cloud.passed_over);
    status.add(name + " refused", cloud.refused);
    status.add(name + " last refusal", cloud.last_refusal);
    status.add(name + " stamp (s)", cloud.stamp);
    status.add(name + " points", cloud.points);
    status.add(name + " points left out", cloud.left_out);
    status.add(name + " occupied voxels", cloud.voxels);
    status.addf(name + " time from message to body (ms)", "%.1f", 1e3 * cloud.seconds);
  }
}

void describeEffects(const CycleWindow& window, diagnostic_updater::DiagnosticStatusWrapper& status) {
  const auto& runs = window.total.effects.runs;
  const bool ran = std::any_of(runs.begin(), runs.end(), [](std::uint64_t count) { return count > 0; });
  status.summary(DiagnosticStatus::OK,
                 ran ? "effects ran" : "no effect ran: none asked for, nobody subscribes, or no contact");
  for (std::size_t stage = 0; stage < kEffectStages; ++stage) {
    const std::string name(toString(static_cast<EffectStage>(stage)));
    status.add(name + " runs", runs[stage]);
    if (runs[stage] > 0 && window.cpu.sum > 0.0) {
      status.addf(name + " share of the processor time (%)", "%.1f",
                  100.0 * window.total.effects.seconds[stage] / window.cpu.sum);
    }
  }
}

void describeScene(const Scene& scene, const std::string& waiting_for, const std::string& changed,
                   diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (!waiting_for.empty()) {
    status.summary(DiagnosticStatus::WARN, "waiting: " + waiting_for);
  } else if (!changed.empty()) {
    status.summary(DiagnosticStatus::WARN, "the parameter '" + changed +
                                               "' has changed since it was loaded: call the service reload");
  } else if (!scene.problems.empty()) {
    status.summaryf(DiagnosticStatus::WARN, "%zu parts could not be loaded", scene.problems.size());
  } else {
    status.summary(DiagnosticStatus::OK, "loaded");
  }
  status.add("bodies", scene.bodies.size());
  status.add("changed description", changed);
  status.add("pairs", scene.pairs.size() + countPairsByRule(scene));
  for (std::size_t index = 0; index < std::min(scene.problems.size(), kListed); ++index) {
    status.add("problem " + std::to_string(index + 1),
               scene.problems[index].where + ": " + scene.problems[index].message);
  }
}

}  // namespace concave_distance

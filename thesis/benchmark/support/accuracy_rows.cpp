#include "thesis/benchmark/support/accuracy_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "benchmark/support/statistics.h"
#include "distance/bound/certificate.h"

namespace concave_distance::benchmark {
namespace {

/// Errors above this, in units of the smaller body's diameter, count as missed.
constexpr double kMissed = 1e-2;

}  // namespace

Rows::Rows(const std::string& output, int steps, int cold) : steps_(steps), cold_(cold) {
  if (output.empty()) return;
  csv_.open(output);
  csv_ << "pair,set,method,setting,mode,instants,median_error,p99_error,largest_error,median_gap,p90_gap,"
          "median_us,p99_us,missed\n";
}

void Rows::begin(const BenchmarkPair& pair, const std::string& set) {
  name_ = pair.name;
  set_ = set;
  unit_ = std::min(pair.a->diameter(), pair.b->diameter());
  tracked_ = instants(pair, steps_);
  colds_ = instants(pair, cold_);
}

void Rows::cold(const std::string& method, const std::string& setting, const Query& query) {
  add(method, setting, "cold", colds_, query);
}

void Rows::tracked(const std::string& method, const std::string& setting, const Query& query) {
  add(method, setting, "tracked", tracked_, query);
}

std::vector<Rows::Instant> Rows::instants(const BenchmarkPair& pair, int count) {
  std::vector<Instant> made;
  CertificateWorkspace workspace;
  for (int k = 0; k < count; ++k) {
    const double t = count > 1 ? static_cast<double>(k) / (count - 1) : 0.0;
    const Eigen::Isometry3d pose = pair.motion(t);
    made.push_back(
        {kDuration * t, pose, certifyDistance(*pair.a, *pair.b, pose, nullptr, 0, {}, workspace).distance});
  }
  return made;
}

void Rows::add(const std::string& method, const std::string& setting, const char* mode,
               const std::vector<Instant>& instants, const Query& query) {
  std::vector<double> errors;
  std::vector<double> gaps;
  std::vector<double> times;
  int missed = 0;
  for (std::size_t k = 0; k < instants.size(); ++k) {
    const Answer answer = query(instants[k].pose, instants[k].time, k == 0);
    if (k == 0 && std::string(mode) == "tracked") continue;  // begins cold
    errors.push_back(std::abs(answer.distance - instants[k].distance) / unit_);
    missed += errors.back() > kMissed ? 1 : 0;
    if (std::isfinite(answer.lower_bound)) gaps.push_back((answer.distance - answer.lower_bound) / unit_);
    times.push_back(answer.microseconds);
  }
  const double largest = *std::max_element(errors.begin(), errors.end());
  const double gap = gaps.empty() ? std::nan("") : median(gaps);
  std::printf("%-21s %-22s %-28s %-8s %9.2e %9.2e %9.2e %9.2e %10.2f %10.2f %4d\n", name_.c_str(),
              method.c_str(), setting.c_str(), mode, median(errors), percentile(errors, 0.99), largest, gap,
              median(times), percentile(times, 0.99), missed);
  std::fflush(stdout);
  if (!csv_) return;
  csv_ << name_ << ',' << set_ << ',' << method << ',' << setting << ',' << mode << ',' << errors.size()
       << ',' << median(errors) << ',' << percentile(errors, 0.99) << ',' << largest << ',';
  if (!gaps.empty()) csv_ << gap << ',' << percentile(gaps, 0.9);
  if (gaps.empty()) csv_ << ',';
  csv_ << ',' << median(times) << ',' << percentile(times, 0.99) << ',' << missed << '\n';
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g", value);
  return text;
}

}  // namespace concave_distance::benchmark

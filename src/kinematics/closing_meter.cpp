#include "closing_meter.h"

#include "concave_distance/base/not_computed.h"

namespace concave_distance::detail {

void ClosingMeter::begin(std::size_t slots, double time) {
  samples_.resize(slots);
  time_ = time;
}

double ClosingMeter::measure(std::size_t slot, std::uint64_t niche, std::uint64_t age, double value) {
  Sample& sample = samples_[slot];
  const bool is_same = sample.is_used && sample.niche == niche && age >= sample.age;
  if (!is_same || time_ < sample.time) {
    sample = {true, niche, age, value, time_, kNotComputed};
    return kNotComputed;
  }
  // A cycle that is read twice keeps the speed that it had.
  if (time_ == sample.time) return sample.speed;
  const double speed = (sample.value - value) / (time_ - sample.time);
  sample = {true, niche, age, value, time_, speed};
  return speed;
}

}  // namespace concave_distance::detail

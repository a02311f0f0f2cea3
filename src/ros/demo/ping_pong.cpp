#include "ping_pong.h"

#include <algorithm>
#include <cmath>

namespace concave_distance::demo {

double pingPong(double elapsed, double duration, double pause) {
  const double leg = duration + pause;
  const double phase = std::fmod(std::max(elapsed, 0.0), 2.0 * leg);
  return phase < leg ? std::min(phase, duration) : std::max(duration - (phase - leg), 0.0);
}

}  // namespace concave_distance::demo

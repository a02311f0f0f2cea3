#pragma once

#include <cstdint>

namespace concave_distance {

/// Processor time that the calling thread has used so far, nanoseconds (CLOCK_THREAD_CPUTIME_ID).
std::int64_t threadCpuNanoseconds();

}  // namespace concave_distance

#include "thread_team.h"

#include <ctime>

namespace concave_distance {

std::int64_t threadCpuNanoseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

thread_local ThreadTeam* ThreadTeam::current_ = nullptr;

}  // namespace concave_distance

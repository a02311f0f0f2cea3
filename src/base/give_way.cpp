#include "give_way.h"

#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>

namespace concave_distance {

void giveWay() {
  constexpr int kSteps = 5;
  constexpr int kLowest = 19;
  const sched_param none{};
  sched_setscheduler(0, SCHED_OTHER, &none);
  const auto thread = static_cast<id_t>(syscall(SYS_gettid));
  setpriority(PRIO_PROCESS, thread, std::min(getpriority(PRIO_PROCESS, thread) + kSteps, kLowest));
}

}  // namespace concave_distance

#include "give_way.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace concave_distance {

void giveWay() {
  constexpr int kSteps = 5;
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kSteps);
}

}  // namespace concave_distance

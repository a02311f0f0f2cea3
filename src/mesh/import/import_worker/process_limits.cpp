#include "process_limits.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace concave_distance::detail {
namespace {

void limit(decltype(RLIMIT_AS) resource, rlim_t soft, rlim_t hard) {
  rlimit current{};
  getrlimit(resource, &current);
  const rlimit wanted{std::min(soft, current.rlim_max), std::min(hard, current.rlim_max)};
  setrlimit(resource, &wanted);
}

}  // namespace

void closeDescriptorsAbove(int last) {
  DIR* folder = opendir("/proc/self/fd");
  if (folder == nullptr) return;
  std::vector<int> open;
  while (const dirent* entry = readdir(folder)) {
    const int descriptor = std::atoi(entry->d_name);
    if (descriptor > last && descriptor != dirfd(folder)) open.push_back(descriptor);
  }
  closedir(folder);
  for (const int descriptor : open) close(descriptor);
}

void limitProcess(std::size_t memory, double seconds) {
  const int score = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (score >= 0) {
    static_cast<void>(write(score, "1000", 4) == 4);  // if this fails, the system may choose another process
    close(score);
  }
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const auto whole_seconds = static_cast<rlim_t>(std::ceil(seconds));
  limit(RLIMIT_CPU, whole_seconds, whole_seconds + 1);
  limit(RLIMIT_AS, memory, memory);
  for (const auto resource : {RLIMIT_CORE, RLIMIT_FSIZE, RLIMIT_NOFILE, RLIMIT_NPROC}) limit(resource, 0, 0);
}

}  // namespace concave_distance::detail

#include "niche_preparation.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <system_error>
#include <utility>

#include "base/helper_threads.h"
#include "concave_distance/search/prepare_search.h"
#include "distance/niches/convex_pair.h"
#include "mesh/trees/normal_cone_tree.h"

namespace concave_distance {
namespace {

/// Steps of `nice` for the calling thread; without the right to it nothing changes.
void giveWay() {
  constexpr int kSteps = 5;
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kSteps);
}

}  // namespace

PreparationTask::PreparationTask(std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
                                 const TrackerParameters& parameters)
    : a_(std::move(a)),
      b_(std::move(b)),
      keeps_through_material_(parameters.keep_through_material),
      lists_hidden_(parameters.hidden),
      is_searched_(parameters.search_share > 0.0) {}

bool PreparationTask::suffices(const TrackerParameters& parameters) const {
  return keeps_through_material_ == parameters.keep_through_material &&
         (lists_hidden_ || !parameters.hidden) && (is_searched_ || !(parameters.search_share > 0.0));
}

void PreparationTask::run() {
  try {
    makeParts();
  } catch (...) {
    // Whoever uses the part next meets the same and can say where.
  }
  is_done_.store(true, std::memory_order_release);
}

void PreparationTask::makeParts() const {
  const BodyMesh& a = a_->asSolved();
  const BodyMesh& b = b_->asSolved();
  if (a.shape() != nullptr && b.shape() != nullptr) return;
  for (const BodyMesh* body : {&a, &b}) {
    body->adjacency();
    body->pieces();
    body->hullGap();
  }
  if (!keeps_through_material_ && !lists_hidden_ && detail::areConvex(a, b)) return;
  const NormalSides sides = keeps_through_material_ ? NormalSides::Both : NormalSides::Outside;
  runTogether({[&] { a.prepareNiches(sides); }, [&] { b.prepareNiches(sides); },
               [&] {
                 if (is_searched_) prepareSearch({&a, &b});
               }});
}

NichePreparation::~NichePreparation() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
    tasks_.clear();
  }
  added_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void NichePreparation::add(std::shared_ptr<PreparationTask> task) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    try {
      if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
    } catch (const std::system_error&) {
      return task->run();
    }
    tasks_.push_back(std::move(task));
  }
  added_.notify_one();
}

void NichePreparation::addAhead(const std::shared_ptr<const BodyMesh>& mesh,
                                const TrackerParameters& parameters) {
  if (begun_ahead_.insert(mesh.get()).second) add(std::make_shared<PreparationTask>(mesh, mesh, parameters));
}

void NichePreparation::work() {
  giveWay();
  std::vector<std::shared_ptr<PreparationTask>> taken;
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      added_.wait(lock, [this] { return is_ending_ || !tasks_.empty(); });
      if (is_ending_) return;
      taken.swap(tasks_);
    }
    for (const std::shared_ptr<PreparationTask>& task : taken) {
      task->run();
      const std::lock_guard<std::mutex> lock(mutex_);
      if (is_ending_) return;
    }
    taken.clear();
  }
}

}  // namespace concave_distance

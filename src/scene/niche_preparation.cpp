#include "niche_preparation.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <iterator>
#include <new>
#include <system_error>
#include <utility>

#include "base/give_way.h"
#include "base/run_together.h"
#include "body_preparation.h"
#include "cloud_bodies.h"
#include "concave_distance/search/prepare_search.h"
#include "mesh/trees/normal_cone_tree.h"
#include "near_pairs.h"

namespace concave_distance {
namespace {

/// Triangles of a scene up to which what niches need, some 500 bytes each, is made before anybody asks.
constexpr std::size_t kMostTrianglesAhead = 1'000'000;

}  // namespace

PreparationTask::PreparationTask(const std::shared_ptr<const BodyMesh>& a,
                                 const std::shared_ptr<const BodyMesh>& b,
                                 const TrackerParameters& parameters)
    : a_(a), b_(b), parameters_(parameters) {}

bool PreparationTask::suffices(const TrackerParameters& parameters) const {
  return parameters_.keep_through_material == parameters.keep_through_material &&
         (parameters_.hidden || !parameters.hidden) &&
         (parameters_.search_share > 0.0 || !(parameters.search_share > 0.0));
}

void PreparationTask::makeNiches() {
  try {
    makeParts();
  } catch (...) {
    // Whoever uses the part next meets the same and can say where.
  }
  is_done_.store(true, std::memory_order_release);
}

void PreparationTask::makeParts() {
  const std::shared_ptr<const BodyMesh> mesh_a = a_.lock();
  const std::shared_ptr<const BodyMesh> mesh_b = b_.lock();
  if (!mesh_a || !mesh_b) return;
  const BodyMesh& a = mesh_a->asSolved();
  const BodyMesh& b = mesh_b->asSolved();
  if (a.shape() == nullptr || b.shape() == nullptr) {
    makeCommonParts(a);
    makeCommonParts(b);
  }
  needs_search_ = needsSearch(a, b, parameters_);
  if (!needs_search_) return;
  const NormalSides sides = parameters_.keep_through_material ? NormalSides::Both : NormalSides::Outside;
  runTogether({[&] { a.prepareNiches(sides); }, [&] { b.prepareNiches(sides); }});
}

void PreparationTask::makeSearch() {
  const std::shared_ptr<const BodyMesh> a = a_.lock();
  const std::shared_ptr<const BodyMesh> b = b_.lock();
  if (!(parameters_.search_share > 0.0) || !needs_search_ || !a || !b) return;
  try {
    prepareSearch({&a->asSolved(), &b->asSolved()});
  } catch (...) {
    return;  // lists are proven without
  }
  is_search_done_.store(true, std::memory_order_release);
}

NichePreparation::~NichePreparation() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
    waiting_ = {};
  }
  added_.notify_one();
  if (thread_.joinable()) thread_.join();
}

// Many triangles take much memory: they wait until somebody wants their niches, as all do when none is left.
void NichePreparation::addAhead(const Scene& scene, const std::vector<std::shared_ptr<TrackedPair>>& pairs) {
  std::size_t triangles = 0;
  for (const SceneBody& body : scene.bodies) {
    if (body.mesh) triangles += body.mesh->surface().triangleCount();
  }
  if (triangles > kMostTrianglesAhead) return;
  try {
    for (const auto& pair : pairs) {
      if (pair->origin->enabled && detail::hasNiches(*pair->body_a) && detail::hasNiches(*pair->body_b))
        isPrepared(*pair);
    }
    // Which of the others will be near is not known: each mesh once, as if against itself.
    const TrackerParameters& parameters = scene.defaults.pairs.tracker;
    if (!provesDistance(parameters.accuracy)) return;
    for (const std::size_t i : scene.rules.allBodies().indices()) {
      const SceneBody& body = scene.bodies[i];
      if (detail::hasNiches(body)) addAhead(body.mesh, parameters);
    }
  } catch (const std::bad_alloc&) {
    // The scene is tracked already; a cycle that wants the niches tries again.
  }
}

bool NichePreparation::isPrepared(TrackedPair& pair) {
  const TrackerParameters& parameters = pair.settings.tracker;
  if (!provesDistance(parameters.accuracy)) return true;
  if (!pair.preparation) {
    // The pair has it when it is sure to run.
    auto task = std::make_shared<PreparationTask>(pair.body_a->mesh, pair.body_b->mesh, parameters);
    add(Entry{task, false});
    pair.preparation = std::move(task);
  }
  return pair.preparation->isDone();
}

void NichePreparation::add(Entry entry) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    try {
      if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
    } catch (const std::system_error&) {
      return entry.task->run();
    }
    waiting_[entry.is_ahead ? 1 : 0].push_back(std::move(entry));
  }
  added_.notify_one();
}

void NichePreparation::addAhead(const std::shared_ptr<const BodyMesh>& mesh,
                                const TrackerParameters& parameters) {
  if (isBegunAhead(mesh)) return;
  add(Entry{std::make_shared<PreparationTask>(mesh, mesh, parameters), true});
}

bool NichePreparation::isBegunAhead(const std::shared_ptr<const BodyMesh>& mesh) {
  std::weak_ptr<const BodyMesh>& begun = begun_ahead_[mesh.get()];
  if (!begun.expired()) return true;  // another one that is gone may have had its address
  begun = mesh;
  if (begun_ahead_.size() > most_begun_) {
    for (auto entry = begun_ahead_.begin(); entry != begun_ahead_.end();) {
      entry = entry->second.expired() ? begun_ahead_.erase(entry) : std::next(entry);
    }
    most_begun_ = 2 * begun_ahead_.size() + 64;
  }
  return false;
}

// No worker helps: one that this thread had begun would have its low priority in the cycles too.
void NichePreparation::work() {
  giveWay();
  tbb::task_arena alone(1);
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    added_.wait(lock, [&] { return is_ending_ || first() != waiting_.end(); });
    if (is_ending_) return;
    const auto list = first();
    const bool is_search = list == waiting_.end() - 1;
    if (!list->front().is_ahead && list->front().task.use_count() == 1) {  // the pair is gone
      list->pop_front();
      continue;
    }
    if (is_search && Clock::now() < list->front().search_due) {
      added_.wait_until(lock, list->front().search_due);
      continue;
    }
    Entry entry = std::move(list->front());
    list->pop_front();
    lock.unlock();
    alone.execute([&] {
      if (is_search) {
        entry.task->makeSearch();
      } else {
        entry.task->makeNiches();
      }
    });
    lock.lock();
    if (!is_search && !entry.is_ahead) waiting_.back().push_back(std::move(entry));
  }
}

NichePreparation::Lists::iterator NichePreparation::first() {
  return std::find_if(waiting_.begin(), waiting_.end(), [](const auto& list) { return !list.empty(); });
}

}  // namespace concave_distance

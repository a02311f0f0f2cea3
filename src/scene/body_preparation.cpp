#include "body_preparation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>

#include "concave_distance/search/prepare_search.h"
#include "distance/niches/convex_pair.h"
#include "mesh/trees/normal_cone_tree.h"
#include "near_pairs.h"
#include "solver_threads.h"

namespace concave_distance {
namespace {

constexpr std::size_t kPieces = 3;  // of a body

}  // namespace

void makeCommonParts(const BodyMesh& body) {
  body.adjacency();
  body.pieces();
  body.hullGap();
}

bool needsSearch(const BodyMesh& a, const BodyMesh& b, const TrackerParameters& parameters) {
  if (a.shape() != nullptr && b.shape() != nullptr) return false;
  return parameters.keep_through_material || parameters.hidden || !detail::areConvex(a, b);
}

BodyPreparation::BodyPreparation(const PreparationSettings& settings, WorkLimit::Clock::time_point end,
                                 const std::atomic<bool>* stop)
    : settings_(settings), end_(end), stop_(stop) {}

std::size_t BodyPreparation::placeOf(const BodyMesh& mesh) {
  const auto [found, is_new] = place_of_.emplace(&mesh, bodies_.size());
  if (is_new) bodies_.push_back({&mesh});
  return found->second;
}

void BodyPreparation::add(const BodyMesh& a, const BodyMesh& b, const TrackerParameters& parameters) {
  pairs_.push_back({placeOf(a), placeOf(b), parameters});
}

void BodyPreparation::addAhead(const Scene& scene) {
  for (const std::size_t i : scene.rules.allBodies().indices()) {
    const SceneBody& body = scene.bodies[i];
    if (!body.mesh) continue;
    const std::size_t place = placeOf(*body.mesh);
    ahead_.push_back({place, place, scene.defaults.pairs.tracker});
  }
}

bool BodyPreparation::mayBegin() const {
  const bool is_stopped = stop_ != nullptr && *stop_;
  return !is_stopped && WorkLimit::Clock::now() < end_;
}

void BodyPreparation::report(std::size_t pieces) {
  done_ += pieces;
  if (settings_.progress) settings_.progress(done_, kPieces * bodies_.size());
}

// A mesh is in the hands of one thread at a time, so that none waits for another.
template <typename Make>
void BodyPreparation::makeEach(const Make& make) {
  std::mutex mutex;
  tbb::parallel_for(
      std::size_t{0}, bodies_.size(),
      [&](std::size_t i) {
        bodies_[i].is_left = bodies_[i].is_left || !mayBegin();
        if (bodies_[i].is_left) return;
        make(bodies_[i]);
        const std::lock_guard<std::mutex> lock(mutex);
        report(1);
      },
      tbb::simple_partitioner());
}

void BodyPreparation::decide() {
  for (const Pair& pair : pairs_) decide(pair);
  // Beside one body that is not convex all have their niches looked for.
  const auto concave = std::find_if(ahead_.begin(), ahead_.end(), [&](const Pair& pair) {
    const Body& body = bodies_[pair.a];
    return !body.is_left && needsSearch(body.mesh->asSolved(), body.mesh->asSolved(), pair.parameters);
  });
  for (const Pair& pair : ahead_) {
    decide({pair.a, concave != ahead_.end() ? concave->a : pair.a, pair.parameters});
  }
}

void BodyPreparation::decide(const Pair& pair) {
  if (bodies_[pair.a].is_left || bodies_[pair.b].is_left) return;
  const bool proves = provesDistance(pair.parameters.accuracy);
  const BodyMesh& a = bodies_[pair.a].mesh->asSolved();
  const BodyMesh& b = bodies_[pair.b].mesh->asSolved();
  if (proves && !needsSearch(a, b, pair.parameters)) return;
  for (const std::size_t place : {pair.a, pair.b}) {
    Body& body = bodies_[place];
    if (pair.parameters.accuracy != AccuracyLevel::Nodes)
      (pair.parameters.keep_through_material ? body.needs_both_sides : body.needs_cones) = true;
    if (!proves || pair.parameters.search_share > 0.0) body.needs_grid = true;
  }
}

// Some at a time, each with its parts in parallel, so that the limit is asked in between.
void BodyPreparation::makeGrids() {
  const auto at_once = static_cast<std::size_t>(solverThreads(settings_.threads));
  std::vector<const BodyMesh*> some;
  for (std::size_t i = 0; i < bodies_.size(); i += at_once) {
    const std::size_t end = std::min(bodies_.size(), i + at_once);
    some.clear();
    for (std::size_t k = i; k < end; ++k) {
      bodies_[k].is_left = bodies_[k].is_left || (bodies_[k].needs_grid && !mayBegin());
      if (bodies_[k].needs_grid && !bodies_[k].is_left) some.push_back(&bodies_[k].mesh->asSolved());
    }
    prepareSearch(some);
    report(end - i);
  }
}

bool BodyPreparation::run() {
  tbb::task_arena arena = makeSolverArena(settings_.threads);
  arena.execute([&] {
    makeEach([](Body& body) { makeCommonParts(body.mesh->asSolved()); });
    decide();
    makeEach([](Body& body) {
      if (body.needs_cones) body.mesh->asSolved().prepareNiches(NormalSides::Outside);
      if (body.needs_both_sides) body.mesh->asSolved().prepareNiches(NormalSides::Both);
    });
    makeGrids();
  });
  return std::none_of(bodies_.begin(), bodies_.end(), [](const Body& body) { return body.is_left; });
}

void BodyPreparation::count(PreparationCounts& counts) const {
  counts.bodies = bodies_.size();
  for (const Body& body : bodies_) {
    counts.left += body.is_left ? 1 : 0;
  }
}

}  // namespace concave_distance

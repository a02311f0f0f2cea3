#include "niche_questions.h"

#include <algorithm>
#include <map>
#include <set>

namespace concave_distance::evaluation {
namespace {

/// Each place once, with its number.
class Places {
 public:
  std::size_t numberOf(const TrianglePlace& place) {
    const std::uint64_t key = std::uint64_t{place.first.value} << 32U | place.second.value;
    const auto [found, is_new] = numbers_.emplace(key, places_.size());
    if (is_new) places_.push_back(place);
    return found->second;
  }
  std::vector<TrianglePlace> take() { return std::move(places_); }

 private:
  std::map<std::uint64_t, std::size_t> numbers_;
  std::vector<TrianglePlace> places_;
};

double share(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 1.0;
}

}  // namespace

void NicheQuestions::ask(std::size_t instant, std::size_t run, FoundPlaces places) {
  asked_[instant].push_back({run, std::move(places)});
}

void NicheQuestions::settle(std::vector<TrialRecord>& records) const {
  for (std::size_t k = 0; k < asked_.size(); ++k) {
    const InstantTruth& instant = scene_->instants[k];
    Places places;
    for (const Asked& asked : asked_[k]) {
      for (const auto* list : {&asked.places.reported, &asked.places.met}) {
        for (const TrianglePlace& place : *list) places.numberOf(place);
      }
    }
    Places numbers = places;
    LocalMinimaRequest request;
    request.cutoff = instant.niche_cutoff;
    request.asked_pairs = places.take();
    const LocalMinima truth = findLocalMinima(*scene_->a, *scene_->b, instant.a_from_b, request);
    const auto owners_of = [&](const std::vector<TrianglePlace>& list) {
      std::set<std::size_t> owners;
      for (const TrianglePlace& place : list) owners.insert(truth.owners[numbers.numberOf(place)]);
      owners.erase(LocalMinima::kNoOwner);
      return owners;
    };
    const double weight = 1.0 / static_cast<double>(asked_.size());
    for (const Asked& asked : asked_[k]) {
      const std::set<std::size_t> reported = owners_of(asked.places.reported);
      std::set<std::size_t> met = owners_of(asked.places.met);
      met.insert(reported.begin(), reported.end());  // who descends nowhere keeps no list of minima
      TrialRecord& record = records[asked.run];
      record.recall += weight * share(reported.size(), truth.niches.size());
      record.precision += weight * share(reported.size(), asked.places.reported.size());
      record.archive_recall += weight * share(met.size(), truth.niches.size());
      const bool has_nearest =
          std::any_of(met.begin(), met.end(), [&](std::size_t niche) { return isNearest(instant, niche); });
      record.nearest += has_nearest ? weight : 0.0;
    }
  }
}

}  // namespace concave_distance::evaluation

#include "niche_questions.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/pair_key.h"

namespace concave_distance::evaluation {
namespace {

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
    const std::vector<LocalMinimum>& minima = instant.minima;
    const SurfaceRegions regions(*scene_->a, *scene_->b, instant.a_from_b, minima);
    const std::size_t niche_count = nicheCount(instant);
    std::map<std::tuple<std::uint64_t, double>, std::size_t> known;  // runs find the same places again
    const auto owner_of = [&](const FoundPlace& place) {
      const auto [entry, is_new] =
          known.emplace(std::make_tuple(pairKey(place.triangle_a, place.triangle_b), place.distance),
                        SurfaceRegions::kNoOwner);
      // Beyond the cutoff not every minimum is known.
      if (is_new && place.distance <= instant.niche_cutoff) entry->second = regions.ownerOf(place);
      return entry->second;
    };
    const auto owners_of = [&](const std::vector<FoundPlace>& list) {
      std::set<std::size_t> owners;
      for (const FoundPlace& place : list) {
        const std::size_t owner = owner_of(place);
        if (owner != SurfaceRegions::kNoOwner && isNiche(instant, minima[owner])) owners.insert(owner);
      }
      return owners;
    };
    const double weight = 1.0 / static_cast<double>(asked_.size());
    for (const Asked& asked : asked_[k]) {
      const std::set<std::size_t> reported = owners_of(asked.places.reported);
      std::set<std::size_t> met = owners_of(asked.places.met);
      met.insert(reported.begin(), reported.end());  // who descends nowhere keeps no list of minima
      TrialRecord& record = records[asked.run];
      record.recall += weight * share(reported.size(), niche_count);
      record.precision += weight * share(reported.size(), asked.places.reported.size());
      record.archive_recall += weight * share(met.size(), niche_count);
      const bool has_nearest = std::any_of(met.begin(), met.end(), [&](std::size_t niche) {
        return isNearest(instant, minima[niche].distance);
      });
      record.nearest += has_nearest ? weight : 0.0;
    }
  }
}

}  // namespace concave_distance::evaluation

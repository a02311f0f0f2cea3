#include "niche_archive.h"

#include <algorithm>
#include <utility>

namespace concave_distance {

namespace {

bool isWithin(const NicheRecord& record, const Eigen::Vector3d& point_a_in_a,
              const Eigen::Vector3d& point_b_in_b, double tolerance) {
  const double squared_tolerance = tolerance * tolerance;
  return (record.niche.point_a_in_a - point_a_in_a).squaredNorm() <= squared_tolerance &&
         (record.point_b_in_b - point_b_in_b).squaredNorm() <= squared_tolerance;
}

}  // namespace

NicheRecord* NicheArchive::findSamePlace(const Eigen::Vector3d& point_a_in_a,
                                         const Eigen::Vector3d& point_b_in_b, double tolerance) {
  for (NicheRecord& record : records_) {
    if (isWithin(record, point_a_in_a, point_b_in_b, tolerance)) return &record;
  }
  return nullptr;
}

void NicheArchive::keepUnchanged(double elapsed) {
  for (NicheRecord& record : records_) {
    record.niche.closing_speed = elapsed > 0.0 ? 0.0 : kNotComputed;
    record.niche.origin = NicheOrigin::Inherited;
  }
}

void NicheArchive::settle() {
  // Records are large and mostly in order already: the order is found on small keys, and each record that is
  // out of place moves once.
  const auto before = [](const Key& l, const Key& r) {
    return l.distance != r.distance ? l.distance < r.distance : l.id < r.id;
  };
  order_.clear();
  for (std::size_t i = 0; i < records_.size(); ++i) {
    order_.push_back({records_[i].niche.distance, records_[i].niche.id, i});
  }
  if (std::is_sorted(order_.begin(), order_.end(), before)) {
    return;
  }
  std::sort(order_.begin(), order_.end(), before);
  for (std::size_t start = 0; start < order_.size(); ++start) {
    if (order_[start].from == start) {
      continue;
    }
    const NicheRecord displaced = records_[start];
    std::size_t to = start;
    while (order_[to].from != start) {
      const std::size_t from = order_[to].from;
      records_[to] = records_[from];
      order_[to].from = to;
      to = from;
    }
    records_[to] = displaced;
    order_[to].from = to;
  }
}

std::uint64_t NicheArchive::unite(std::size_t survivor, std::size_t loser, std::vector<NicheEvent>& events) {
  NicheRecord& kept = records_[survivor];
  NicheRecord& lost = records_[loser];
  if (lost.niche.distance < kept.niche.distance) {
    std::swap(kept, lost);
  }
  // `kept` has the deeper place; give it the older identity.
  if (lost.niche.id < kept.niche.id && (!lost.reported || kept.niche.distance >= lost.least_distance)) {
    std::swap(kept.niche.id, lost.niche.id);
    std::swap(kept.niche.birth_cycle, lost.niche.birth_cycle);
    std::swap(kept.reported, lost.reported);
    std::swap(kept.least_distance, lost.least_distance);
  }
  const std::uint64_t living = kept.niche.id;
  if (lost.reported) {
    events.push_back({NicheEvent::Kind::Merge, lost.niche.id, living});
  }
  lost = records_.back();
  records_.pop_back();
  return living;
}

void NicheArchive::remove(std::size_t i, std::vector<NicheEvent>& events) {
  if (records_[i].reported) {
    events.push_back({NicheEvent::Kind::Death, records_[i].niche.id, 0});
  }
  records_[i] = records_.back();
  records_.pop_back();
}

}  // namespace concave_distance

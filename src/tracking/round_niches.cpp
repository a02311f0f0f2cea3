#include "round_niches.h"

#include <algorithm>
#include <cmath>

#include "distance/bound/closest_point.h"
#include "distance/bound/round_certificate.h"
#include "distance/niches/niche_properties.h"
#include "mesh/surface/round_geometry.h"

namespace concave_distance {
namespace {

bool areShapes(const PairFrame& frame) {
  return frame.a.shape() != nullptr && frame.b.shape() != nullptr;
}

/// The meshes' facets may be parallel where the solid touches in a point or along a line.
void limitKind(const PairFrame& frame, TrackedNiche& niche) {
  for (const BodyMesh* body : {&frame.a, &frame.b}) {
    const RoundShape* shape = body->shape();
    if (shape == nullptr) continue;
    if (!detail::hasSide(*shape)) {
      niche.kind = NicheKind::Point;
      niche.extent = 0.0;
    } else if (!detail::hasFlatEnds(*shape) && niche.kind == NicheKind::Patch) {
      niche.kind = NicheKind::Segment;
    }
  }
}

}  // namespace

double RoundNiches::meshExcess(const PairFrame& frame) {
  double excess = 0.0;
  for (const BodyMesh* body : {&frame.a, &frame.b}) {
    if (body->shape() != nullptr) excess += body->shape()->chord_error;
  }
  return excess;
}

void RoundNiches::update(const PairFrame& frame, const NicheArchive& of_meshes, const Cycle& cycle,
                         std::vector<NicheEvent>& events) {
  next_.clear();
  next_index_.clear();
  mesh_ids_.clear();
  if (areShapes(frame)) {
    placeShapes(frame);
  } else {
    place(frame, of_meshes);
  }
  identify(cycle);
  endOthers(events);
  members_.clear();
  for (std::size_t i = 0; i < mesh_ids_.size(); ++i)
    members_.push_back({mesh_ids_[i], next_[next_index_[i]].niche.id});
  archive_.records().swap(next_);
  archive_.settle();
}

void RoundNiches::place(const PairFrame& frame, const NicheArchive& of_meshes) {
  for (const NicheRecord& known : of_meshes.records()) {
    NicheRecord record = known;
    const WitnessPair& start = known.niche.witness;
    placeRecord(record, frame,
                refineRoundWitness(frame.a, frame.b, frame.a_from_b, {start.triangle_a, start.triangle_b}));
    record.reported = false;
    limitKind(frame, record.niche);
    const auto same = std::find_if(next_.begin(), next_.end(),
                                   [&](const NicheRecord& other) { return areOne(frame, other, record); });
    mesh_ids_.push_back(known.niche.id);
    next_index_.push_back(static_cast<std::size_t>(same - next_.begin()));
    if (same == next_.end()) next_.push_back(record);
  }
}

void RoundNiches::placeShapes(const PairFrame& frame) {
  NicheRecord& record = next_.emplace_back();
  placeRecord(record, frame, refineRoundWitness(frame.a, frame.b, frame.a_from_b, {}));
  record.niche.origin = NicheOrigin::Proven;
  record.niche.proven_local_minimum = true;
  mesh_ids_.push_back(0);
  next_index_.push_back(0);
}

// At one place, or at equal distances with the same distance, and the mesh, all between them.
bool RoundNiches::areOne(const PairFrame& frame, const NicheRecord& l, const NicheRecord& r) const {
  const bool a_is_shape = frame.a.shape() != nullptr;
  const double tolerance = frame.samePlaceTolerance();
  const Eigen::Vector3d& on_l = a_is_shape ? l.point_b_in_b : l.niche.point_a_in_a;
  const Eigen::Vector3d& on_r = a_is_shape ? r.point_b_in_b : r.niche.point_a_in_a;
  if ((on_l - on_r).squaredNorm() <= tolerance * tolerance) return true;
  const double level = kPlateauTolerance * frame.diameters();
  if (std::abs(l.niche.distance - r.niche.distance) > level) return false;
  const BodyMesh& mesh = a_is_shape ? frame.b : frame.a;
  const RoundAndMesh pair = a_is_shape ? RoundAndMesh(*frame.a.shape(), mesh, frame.bFromA())
                                       : RoundAndMesh(*frame.b.shape(), mesh, frame.a_from_b);
  const Eigen::Vector3d middle = 0.5 * (on_l + on_r);
  const TriangleIndex hint = a_is_shape ? l.niche.witness.triangle_b : l.niche.witness.triangle_a;
  return detail::signedDistance(pair.shape, pair.inShape(middle)) >= l.niche.distance - level &&
         closestPoint(mesh, middle, hint).squared_distance <= tolerance * tolerance;
}

void RoundNiches::identify(const Cycle& cycle) {
  for (std::size_t i = 0; i < next_.size(); ++i) next_[i].niche.id = 0;
  for (std::size_t i = 0; i < next_.size(); ++i) {
    if (const NicheRecord* known = heritageOf(i)) inherit(*known, cycle, next_[i]);
  }
  // The meshes' niches may be new where the exact one goes on: over the facets of a ball that rolls.
  const double reach = 4.0 * cycle.displacement;
  for (NicheRecord& record : next_) {
    if (record.niche.id != 0) continue;
    const NicheRecord* nearest = nullptr;
    double least = reach;
    for (const NicheRecord& known : archive_.records()) {
      const double moved = (known.niche.point_a_in_a - record.niche.point_a_in_a).norm();
      if (moved > least || isTaken(known.niche.id)) continue;
      least = moved;
      nearest = &known;
    }
    if (nearest != nullptr) {
      inherit(*nearest, cycle, record);
      continue;
    }
    record.niche.id = archive_.takeId();
    record.niche.birth_cycle = cycle.number;
    record.niche.closing_speed = kNotComputed;
    if (record.niche.origin == NicheOrigin::Inherited) record.niche.origin = NicheOrigin::FromCones;
  }
}

const NicheRecord* RoundNiches::heritageOf(std::size_t next) const {
  const NicheRecord* oldest = nullptr;
  for (std::size_t i = 0; i < mesh_ids_.size(); ++i) {
    if (next_index_[i] != next) continue;
    const auto member = std::find_if(members_.begin(), members_.end(),
                                     [&](const Member& m) { return m.mesh_id == mesh_ids_[i]; });
    if (member == members_.end() || isTaken(member->id)) continue;
    if (oldest != nullptr && oldest->niche.id < member->id) continue;
    const auto known = std::find_if(archive_.records().begin(), archive_.records().end(),
                                    [&](const NicheRecord& record) { return record.niche.id == member->id; });
    if (known != archive_.records().end()) oldest = &*known;
  }
  return oldest;
}

bool RoundNiches::isTaken(std::uint64_t id) const {
  return std::any_of(next_.begin(), next_.end(),
                     [&](const NicheRecord& record) { return record.niche.id == id; });
}

void RoundNiches::inherit(const NicheRecord& known, const Cycle& cycle, NicheRecord& record) {
  record.niche.id = known.niche.id;
  record.niche.birth_cycle = known.niche.birth_cycle;
  record.niche.origin = NicheOrigin::Inherited;
  record.niche.closing_speed =
      cycle.elapsed > 0.0 ? (known.niche.distance - record.niche.distance) / cycle.elapsed : kNotComputed;
  record.reported = known.reported;
}

void RoundNiches::endOthers(std::vector<NicheEvent>& events) const {
  for (const NicheRecord& known : archive_.records()) {
    if (!known.reported || isTaken(known.niche.id)) continue;
    std::uint64_t into = 0;
    for (std::size_t i = 0; i < mesh_ids_.size(); ++i) {
      const bool was_member = std::any_of(members_.begin(), members_.end(), [&](const Member& m) {
        return m.mesh_id == mesh_ids_[i] && m.id == known.niche.id;
      });
      if (was_member) into = next_[next_index_[i]].niche.id;
    }
    events.push_back({into != 0 ? NicheEvent::Kind::Merge : NicheEvent::Kind::Death, known.niche.id, into});
  }
}

void RoundNiches::clear() {
  archive_.clear();
  members_.clear();
}

}  // namespace concave_distance

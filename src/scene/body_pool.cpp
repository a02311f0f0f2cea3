#include "body_pool.h"

namespace concave_distance {

std::shared_ptr<const BodyMesh> BodyPool::find(const ContentKey& key) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = meshes_.find({key.low, key.high});
  return found == meshes_.end() ? nullptr : found->second.lock();
}

std::shared_ptr<const BodyMesh> BodyPool::insert(const ContentKey& key,
                                                 std::shared_ptr<const BodyMesh> made) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::weak_ptr<const BodyMesh>& place = meshes_[{key.low, key.high}];
  if (std::shared_ptr<const BodyMesh> other = place.lock()) return other;  // another thread was faster
  place = made;
  sweep();
  return made;
}

std::optional<RepairedBody> BodyPool::findRepaired(const ContentKey& source) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = repaired_.find({source.low, source.high});
  if (found == repaired_.end()) return std::nullopt;
  std::shared_ptr<const BodyMesh> mesh = found->second.mesh.lock();
  if (!mesh) return std::nullopt;
  return RepairedBody{std::move(mesh), found->second.report};
}

void BodyPool::insertRepaired(const ContentKey& source, const RepairedBody& body) {
  const std::lock_guard<std::mutex> lock(mutex_);
  repaired_[{source.low, source.high}] = {body.mesh, body.report};
  sweep();
}

void BodyPool::sweep() {
  if (--inserts_until_sweep_ != 0) return;
  for (auto entry = meshes_.begin(); entry != meshes_.end();) {
    entry = entry->second.expired() ? meshes_.erase(entry) : std::next(entry);
  }
  for (auto entry = repaired_.begin(); entry != repaired_.end();) {
    entry = entry->second.mesh.expired() ? repaired_.erase(entry) : std::next(entry);
  }
  // A sweep costs no more than the inserts before it.
  inserts_until_sweep_ = meshes_.size() + repaired_.size() + 64;
}

}  // namespace concave_distance

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
  if (--inserts_until_sweep_ == 0) {
    for (auto entry = meshes_.begin(); entry != meshes_.end();) {
      entry = entry->second.expired() ? meshes_.erase(entry) : std::next(entry);
    }
    inserts_until_sweep_ = meshes_.size() + 64;  // so that a sweep costs no more than the inserts before it
  }
  return made;
}

}  // namespace concave_distance

#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "base/content_hash.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "mesh/metric_memory.h"

namespace concave_distance {

/// A body's mesh with what was repaired of it.
struct RepairedBody {
  std::shared_ptr<const BodyMesh> mesh;
  RepairReport report;
};

/// Shares meshes between the bodies of a scene: bodies with the same surface and search settings use one
/// mesh, one source is read and repaired once, and all matrices of mesh metrics have one limit. Thread-safe.
class BodyPool {
 public:
  /// @param metric_memory_limit bytes
  explicit BodyPool(std::size_t metric_memory_limit)
      : metric_memory_(std::make_shared<MetricMemory>(metric_memory_limit)) {}

  const std::shared_ptr<MetricMemory>& metricMemory() const { return metric_memory_; }

  /// The mesh with this key if a body still has it, else the result of `make`, which is called
  /// without a lock.
  template <typename Make>
  std::shared_ptr<const BodyMesh> share(const ContentKey& key, const Make& make) {
    if (std::shared_ptr<const BodyMesh> known = find(key)) return known;
    std::shared_ptr<const BodyMesh> made = make();
    return insert(key, std::move(made));
  }

  /// Returns what was made from the source with this key, if a body still has the mesh.
  std::optional<RepairedBody> findRepaired(const ContentKey& source);
  void insertRepaired(const ContentKey& source, const RepairedBody& body);

 private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;
  struct Repaired {
    std::weak_ptr<const BodyMesh> mesh;
    RepairReport report;
  };
  std::shared_ptr<const BodyMesh> find(const ContentKey& key);
  std::shared_ptr<const BodyMesh> insert(const ContentKey& key, std::shared_ptr<const BodyMesh> made);
  void sweep();

  std::shared_ptr<MetricMemory> metric_memory_;
  std::mutex mutex_;
  std::map<Key, std::weak_ptr<const BodyMesh>> meshes_;
  std::map<Key, Repaired> repaired_;  ///< by source
  std::size_t inserts_until_sweep_ = 64;
};

}  // namespace concave_distance

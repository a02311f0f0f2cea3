#pragma once

#include <optional>
#include <utility>

#include "base/content_hash.h"
#include "concave_distance/mesh/preparation_cache.h"
#include "concave_distance/mesh/repair/repair_mesh.h"

namespace concave_distance {

/// A hasher to begin keys with: it holds a fingerprint of the sources, the compiler and its options that
/// prepare bodies, so that no file outlives a change of the program.
ContentHasher preparationHasher();

/// Adds the options of repairMesh().
void addRepairOptions(ContentHasher& hasher, const RepairOptions& options);

/// The repaired surface with this key if the cache has it. @param cache nullptr: none
std::optional<RepairedMesh> findRepairedMesh(PreparationCache* cache, const ContentKey& key);
void storeRepairedMesh(PreparationCache* cache, const ContentKey& key, const RepairedMesh& repaired);

/// A repaired surface with the key of the very files it was made from.
struct KeyedMesh {
  RepairedMesh repaired;
  std::optional<ContentKey> key;  ///< nothing: it has none
};

/// The cached surface or a made one, which is then stored.
/// @param key_of gives std::optional<ContentKey>, nothing for what has none
/// @param make gives a KeyedMesh; files may change after key_of
template <typename KeyOf, typename Make>
KeyedMesh repairedMeshThrough(PreparationCache* cache, KeyOf key_of, Make make) {
  const std::optional<ContentKey> key = cache != nullptr ? key_of() : std::nullopt;
  if (key) {
    if (std::optional<RepairedMesh> found = findRepairedMesh(cache, *key)) return {std::move(*found), key};
  }
  KeyedMesh made = make();
  if (key && made.key == key) storeRepairedMesh(cache, *key, made.repaired);
  return made;
}

}  // namespace concave_distance

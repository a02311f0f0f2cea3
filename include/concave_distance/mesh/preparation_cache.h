#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "concave_distance/base/content_hash.h"
#include "concave_distance/mesh/repair_mesh.h"

namespace concave_distance {

/// A folder with what bodies cost to make ready: repaired surfaces, topologies, trees and hierarchies, search
/// nodes, mesh metrics, a file each, named by the key of all that it was made from and of the program's
/// sources that made it. A file is used when every check of it holds (ArrayFileReader), else it is made anew
/// and replaced. Safe between threads and processes. Anybody may delete files at any time.
class PreparationCache {
 public:
  /// @param folder made when something is stored
  explicit PreparationCache(std::string folder);

  /// $XDG_CACHE_HOME/concave_distance, else ~/.cache/concave_distance; empty when the environment has
  /// neither.
  static std::string defaultFolder();

  const std::string& folder() const { return folder_; }
  /// Path of one part. @param part its name, the file's ending
  std::string fileOf(const ContentKey& key, const char* part) const;
  /// False when the folder is not there and cannot be made.
  bool makeFolder();
  /// Remembers the first thing that could not be stored.
  void noteProblem(const std::string& problem);
  /// One line, once: why nothing (more) is stored; empty when all went well or it was asked for before.
  std::string takeProblem();

 private:
  std::string folder_;
  std::mutex mutex_;
  std::string problem_;
  bool reported_ = false;
};

using PreparationCachePointer = std::shared_ptr<PreparationCache>;

/// From what a user says: "off" (no cache: nullptr), a folder, or "" (defaultFolder()).
PreparationCachePointer openPreparationCache(const std::string& folder_or_off);

/// A hasher to begin keys with: it holds a fingerprint of the sources, the compiler and its options that
/// prepare bodies, so that no file outlives a change of the program.
ContentHasher preparationHasher();

/// Adds what repairMesh() is told.
void addRepairOptions(ContentHasher& hasher, const RepairOptions& options);

/// The repaired surface with this key if the cache has it. @param cache nullptr: none
std::optional<RepairedMesh> findRepairedMesh(PreparationCache* cache, const ContentKey& key);
void storeRepairedMesh(PreparationCache* cache, const ContentKey& key, const RepairedMesh& repaired);

/// A repaired surface with the key of the very files it was made from.
struct KeyedMesh {
  RepairedMesh repaired;
  std::optional<ContentKey> key;  ///< nothing: not to be cached
};

/// The cached surface or a made one, which is then stored.
/// @param key_of gives std::optional<ContentKey>, nothing for what is not to be cached
/// @param make gives a KeyedMesh, with a key where its argument asks for one; files may change after key_of
template <typename KeyOf, typename Make>
RepairedMesh repairedMeshThrough(PreparationCache* cache, KeyOf key_of, Make make) {
  const std::optional<ContentKey> key = cache != nullptr ? key_of() : std::nullopt;
  if (key) {
    if (std::optional<RepairedMesh> found = findRepairedMesh(cache, *key)) return std::move(*found);
  }
  KeyedMesh made = make(key.has_value());
  if (key && made.key == key) storeRepairedMesh(cache, *key, made.repaired);
  return std::move(made.repaired);
}

}  // namespace concave_distance

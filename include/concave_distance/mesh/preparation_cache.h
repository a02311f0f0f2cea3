#pragma once

#include <memory>
#include <mutex>
#include <string>

namespace concave_distance {

struct ContentKey;

/// A folder with what bodies cost to make ready: repaired surfaces, topologies, trees and hierarchies, search
/// nodes, mesh metrics, a file each, named by the key of all that it was made from and of the program's
/// sources that made it. A file is used when every check of it holds (ArrayFileReader), else it is made anew
/// and replaced. Safe between threads and processes. Anybody may delete files at any time.
class PreparationCache {
 public:
  /// @param folder made when something is stored
  explicit PreparationCache(std::string folder);

  /// $XDG_CACHE_HOME/concave_distance, else ~/.cache/concave_distance; empty when the
  /// environment has neither.
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

/// Opens the cache that a user names: "off" (none: nullptr), a folder, or "" (defaultFolder()).
PreparationCachePointer openPreparationCache(const std::string& folder_or_off);

}  // namespace concave_distance

#include "concave_distance/mesh/preparation_cache.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/content_hash.h"
#include "preparation_fingerprint.h"
#include "repaired_mesh_cache.h"

namespace concave_distance {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

}  // namespace

PreparationCache::PreparationCache(std::string folder) : folder_(std::move(folder)) {}

std::string PreparationCache::defaultFolder() {
  // The XDG base directory specification: a relative path is to be ignored.
  if (const std::string cache = environment("XDG_CACHE_HOME"); !cache.empty() && cache.front() == '/') {
    return cache + "/concave_distance";
  }
  const std::string home = environment("HOME");
  return home.empty() ? std::string() : home + "/.cache/concave_distance";
}

std::string PreparationCache::fileOf(const ContentKey& key, const char* part) const {
  return folder_ + '/' + key.text() + '.' + part;
}

bool PreparationCache::makeFolder() {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (!error) return true;
  noteProblem("cannot make the folder " + folder_ + ": " + error.message());
  return false;
}

void PreparationCache::noteProblem(const std::string& problem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (problem_.empty()) problem_ = problem;
}

std::string PreparationCache::takeProblem() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (problem_.empty() || std::exchange(reported_, true)) return {};
  return "prepared bodies are not stored, the next start takes as long as this one: " + problem_;
}

PreparationCachePointer openPreparationCache(const std::string& folder_or_off) {
  if (folder_or_off == "off") return nullptr;
  std::string folder = folder_or_off.empty() ? PreparationCache::defaultFolder() : folder_or_off;
  return folder.empty() ? nullptr : std::make_shared<PreparationCache>(std::move(folder));
}

void addRepairOptions(ContentHasher& hasher, const RepairOptions& options) {
  hasher.add(options.weld_tolerance).add(options.orient);
}

ContentHasher preparationHasher() {
  ContentHasher hasher;
  hasher.add(detail::kPreparationFingerprint);
  return hasher;
}

}  // namespace concave_distance

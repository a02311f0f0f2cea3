#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "select_pairs.h"

namespace concave_distance::detail {

using SourceFlags = std::vector<bool>;  ///< one entry each source

/// The two sides of an entry.
struct EntrySides {
  std::size_t number = 0;           ///< of the entry in the file
  const PairSpec* entry = nullptr;  ///< nullptr: of `disable`, or every body against every other
  SourceFlags a;
  SourceFlags b;

  bool isOrdered() const { return entry != nullptr && entry->is_ordered; }
  bool isWatched() const { return entry == nullptr || entry->is_watched; }
  bool hold(std::size_t source_a, std::size_t source_b) const { return a[source_a] && b[source_b]; }
  /// @param earlier the one of two sources that comes first
  bool holdPair(std::size_t earlier, std::size_t later) const {
    return hold(earlier, later) || (!isOrdered() && hold(later, earlier));
  }
  bool holdEitherWay(std::size_t source_a, std::size_t source_b) const {
    return hold(source_a, source_b) || hold(source_b, source_a);
  }
};

/// Makes rules of the entries that are about more than one pair, and of `disable`.
class EntryRules {
 public:
  /// Both outlive it.
  EntryRules(const SceneSpec& spec, const SceneParts& parts) : spec_(spec), parts_(parts) {}

  /// Holds what the entries say about two sources.
  struct Said {
    PairRule rule;
    std::size_t number = 0;  ///< of the first entry
    std::vector<const PairSpec*> entries;
  };

  void add(EntrySides sides) { general_.push_back(std::move(sides)); }
  void disable(EntrySides sides) { disabled_.push_back(std::move(sides)); }

  bool isWatched(std::size_t source_a, std::size_t source_b) const;
  bool isDisabled(std::size_t source_a, std::size_t source_b) const;
  Said saidOf(std::size_t earlier, std::size_t later) const;
  /// Returns the defaults with what the entries say laid over them, in their order.
  /// @param enabled stays as it is where no entry says it. @throws Error for settings that do not go together
  PairSettings settingsOf(const std::vector<const PairSpec*>& entries, std::size_t a, std::size_t b,
                          std::optional<bool>& enabled) const;
  /// Sets classes and rules: sources that all sides hold alike are one class.
  void makeRules(PairSelection& result) const;

 private:
  const SceneSpec& spec_;
  const SceneParts& parts_;
  std::vector<EntrySides> general_;
  std::vector<EntrySides> disabled_;
};

}  // namespace concave_distance::detail

#pragma once

#include <cstdint>
#include <optional>

namespace concave_distance {

enum class WarningState : std::uint8_t { Clear, Warning, Unknown };

/// Follows one pair's distance against its warning distance. Below it: Warning. Above warning distance plus
/// hysteresis: Clear. Between the two the state stays. Without a distance: Unknown; when the distance comes
/// back between the two, the state from before the gap holds again.
class WarningMonitor {
 public:
  /// @param distance metres; empty when the pair could not be solved
  /// @return true when the state changed
  bool update(std::optional<double> distance, double warning_distance, double hysteresis);
  WarningState state() const { return state_; }
  /// Sets a pair that nobody watches any more to Clear, as at the start.
  void reset();

 private:
  WarningState state_ = WarningState::Clear;
  bool was_warning_ = false;
};

}  // namespace concave_distance

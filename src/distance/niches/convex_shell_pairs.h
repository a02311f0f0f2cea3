#pragma once

#include <cstdint>
#include <vector>

#include "distance/bound/certificate.h"
#include "distance/kernels/pair_frame.h"
#include "local_minima.h"

namespace concave_distance::detail {

/// Finds the local minima between two unions of convex solids from the closest points of each two of them
/// (doc/proofs.md, "Unions of convex solids"). Belongs to one pair of bodies, and keeps what each proof
/// leaves to the next pose.
class ConvexShellPairs {
 public:
  enum class Outcome : std::uint8_t {
    Complete,     ///< every minimum that can be seen has a candidate
    Unknown,      ///< the bodies are no such unions, or their shells are so nearly parallel or near that more
                  ///< has to be looked at; candidates are as before
    LimitReached  ///< candidates may be missing
  };
  /// Appends a triangle pair of every local minimum above 0 and up to the request's cutoff. The frame's
  /// facets are open.
  Outcome collect(const PairFrame& frame, const LocalMinimaRequest& request,
                  std::vector<MinimumCandidate>& candidates, WorkLimit& limit);
  void clear();

 private:
  /// Two shells and what the last proof of their distance has left.
  struct ShellPair {
    std::uint32_t a;
    std::uint32_t b;
    BoundCache cache;
    TrianglePair nearest{};  ///< of the shells' meshes
    bool has_nearest = false;
  };
  void begin(const PairFrame& frame);
  Outcome look(const PairFrame& frame, const LocalMinimaRequest& request, ShellPair& pair,
               std::vector<MinimumCandidate>& candidates, WorkLimit& limit);

  std::vector<ShellPair> pairs_;
  CertificateWorkspace workspace_;
  ExtentWorkspace extent_;
};

}  // namespace concave_distance::detail

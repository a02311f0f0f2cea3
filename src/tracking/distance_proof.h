#pragma once

#include <cstddef>
#include <optional>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "distance/bound/certificate.h"
#include "niche_placement.h"

namespace concave_distance {

/// Runs stage `prove`: the distance, with a bound that holds. It keeps what the next proof begins with.
class DistanceProof {
 public:
  DistanceProof();

  /// Proves the distance at the frame's pose.
  /// @param nearest triangles near the closest points as far as known, besides those of the last proof
  /// @param displacement metres that any point of B has moved since the last proof, at most; infinite:
  /// unknown
  void prove(const PairFrame& frame, const TrackerParameters& parameters,
             const std::optional<TrianglePair>& nearest, double displacement, WorkLimit& limit);

  const DistanceCertificate& certificate() const { return certificate_; }
  double error() const { return error_; }          ///< metres, of the certificate
  bool isSwallowed() const { return swallowed_; }  ///< one body holds a part of the other
  bool isPenetrating() const { return swallowed_ || certificate_.status == CertificateStatus::Penetrating; }

  /// Fills in distance, bound, points and status.
  void report(PairSolution& solution) const;

  void clear();
  /// Has the next proof made even where nothing has moved.
  void renew() { current_ = false; }

 private:
  CertificateWorkspace workspace_;
  BoundCache front_;
  RefinementWorkspace refinement_;
  DistanceCertificate certificate_;  ///< of the last cycle
  double error_ = 0.0;
  bool has_last_ = false;  ///< there is a last certificate
  bool current_ = false;   ///< made with the parameters as they are
  bool swallowed_ = false;
};

}  // namespace concave_distance

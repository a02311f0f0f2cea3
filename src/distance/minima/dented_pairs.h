#pragma once

#include <vector>

#include "distance/kernels/pair_frame.h"
#include "mesh/trees/normal_cone_tree.h"
#include "sweep_lists.h"

namespace concave_distance::detail {

/// Says which normal cones are looked at.
struct ConeChoice {
  ConeChoice(NormalSides of = NormalSides::Outside, bool only_beside_dents = false)
      : sides(of), beside_dents(only_beside_dents) {}

  bool operator==(const ConeChoice& other) const {
    return sides == other.sides && beside_dents == other.beside_dents;
  }

  NormalSides sides;
  /// Pairs of which neither end is beside a dent are left out (BodyMesh::dentedGroups()).
  bool beside_dents;
};

/// Tells pairs of groups that a choice leaves out.
class DentedPairs {
 public:
  DentedPairs(const PairFrame& frame, const ConeChoice& choice)
      : of_a_(choice.beside_dents ? &frame.a.dentedGroups() : nullptr),
        of_b_(choice.beside_dents ? &frame.b.dentedGroups() : nullptr) {}

  bool leavesOut(const SlotPair& pair) const {
    return of_a_ != nullptr && !(*of_a_)[pair.first] && !(*of_b_)[pair.second];
  }

 private:
  const std::vector<bool>* of_a_;
  const std::vector<bool>* of_b_;
};

}  // namespace concave_distance::detail

#include "concave_distance/base/eigen_alignment.h"

namespace concave_distance::detail {

template <int bytes>
const char EigenAlignmentOfTheLibrary<bytes>::is = 1;

template struct EigenAlignmentOfTheLibrary<EIGEN_MAX_ALIGN_BYTES>;

}  // namespace concave_distance::detail

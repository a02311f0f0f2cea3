#include "version.h"

namespace concave_distance {

std::string packageVersion() {
  return CONCAVE_DISTANCE_VERSION;
}

}  // namespace concave_distance

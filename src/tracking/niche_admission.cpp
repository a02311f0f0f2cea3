#include "niche_admission.h"

namespace concave_distance {

void uniteSamePlaces(const PairGeometry& geometry, NicheArchive& archive, std::vector<NicheEvent>& events) {
  const double tolerance = geometry.samePlaceTolerance();
  const double squared_tolerance = tolerance * tolerance;
  std::vector<NicheRecord>& records = archive.records();
  for (std::size_t i = 0; i < records.size(); ++i) {
    std::size_t k = i + 1;
    // Points that agree within the tolerance have distances that agree within twice as much.
    while (k < records.size() && records[k].niche.distance - records[i].niche.distance <= 2.0 * tolerance) {
      if ((records[k].niche.point_a_in_a - records[i].niche.point_a_in_a).squaredNorm() <=
              squared_tolerance &&
          (records[k].point_b_in_b - records[i].point_b_in_b).squaredNorm() <= squared_tolerance) {
        archive.unite(i, k, events);
        archive.settle();
        k = i;
      }
      ++k;
    }
  }
}

}  // namespace concave_distance

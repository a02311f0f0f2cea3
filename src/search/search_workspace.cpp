#include "search_workspace.h"

namespace concave_distance {
namespace {

template <typename T>
std::size_t bytesOf(const std::vector<T>& buffer) {
  return buffer.capacity() * sizeof(T);
}

}  // namespace

std::size_t SearchWorkspace::memoryBytes() const {
  return metric.memoryBytes() + basins.memoryBytes() + bytesOf(population) + bytesOf(trail) + bytesOf(order) +
         bytesOf(niches) + places.memoryBytes() + bytesOf(population_places) + census.memoryBytes() +
         bytesOf(offspring) + bytesOf(offspring_places) + offspring_is_new.capacity() / 8 +
         bytesOf(niche_counts) + bytesOf(weights) + bytesOf(selected) + bytesOf(elites) + bytesOf(peaks);
}

}  // namespace concave_distance

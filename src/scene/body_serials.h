#pragma once

#include <cstdint>
#include <unordered_map>

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// Maps serials of bodies to those that they get instead.
using Serials = std::unordered_map<std::uint64_t, std::uint64_t>;

/// Gives bodies other serials, wherever the scene names them.
void renumber(Scene& scene, const Serials& serials);

}  // namespace concave_distance::detail

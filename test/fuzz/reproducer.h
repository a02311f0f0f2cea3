#pragma once

#include <cstdint>
#include <string>

#include "fuzz/differential_scenes.h"

namespace concave_distance::test {

/// Writes a scene as a_<seed>.stl, b_<seed>.stl and poses_<seed>.csv into `folder`, and tells what was wrong
/// in report_<seed>.txt. @return the command that replays it
/// @throws Error when a file cannot be written
std::string writeReproducer(const DifferentialScene& scene, std::uint64_t seed, const std::string& report,
                            const std::string& folder);

}  // namespace concave_distance::test

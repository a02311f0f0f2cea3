#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace concave_distance::detail {

/// The unsigned number that up to eight bytes hold.
std::uint64_t wholeNumber(std::string_view bytes, bool little_endian);

/// Refuses a PLY file with less data than its header announces, or with a header that assimp would not
/// understand. Time is linear in the file's size, because every element and every list takes at least a byte.
/// @throws Error naming the file
void checkPly(std::string_view content, const std::string& path);

}  // namespace concave_distance::detail

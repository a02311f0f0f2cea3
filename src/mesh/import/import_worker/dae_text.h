#pragma once

#include <string>
#include <string_view>

namespace concave_distance::detail {

/// A DAE file as assimp 5.2 reads it correctly: in UTF-8 (from UTF-8, UTF-16 or UTF-32), without
/// comments, and without blanks before the numbers of an element, which XML allows and assimp takes for
/// the end of the list.
/// @throws Error naming the file, for what is no XML and for what makes assimp crash, hang, read beyond an
///         array or lose a part of the surface: counts that are missing, beyond the file's size or not those
///         of what follows, lists of indices with anything else in them, polygons with holes, shapes that are
///         no mesh
std::string plainDae(std::string_view content, const std::string& path);

}  // namespace concave_distance::detail

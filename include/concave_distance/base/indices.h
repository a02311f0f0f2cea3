#pragma once

#include <cstdint>
#include <functional>

namespace concave_distance {

/// Index of an element of one kind; kinds do not convert into each other.
template <typename Tag>
struct Index {
  std::uint32_t value = 0;

  constexpr Index() = default;
  constexpr explicit Index(std::uint32_t v) : value(v) {}
  constexpr explicit Index(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}
  constexpr explicit Index(int v) : value(static_cast<std::uint32_t>(v)) {}

  friend constexpr bool operator==(Index l, Index r) { return l.value == r.value; }
  friend constexpr bool operator!=(Index l, Index r) { return l.value != r.value; }
  friend constexpr bool operator<(Index l, Index r) { return l.value < r.value; }
};

struct NodeTag;
struct TriangleTag;
/// A mesh vertex: of the original surface or, where a function says so, of the search grid.
using NodeIndex = Index<NodeTag>;
/// A triangle of the original surface or, where a function says so, of the search grid.
using TriangleIndex = Index<TriangleTag>;

}  // namespace concave_distance
/// @cond
template <typename Tag>
struct std::hash<concave_distance::Index<Tag>> {
  std::size_t operator()(concave_distance::Index<Tag> index) const noexcept { return index.value; }
};  /// @endcond

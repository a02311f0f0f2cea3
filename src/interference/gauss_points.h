#pragma once

#include <array>
#include <cstddef>

namespace concave_distance::detail {

/// Gauss and Legendre's rules on [0, 1].
struct GaussPoint {
  double at;
  double weight;
};
inline constexpr std::array<GaussPoint, 3> kGaussThree{{{0.1127016653792583115, 0.2777777777777777778},
                                                        {0.5, 0.4444444444444444444},
                                                        {0.8872983346207416885, 0.2777777777777777778}}};
inline constexpr std::array<GaussPoint, 4> kGaussFour{{{0.0694318442029737124, 0.1739274225687269287},
                                                       {0.3300094782075718676, 0.3260725774312730713},
                                                       {0.6699905217924281324, 0.3260725774312730713},
                                                       {0.9305681557970262876, 0.1739274225687269287}}};
inline constexpr std::array<GaussPoint, 5> kGaussFive{{{0.0469100770306680036, 0.1184634425280945438},
                                                       {0.2307653449471584545, 0.2393143352496832340},
                                                       {0.5, 0.2844444444444444444},
                                                       {0.7692346550528415455, 0.2393143352496832340},
                                                       {0.9530899229693319964, 0.1184634425280945438}}};

/// One of the above.
struct GaussRule {
  const GaussPoint* first;
  std::size_t count;

  template <std::size_t n>
  explicit GaussRule(const std::array<GaussPoint, n>& points) : first(points.data()), count(n) {}
  const GaussPoint* begin() const { return first; }
  const GaussPoint* end() const { return first + count; }
};

/// Dunavant's rule of degree 4 (1985): barycentric coordinates and shares of the area.
struct TrianglePoint {
  double u;
  double v;
  double weight;
};
inline constexpr std::array<TrianglePoint, 6> kTriangleSix{
    {{0.108103018168070, 0.445948490915965, 0.223381589678011},
     {0.445948490915965, 0.108103018168070, 0.223381589678011},
     {0.445948490915965, 0.445948490915965, 0.223381589678011},
     {0.816847572980459, 0.091576213509771, 0.109951743655322},
     {0.091576213509771, 0.816847572980459, 0.109951743655322},
     {0.091576213509771, 0.091576213509771, 0.109951743655322}}};

}  // namespace concave_distance::detail

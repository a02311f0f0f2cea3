#pragma once

#include <concave_distance/PairContactState.h>
#include <visualization_msgs/Marker.h>

#include <cstddef>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "marker_style.h"
#include "ros/messages/published_pair.h"

namespace concave_distance {

/// Triangles of all pressures in one message; a contact whose surface does not fit any more is drawn as a
/// disc.
inline constexpr std::size_t kMostPressureTriangles = 10'000;

/// Colour of a pressure: dark blue at 0, over violet and red to orange at `end` and beyond; opaque.
std_msgs::ColorRGBA pressureColor(double pressure, double end);

/// The pressure that is drawn in the last colour, Pa.
class PressureScale {
 public:
  /// @param fixed 0: the largest pressure rounded up to a number of one digit, 1.2, 1.5 or 2.5 times a
  ///        power of ten; kept until that is exceeded or the largest pressure falls below a quarter of it
  void update(double largest, double fixed);
  /// 0 before there was a pressure.
  double end() const { return end_; }

 private:
  double end_ = 0.0;
};

/// Remembers what of a pair's contacts has been drawn.
struct DrawnPressures {
  std::vector<visualization_msgs::Marker> markers;
  std::vector<bool> has_marker;  ///< by contact
};

/// The pressure on the contacts of one pair, one TRIANGLE_LIST each, coloured at its corners: namespace
/// `<pair>/pressure`, ids as contactMarkers(). Of the two surfaces in a contact that is drawn which belongs
/// to the body that is not seen through (seenThrough), lifted from it; the other one where there is none of
/// it or it has too many triangles.
/// @param contacts of this pair's last cycle
/// @param scale of the colours, > 0 Pa
/// @param triangles_left that may be drawn; reduced by those that are
DrawnPressures pressureMarkers(const Scene& scene, const ScenePair& scene_pair, const PublishedPair& pair,
                               const PairContactState& contacts, const MarkerStyle& style, double scale,
                               std::size_t& triangles_left);

/// The largest of all pressures in the contacts, Pa; 0 without any.
double largestPressure(const std::vector<PairContactState>& contacts);

}  // namespace concave_distance

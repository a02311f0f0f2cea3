#include "text_list.h"

#include <cstddef>
#include <string>

#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

constexpr double kSlope = 0.35;          // tangent of the pitch up to which the list hides nothing
constexpr double kLift = 1.5;            // height of the list above the scene, in letters
constexpr double kRvizLineSpace = 0.01;  // m between the rows of one text in rviz
constexpr double kSmallLineSpace = 0.5;  // of letters smaller than that: each row stands by itself

}  // namespace

std::vector<visualization_msgs::Marker> placeRows(const std::vector<TextRow>& rows,
                                                  const MarkerLayout& layout) {
  std::vector<visualization_msgs::Marker> markers;
  if (layout.region().isEmpty()) return markers;
  const double letters = layout.letterHeight();
  const bool is_small = letters < kRvizLineSpace;
  const double line = letters + (is_small ? kSmallLineSpace * letters : kRvizLineSpace);
  // From above, the far edges of the scene appear higher than the near ones.
  const double rear = kSlope * 0.5 * layout.region().diagonal().head<2>().norm();
  Eigen::Vector3d bottom = layout.region().center();
  bottom.z() = layout.region().max().z() + rear + kLift * letters;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::size_t below = rows.size() - 1 - row;
    for (const visualization_msgs::Marker& text : rows[row]) {
      visualization_msgs::Marker& marker = markers.emplace_back(text);
      marker.scale.z = letters;
      double height = 0.5 * static_cast<double>(rows.size());
      if (is_small) {
        height = static_cast<double>(below) + 0.5;
      } else {
        // All texts have as many rows and the same place, so that they cover each other in no view.
        marker.text = std::string(row, '\n') + text.text + std::string(below, '\n');
      }
      marker.pose.position = toPoint(bottom + height * line * Eigen::Vector3d::UnitZ());
    }
  }
  return markers;
}

}  // namespace concave_distance

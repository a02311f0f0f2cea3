#include "marker_parts.h"

#include "base/number_text.h"

namespace concave_distance {
namespace {

// The digits are those of the rounded value: 9.999 is 10.0, not 10.00.
std::string threeDigits(double value, const char* unit) {
  const int decimals = value < 9.995 ? 2 : value < 99.95 ? 1 : 0;
  return fixedText(value, decimals) + " " + unit;
}

}  // namespace

std_msgs::ColorRGBA makeColor(const Eigen::Vector3d& red_green_blue, double opacity) {
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(red_green_blue.x());
  color.g = static_cast<float>(red_green_blue.y());
  color.b = static_cast<float>(red_green_blue.z());
  color.a = static_cast<float>(opacity);
  return color;
}

visualization_msgs::Marker emptyMarker(const std_msgs::Header& header, const std::string& ns, std::int32_t id,
                                       double lifetime) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = ns;
  marker.id = id;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.lifetime = ros::Duration(lifetime);
  return marker;
}

visualization_msgs::Marker textMarker(const std_msgs::Header& header, const std::string& ns, std::int32_t id,
                                      double lifetime, const std::string& text,
                                      const std_msgs::ColorRGBA& color) {
  visualization_msgs::Marker marker = emptyMarker(header, ns, id, lifetime);
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.text = text;
  marker.color = color;
  return marker;
}

std::string lengthText(double metres) {
  const double millimetres = 1000.0 * metres;
  if (millimetres == 0.0) return "0 mm";
  if (millimetres < 0.01) return "<0.01 mm";
  return millimetres < 999.5 ? threeDigits(millimetres, "mm") : threeDigits(metres, "m");
}

std::string forceText(double newtons) {
  return newtons < 999.5 ? threeDigits(newtons, "N") : threeDigits(1e-3 * newtons, "kN");
}

std::string pressureText(double pascals) {
  if (pascals == 0.0) return "0 Pa";
  if (pascals < 999.5) return threeDigits(pascals, "Pa");
  if (pascals < 999.5e3) return threeDigits(1e-3 * pascals, "kPa");
  return pascals < 999.5e6 ? threeDigits(1e-6 * pascals, "MPa") : threeDigits(1e-9 * pascals, "GPa");
}

}  // namespace concave_distance

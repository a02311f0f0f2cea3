#include "marker_parts.h"

#include <cmath>
#include <initializer_list>

#include "base/number_text.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

constexpr double kLetterShare = 2.0;  // height of the letters over the scale of the markers
constexpr double kLift = 1.0;         // height of a label's middle above its point, in letters
constexpr std::size_t kSpaces = 4;    // beside its point; a space is as wide as one and a half letters
constexpr double kRoundSteps[] = {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};

struct Unit {
  double size;  // SI
  const char* name;
};

// Three digits in the largest unit that leaves at least one before the point, or in the smallest one. The
// digits are those of the rounded value: 9.999 is 10.0, not 10.00.
std::string threeDigits(double value, std::initializer_list<Unit> ascending) {
  const Unit* unit = ascending.begin();
  while (unit + 1 != ascending.end() && value >= 0.9995 * unit[1].size) ++unit;
  const double number = value / unit->size;
  const int decimals = number < 9.995 ? 2 : number < 99.95 ? 1 : 0;
  return fixedText(number, decimals) + " " + unit->name;
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

visualization_msgs::Marker emptyMarker(const std_msgs::Header& header, const std::string& ns,
                                       std::int32_t id) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = ns;
  marker.id = id;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

void makeLabel(const std::string& text, const Eigen::Vector3d& point, double scale,
               visualization_msgs::Marker& marker) {
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.text = std::string(kSpaces + 5 * text.size() / 6, ' ') + text;
  marker.scale.z = kLetterShare * scale;
  marker.pose.position = toPoint(point + kLift * marker.scale.z * Eigen::Vector3d::UnitZ());
}

std::string lengthText(double metres) {
  if (metres == 0.0) return "0 mm";
  return metres < 1e-5 ? "<0.01 mm" : threeDigits(metres, {{1e-3, "mm"}, {1.0, "m"}});
}

std::string forceText(double newtons) {
  return threeDigits(newtons, {{1.0, "N"}, {1e3, "kN"}});
}

std::string pressureText(double pascals) {
  if (pascals == 0.0) return "0 Pa";
  return threeDigits(pascals, {{1.0, "Pa"}, {1e3, "kPa"}, {1e6, "MPa"}, {1e9, "GPa"}});
}

double roundedUp(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : kRoundSteps) {
    if (value <= step * power) return step * power;
  }
  return 10.0 * power;
}

}  // namespace concave_distance

#include "marker_labels.h"

#include <cmath>

#include "base/number_text.h"

namespace concave_distance {
namespace {

constexpr double kCharacterWidth = 0.5;  // over the height

// The digits are those of the rounded value: 9.999 is 10.0, not 10.00.
std::string threeDigits(double value, const char* unit) {
  const int decimals = value < 9.995 ? 2 : value < 99.95 ? 1 : 0;
  return fixedText(value, decimals) + " " + unit;
}

constexpr double kPitches[2] = {0.35, 0.75};  // radians, of the views in turn

std::array<View, 8> makeViews() {
  std::array<View, 8> views;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const double azimuth = 2.0 * M_PI * (static_cast<double>(k) + 0.5) / static_cast<double>(views.size());
    const double pitch = kPitches[k % 2];
    const Eigen::Vector3d outwards(std::cos(azimuth), std::sin(azimuth), 0.0);
    View& view = views[k];
    view.towards = std::cos(pitch) * outwards + std::sin(pitch) * Eigen::Vector3d::UnitZ();
    view.right = Eigen::Vector3d::UnitZ().cross(outwards);
    view.up = view.towards.cross(view.right);
  }
  return views;
}

}  // namespace

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

double widthOf(const visualization_msgs::Marker& text) {
  return kCharacterWidth * static_cast<double>(text.text.size()) * text.scale.z;
}

const std::array<View, 8>& usualViews() {
  static const std::array<View, 8> views = makeViews();
  return views;
}

bool overlap(const LabelSpace& a, const LabelSpace& b, const View& view) {
  const Eigen::Vector3d between = a.centre - b.centre;
  return std::abs(between.dot(view.up)) < 0.5 * (a.height + b.height) &&
         std::abs(between.dot(view.right)) < 0.5 * (a.width + b.width);
}

}  // namespace concave_distance

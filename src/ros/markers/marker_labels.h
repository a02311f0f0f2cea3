#pragma once

#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <array>
#include <string>

namespace concave_distance {

/// A length with three digits and its unit: "0.42 mm", "12.3 mm", "456 mm", "1.24 m"; below 10 um "<0.01 mm".
std::string lengthText(double metres);
/// A force in the same way: "312 N", "3.58 kN".
std::string forceText(double newtons);
/// A pressure in the same way: "0 Pa", "312 Pa", "12.3 kPa", "3.58 MPa", "1.20 GPa".
std::string pressureText(double pascals);

/// A text beside a line of the picture.
struct Label {
  visualization_msgs::Marker marker;  ///< TEXT_VIEW_FACING; placeLabels() sets its position and height
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< ends of the line, reference frame, metres
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

/// Width of a text, metres: that of rviz's font on average.
double widthOf(const visualization_msgs::Marker& text);

/// A direction of view; the node does not know the camera.
struct View {
  Eigen::Vector3d towards;  ///< the camera; unit vector, reference frame
  Eigen::Vector3d right;    ///< on the screen
  Eigen::Vector3d up;
};
/// Eight views from all around, with pitches of 0.35 and 0.75 rad. Labels are placed for these.
const std::array<View, 8>& usualViews();

/// A text that faces the camera.
struct LabelSpace {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< m
  double width = 0.0;                                ///< m
  double height = 0.0;
};
/// Whether two texts cover each other on the screen.
bool overlap(const LabelSpace& a, const LabelSpace& b, const View& view);
}  // namespace concave_distance

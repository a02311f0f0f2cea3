#pragma once

#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

namespace concave_distance {

std_msgs::ColorRGBA makeColor(const Eigen::Vector3d& red_green_blue, double opacity = 1.0);

/// A marker without a type, at the origin of the header's frame, which rviz shows until it is deleted.
visualization_msgs::Marker emptyMarker(const std_msgs::Header& header, const std::string& ns,
                                       std::int32_t id);

/// Makes the marker a text that faces the camera and begins beside a point of the header's frame, a little
/// higher: rviz centres it with the spaces before it, so that a body there hides little of it.
/// @param scale of the markers, > 0 m
void makeLabel(const std::string& text, const Eigen::Vector3d& point, double scale,
               visualization_msgs::Marker& marker);

/// A length with three digits and its unit: "0.42 mm", "12.3 mm", "456 mm", "1.24 m"; below 10 um "<0.01 mm".
std::string lengthText(double metres);
/// A force in the same way: "312 N", "3.58 kN".
std::string forceText(double newtons);
/// A pressure in the same way: "0 Pa", "312 Pa", "12.3 kPa", "3.58 MPa", "1.20 GPa".
std::string pressureText(double pascals);

/// The end of a colour scale: 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 times a power of ten, not below the value.
double roundedUp(double value);

}  // namespace concave_distance

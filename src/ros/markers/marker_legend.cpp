#include "marker_legend.h"

#include <algorithm>
#include <string>

#include "contact_markers.h"
#include "niche_markers.h"
#include "pressure_markers.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

constexpr double kLegendLetterShare = 0.9;  // height of the legend's letters over that of the labels
constexpr double kSlope = 0.35;             // tangent of the pitch up to which the legend hides nothing
constexpr double kLift = 1.5;               // height of the legend above the scene, in letters
constexpr double kRvizLineSpace = 0.01;     // m between the rows of a text in rviz
constexpr double kSmallLineSpace = 0.5;     // of letters smaller than that: each row stands by itself
constexpr std::size_t kColumn = 26;         // spaces between two columns of a row

struct Row {
  std::string text;
  std_msgs::ColorRGBA color;
  std::size_t row = 0;
};

void addContactRows(const LegendContents& contents, const MarkerStyle& style, std::vector<Row>& rows) {
  std::size_t row = rows.back().row;
  const std::string space(kColumn, ' ');
  ++row;
  rows.push_back({"red arrow: normal force" + space, normalForceColor(), row});
  rows.push_back({space + "blue arrow: friction", frictionColor(), row});
  const double end = contents.pressure_end;
  rows.push_back({(end > 0.0 ? "an arrow of 1 m: " : "disc: area of a contact; an arrow of 1 m: ") +
                      forceText(style.force_scale),
                  contactTextColor(), ++row});
  if (!(end > 0.0)) return;
  ++row;
  rows.push_back({"surface: pressure 0" + space, pressureColor(0.0, end), row});
  rows.push_back({pressureText(0.5 * end), pressureColor(0.5 * end, end), row});
  rows.push_back({space + pressureText(end) + " or more", pressureColor(end, end), row});
}

std::vector<Row> rowsOf(const LegendContents& contents, const MarkerStyle& style) {
  std::vector<Row> rows;
  std::size_t row = 0;
  const std::string of_pairs =
      contents.drawn_pairs < contents.pairs
          ? "the " + std::to_string(contents.drawn_pairs) + " nearest of " + std::to_string(contents.pairs) +
                " pairs are shown"
          : std::to_string(contents.pairs) + (contents.pairs == 1 ? " pair" : " pairs");
  rows.push_back({"thick line: shortest distance of a pair (" + of_pairs + ")", greyColor(), row});
  if (contents.dashes) rows.push_back({"dashed: not certain; grey: stale transforms", greyColor(), ++row});
  if (contents.others)
    rows.push_back({"thin line: another place where the pair could touch", greyColor(), ++row});
  if (contents.extents) rows.push_back({"circle: faces or edges run parallel this far", greyColor(), ++row});
  const std::string space(kColumn, ' ');
  ++row;
  rows.push_back({lengthText(style.near) + space, distanceColor(style.near, style), row});
  const double middle = 0.5 * (style.near + style.far);
  rows.push_back({lengthText(middle), distanceColor(middle, style), row});
  rows.push_back({space + lengthText(style.far) + " or more", distanceColor(style.far, style), row});
  if (contents.warnings) rows.push_back({"red: closer than the warning distance", warningColor(), ++row});
  if (contents.contacts) addContactRows(contents, style, rows);
  return rows;
}

}  // namespace

std::vector<visualization_msgs::Marker> legendMarkers(const LegendContents& contents,
                                                      const MarkerLayout& layout,
                                                      const std_msgs::Header& header, double lifetime) {
  std::vector<visualization_msgs::Marker> markers;
  if (layout.region().isEmpty()) return markers;
  const std::vector<Row> rows = rowsOf(contents, layout.style());
  const double letters = kLegendLetterShare * layout.letterHeight();
  const std::size_t count = rows.back().row + 1;
  const bool is_small = letters < kRvizLineSpace;
  const double line = letters + (is_small ? kSmallLineSpace * letters : kRvizLineSpace);
  const double height = static_cast<double>(count) * line;
  Eigen::Vector3d centre = layout.region().center();
  // From above, the far edges of the scene appear higher than the near ones.
  const double rear = kSlope * 0.5 * layout.region().diagonal().head<2>().norm();
  centre.z() = layout.region().max().z() + rear + kLift * layout.letterHeight() + 0.5 * height;
  for (const Row& row : rows) {
    visualization_msgs::Marker marker;
    marker.header = header;
    marker.ns = "legend";
    marker.id = static_cast<std::int32_t>(markers.size());
    marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
    marker.action = visualization_msgs::Marker::ADD;
    marker.pose.orientation.w = 1.0;
    marker.pose.position = toPoint(centre);
    marker.scale.z = letters;
    marker.color = row.color;
    marker.lifetime = ros::Duration(lifetime);
    if (is_small) {
      marker.text = row.text;
      marker.pose.position.z += (0.5 * static_cast<double>(count - 1) - static_cast<double>(row.row)) * line;
    } else {
      // All markers have the same number of rows and the same place, so the rows never overlap in any view.
      marker.text = std::string(row.row, '\n') + row.text + std::string(count - 1 - row.row, '\n');
    }
    markers.push_back(std::move(marker));
  }
  return markers;
}

LabelSpace spaceOfLegend(const std::vector<visualization_msgs::Marker>& legend) {
  LabelSpace space;
  double low = legend.front().pose.position.z;
  double high = low;
  for (const visualization_msgs::Marker& marker : legend) {
    const auto rows = static_cast<double>(1 + std::count(marker.text.begin(), marker.text.end(), '\n'));
    const double half = 0.5 * (rows * marker.scale.z + (rows - 1.0) * kRvizLineSpace);
    low = std::min(low, marker.pose.position.z - half);
    high = std::max(high, marker.pose.position.z + half);
    space.width = std::max(space.width, widthOf(marker));
  }
  const geometry_msgs::Point& place = legend.front().pose.position;
  space.centre = {place.x, place.y, 0.5 * (low + high)};
  space.height = high - low;
  return space;
}

}  // namespace concave_distance

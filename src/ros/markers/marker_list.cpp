#include "marker_list.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>

#include "contact_markers.h"
#include "niche_markers.h"
#include "pressure_markers.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

// Returns whether the settings of a listed pair or of a rule are such.
template <typename IsIt>
bool isInSettings(const Scene& scene, const IsIt& is_it) {
  return std::any_of(scene.pairs.begin(), scene.pairs.end(),
                     [&](const ScenePair& pair) { return is_it(pair.settings); }) ||
         std::any_of(scene.rules.table.begin(), scene.rules.table.end(),
                     [&](const PairRule& rule) { return rule.is_watched && is_it(settingsOf(scene, rule)); });
}

const std::string kColumn(26, ' ');      // between two columns of a row
constexpr double kRvizLineSpace = 0.01;  // m between the rows of one text in rviz
constexpr double kSmallLineSpace = 0.5;  // of letters smaller than that: each row stands by itself

std::string countText(const MarkerSelection& selection, std::size_t pair_count) {
  const std::string all =
      std::to_string(selection.candidates) + (selection.candidates == 1 ? " pair" : " pairs");
  const std::size_t drawn = selection.drawn.size();
  if (drawn == selection.candidates) return all;
  return std::to_string(drawn) + (drawn == pair_count ? " nearest of " : " of ") + all;
}

}  // namespace

std::vector<TextRow> legendRows(const Scene& scene, const MarkerSelection& selection,
                                const MarkerStyle& style, double pressure_end,
                                const std_msgs::Header& header) {
  std::vector<TextRow> rows;
  std::int32_t id = 0;
  const auto addRow = [&](std::initializer_list<std::pair<std::string, std_msgs::ColorRGBA>> texts) {
    rows.emplace_back();
    for (const auto& [words, color] : texts) {
      rows.back().push_back(textMarker(header, "legend", id++, words, color));
    }
  };
  const auto isAny = [](const auto& values, const auto& is_it) {
    return std::any_of(values.begin(), values.end(), is_it);
  };
  if (isAny(selection.drawn, [](const DrawnPair& pair) { return isDashed(*pair.pair); })) {
    addRow({{"dashed: not certain; grey: stale transforms", greyColor()}});
  }
  addRow({{"thick line: shortest distance (" + countText(selection, style.pair_count) + ")", greyColor()}});
  addRow({{"thin line: another place where the pair could touch", greyColor()}});
  addRow({{"circle: faces or edges run parallel this far", greyColor()}});
  const double middle = 0.5 * (style.near + style.far);
  addRow({{"line: " + lengthText(style.near) + kColumn, distanceColor(style.near, style)},
          {lengthText(middle), distanceColor(middle, style)},
          {kColumn + lengthText(style.far) + " or more", distanceColor(style.far, style)}});
  if (isInSettings(scene,
                   [](const PairSettings& settings) { return settings.warning_distance.has_value(); })) {
    addRow({{"red: closer than the warning distance", warningColor()}});
  }
  if (!isInSettings(scene, [](const PairSettings& settings) { return settings.effects.any(); })) return rows;
  addRow({{"red arrow: normal force" + kColumn, normalForceColor()},
          {kColumn + "blue arrow: friction", frictionColor()}});
  const bool has_pressure = pressure_end > 0.0;
  const std::string disc = has_pressure ? "" : "disc: area of a contact; ";
  addRow({{disc + "an arrow of 1 m: " + forceText(style.force_scale), contactTextColor()}});
  if (!has_pressure) return rows;
  const double half = 0.5 * pressure_end;
  addRow({{"surface: pressure " + pressureText(0.0) + kColumn, pressureColor(0.0, pressure_end)},
          {pressureText(half), pressureColor(half, pressure_end)},
          {kColumn + pressureText(pressure_end) + " or more", pressureColor(pressure_end, pressure_end)}});
  return rows;
}

std::vector<visualization_msgs::Marker> placeRows(const std::vector<TextRow>& rows,
                                                  const MarkerLayout& layout) {
  std::vector<visualization_msgs::Marker> markers;
  if (layout.region.isEmpty()) return markers;
  const double letters = layout.letter_height;
  const bool is_small = letters < kRvizLineSpace;
  const double line = letters + (is_small ? kSmallLineSpace * letters : kRvizLineSpace);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::size_t below = rows.size() - 1 - row;
    const double lines = is_small ? static_cast<double>(below) + 0.5 : 0.5 * static_cast<double>(rows.size());
    for (const visualization_msgs::Marker& text : rows[row]) {
      visualization_msgs::Marker& marker = markers.emplace_back(text);
      marker.scale.z = letters;
      marker.pose.position = toPoint(layout.list_bottom + lines * line * Eigen::Vector3d::UnitZ());
      // All texts have as many rows and the same place, so that they cover each other in no view.
      if (!is_small) marker.text = std::string(row, '\n') + text.text + std::string(below, '\n');
    }
  }
  return markers;
}

}  // namespace concave_distance

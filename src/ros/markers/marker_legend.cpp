#include "marker_legend.h"

#include <algorithm>
#include <string>

#include "contact_markers.h"
#include "niche_markers.h"
#include "pressure_markers.h"

namespace concave_distance {
namespace {

const std::string kColumn(26, ' ');  // between two columns of a row

std::string countText(const MarkerSelection& selection, std::size_t pair_count) {
  const std::string all =
      std::to_string(selection.candidates) + (selection.candidates == 1 ? " pair" : " pairs");
  return selection.drawn.size() < selection.candidates
             ? std::to_string(selection.drawn.size()) +
                   (selection.drawn.size() == pair_count ? " nearest of " : " of ") + all
             : all;
}

}  // namespace

std::vector<TextRow> legendRows(const Scene& scene, const MarkerSelection& selection,
                                const MarkerStyle& style, double pressure_end, const std_msgs::Header& header,
                                double lifetime) {
  std::vector<TextRow> rows;
  std::int32_t id = 0;
  const auto text = [&](const std::string& words, const std_msgs::ColorRGBA& color) {
    return textMarker(header, "legend", id++, lifetime, words, color);
  };
  const auto isAny = [](const auto& values, const auto& is_it) {
    return std::any_of(values.begin(), values.end(), is_it);
  };
  if (isAny(selection.drawn, [](const DrawnPair& pair) { return isDashed(*pair.pair); })) {
    rows.push_back({text("dashed: not certain; grey: stale transforms", greyColor())});
  }
  rows.push_back(
      {text("thick line: shortest distance (" + countText(selection, style.pair_count) + ")", greyColor())});
  rows.push_back({text("thin line: another place where the pair could touch", greyColor())});
  rows.push_back({text("circle: faces or edges run parallel this far", greyColor())});
  const auto distance = [&](const std::string& before, double metres, const std::string& after) {
    return text(before + lengthText(metres) + after, distanceColor(metres, style));
  };
  rows.push_back({distance("", style.near, kColumn), distance("", 0.5 * (style.near + style.far), ""),
                  distance(kColumn, style.far, " or more")});
  if (isAny(scene.pairs, [](const ScenePair& pair) { return pair.settings.warning_distance.has_value(); })) {
    rows.push_back({text("red: closer than the warning distance", warningColor())});
  }
  if (!isAny(scene.pairs, [](const ScenePair& pair) { return pair.settings.effects.any(); })) return rows;
  rows.push_back({text("red arrow: normal force" + kColumn, normalForceColor()),
                  text(kColumn + "blue arrow: friction", frictionColor())});
  const bool has_pressure = pressure_end > 0.0;
  rows.push_back({text((has_pressure ? "" : "disc: area of a contact; ") + std::string("an arrow of 1 m: ") +
                           forceText(style.force_scale),
                       contactTextColor())});
  if (!has_pressure) return rows;
  const auto pressure = [&](const std::string& before, double pascals, const std::string& after) {
    return text(before + pressureText(pascals) + after, pressureColor(pascals, pressure_end));
  };
  rows.push_back({pressure("surface: pressure ", 0.0, kColumn), pressure("", 0.5 * pressure_end, ""),
                  pressure(kColumn, pressure_end, " or more")});
  return rows;
}

}  // namespace concave_distance

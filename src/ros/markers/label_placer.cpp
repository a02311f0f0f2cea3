#include "label_placer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "mesh/trees/triangle_tree.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

constexpr std::size_t kDirections = 8;  // to the side
// Distance of a label from its line's end, in heights; 0: beside the middle of the line.
constexpr std::array<double, 6> kRises = {1.2, 0.0, 3.0, 6.0, 10.0, -1.2};
constexpr std::size_t kPlaces = kRises.size() * (kDirections + 1);
constexpr std::size_t kMostLabels = 50;  // the time to place them grows with the square of their number
constexpr double kPeriod = 1.0;          // s between two searches for a better place
constexpr double kLeader = 2.0;          // distance in heights beyond which a thin line joins label and line
// Costs of a place, for each view to which they apply.
constexpr double kOnLabel = 2.0;
constexpr double kHidden = 3.0;  // a third of it for either end and the middle
constexpr double kOnOwnLine = 0.5;
constexpr double kOnOtherLine = 0.4;
constexpr double kBeforeBody = 0.4;  // a text reads better on the background
// Costs of a place in every view.
constexpr double kPerRise = 0.03;
constexpr double kBelow = 0.1;
constexpr double kSideways = 0.05;
constexpr double kMoved = 0.15;
constexpr double kNever = 100.0;  // applies nearer to its line than this many heights:
constexpr double kClear = 1.1;
constexpr double kTooManyOverlaps = 0.3;  // share of the views

using Places = std::array<Eigen::Vector3d, kPlaces>;

// Above and below the line, at its middle and to each side, at two distances.
Places placesOf(const Label& label, double width, double height) {
  Places places;
  const Eigen::Vector3d middle = 0.5 * (label.from + label.to);
  const double half = 0.5 * std::abs(label.to.z() - label.from.z());
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const double rise = kRises[k / (kDirections + 1)];
    const std::size_t side = k % (kDirections + 1);
    const double beyond = rise == 0.0 ? 0.0 : std::copysign(half, rise);
    places[k] = middle + (beyond + rise * height) * Eigen::Vector3d::UnitZ();
    if (side == 0) continue;
    const double angle = 2.0 * M_PI * static_cast<double>(side) / kDirections;
    places[k] += (0.5 * width + height) * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
  }
  return places;
}

double costOfShape(std::size_t place) {
  const double rise = kRises[place / (kDirections + 1)];
  return kPerRise * std::abs(rise) + (rise < 0.0 ? kBelow : 0.0) +
         (place % (kDirections + 1) != 0 ? kSideways : 0.0);
}

// Whether a body hides the point from a camera far off in this direction.
bool isHidden(const Eigen::Vector3d& point, const Eigen::Vector3d& towards,
              const LabelSurroundings& surroundings) {
  for (const LocatedBody& body : surroundings.bodies) {
    const double length = 2.0 * ((body.box.center() - point).norm() + body.box.diagonal().norm());
    // The ray misses the body's sphere, as for most bodies.
    const Eigen::Vector3d to_centre = body.box.center() - point;
    const double along = std::max(0.0, to_centre.dot(towards));
    if ((to_centre - along * towards).norm() > 0.5 * body.box.diagonal().norm()) continue;
    const Eigen::Isometry3d body_from_reference = body.reference_from_body.inverse();
    const BodyMesh& mesh = *surroundings.scene.bodies[body.index].mesh;
    if (segmentHits(mesh.tree(), mesh.surface(), body_from_reference * point,
                    body_from_reference * Eigen::Vector3d(point + length * towards), 0.0)) {
      return true;
    }
  }
  return false;
}

double distanceToLine(const Eigen::Vector3d& point, const Label& line) {
  const Eigen::Vector3d along = line.to - line.from;
  const double squared = along.squaredNorm();
  const double share = squared > 0.0 ? std::clamp((point - line.from).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - line.from - share * along).norm();
}

struct Situation {
  const std::vector<Label>& labels;
  const std::vector<LabelSpace>& taken;
  const LabelSurroundings& surroundings;
};

double overlapShare(const LabelSpace& space, const std::vector<LabelSpace>& taken) {
  double count = 0.0;
  for (const View& view : usualViews()) {
    count += std::any_of(taken.begin(), taken.end(),
                         [&](const LabelSpace& other) { return overlap(space, other, view); })
                 ? 1.0
                 : 0.0;
  }
  return count / static_cast<double>(usualViews().size());
}

double costOfLines(const LabelSpace& space, const Label& own, const Situation& situation) {
  double cost = 0.0;
  for (const View& view : usualViews()) {
    for (const Label& line : situation.labels) {
      if (covers(space, line.from, line.to, view)) cost += &line == &own ? kOnOwnLine : kOnOtherLine;
    }
  }
  return cost / static_cast<double>(usualViews().size());
}

double costOfHiding(const LabelSpace& space, const LabelSurroundings& surroundings) {
  double hidden = 0.0;
  double before = 0.0;
  for (const View& view : usualViews()) {
    before += isHidden(space.centre, -view.towards, surroundings) ? 1.0 : 0.0;
    for (const double end : {-0.5, 0.0, 0.5}) {
      hidden +=
          isHidden(space.centre + end * space.width * view.right, view.towards, surroundings) ? 1.0 : 0.0;
    }
  }
  return (kHidden * hidden / 3.0 + kBeforeBody * before) / static_cast<double>(usualViews().size());
}

// The best place; the expensive checks come last and only for places that can still be the best.
std::size_t bestPlace(const Label& label, const Places& places, LabelSpace space, const Situation& situation,
                      std::optional<std::size_t> before) {
  std::array<std::pair<double, std::size_t>, kPlaces> order;
  for (std::size_t k = 0; k < kPlaces; ++k) {
    space.centre = places[k];
    const bool on_line = distanceToLine(places[k], label) < kClear * space.height;
    order[k] = {(on_line ? kNever : 0.0) + costOfShape(k) + (before && *before != k ? kMoved : 0.0) +
                    kOnLabel * overlapShare(space, situation.taken) + costOfLines(space, label, situation),
                k};
  }
  std::sort(order.begin(), order.end());
  std::size_t best = order.front().second;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [cost, k] : order) {
    if (cost >= least) break;
    space.centre = places[k];
    const double total = cost + costOfHiding(space, situation.surroundings);
    if (total < least) {
      least = total;
      best = k;
    }
  }
  return best;
}

// A thin line from the label to its line, if they are far apart.
visualization_msgs::Marker leaderOf(const Label& label, const LabelSpace& space) {
  visualization_msgs::Marker leader = label.marker;
  leader.ns += "_leader";
  leader.type = visualization_msgs::Marker::LINE_LIST;
  leader.text.clear();
  leader.scale.x = 0.06 * space.height;
  leader.scale.y = leader.scale.z = 0.0;
  leader.color.a = 0.6F;
  const Eigen::Vector3d middle = 0.5 * (label.from + label.to);
  Eigen::Vector3d edge = space.centre;
  edge.z() += std::copysign(0.6 * space.height, middle.z() - space.centre.z());
  leader.pose = visualization_msgs::Marker().pose;
  leader.pose.orientation.w = 1.0;
  leader.points = {toPoint(middle), toPoint(edge)};
  return leader;
}

}  // namespace

std::vector<visualization_msgs::Marker> LabelPlacer::place(std::vector<Label> labels,
                                                           const LabelSurroundings& surroundings,
                                                           double letter_height,
                                                           std::vector<LabelSpace> taken, double now) {
  labels.resize(std::min(labels.size(), kMostLabels));
  std::vector<visualization_msgs::Marker> placed;
  decltype(choices_) choices;
  for (Label& label : labels) {
    label.marker.scale.z = letter_height;
    LabelSpace space;
    space.width = widthOf(label.marker);
    space.height = letter_height;
    const Places places = placesOf(label, space.width, letter_height);
    const auto key = std::make_pair(label.marker.ns, label.marker.id);
    const auto before = choices_.find(key);
    const bool known = before != choices_.end();
    Choice choice = known ? before->second : Choice{};
    if (!known || now < choice.time || now - choice.time >= kPeriod) {
      choice.place = bestPlace(label, places, space, {labels, taken, surroundings},
                               known ? std::optional<std::size_t>(choice.place) : std::nullopt);
      choice.time = now;
    }
    choices[key] = choice;
    space.centre = places[choice.place];
    if (!placed.empty() && overlapShare(space, taken) > kTooManyOverlaps) continue;
    taken.push_back(space);
    label.marker.pose.position = toPoint(space.centre);
    placed.push_back(label.marker);
    const double gap =
        (space.centre - 0.5 * (label.from + label.to)).norm() - 0.5 * (label.to - label.from).norm();
    if (gap > kLeader * letter_height) placed.push_back(leaderOf(label, space));
  }
  choices_ = std::move(choices);
  return placed;
}

}  // namespace concave_distance

#include "label_numbers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

using visualization_msgs::Marker;

constexpr double kNumberShare = 1.2;  // height of a number over that of the letters above the scene
// In heights of a number:
constexpr double kNearest = 1.1;  // its distance from its place
constexpr double kStep = 0.7;     // by which that grows
constexpr double kRadius = 0.6;   // of the ball around it that touches no body
constexpr double kLeader = 2.5;   // the distance beyond which a thin line joins it to its place
constexpr double kLeaderWidth = 0.06;
constexpr double kClose = 4.0;  // horizontal distance below which numbers stand one above another

constexpr double kSteepest = 0.6;     // pitch of the camera (rad) up to which these do not cover each other
constexpr double kWorthMoving = 1.3;  // how much more room a nearer place has to have than the present one

// Straight up and aslant, where most cameras are.
const Eigen::Vector3d kDirections[] = {
    {0, 0, 1}, {0.7, 0, 0.7}, {0, 0.7, 0.7}, {-0.7, 0, 0.7}, {0, -0.7, 0.7}};
const Eigen::Vector3d kDiameters[] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1}, {1, 1, 1},
                                      {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
constexpr int kDirectionCount = 5;
constexpr int kPlaces = 60 * kDirectionCount;

// Returns whether the body's surface meets one of seven diameters of the ball, or the body holds its centre.
bool touches(const SceneBody& body, const LocatedBody& located, const Eigen::Vector3d& point, double radius) {
  if (located.box.squaredExteriorDistance(point) > radius * radius) return false;
  const BodyMesh& mesh = *body.mesh;
  const Eigen::Vector3d centre = located.reference_from_body.inverse() * point;
  for (const Eigen::Vector3d& along : kDiameters) {
    const Eigen::Vector3d half = radius * along.normalized();
    if (segmentHits(mesh.tree(), mesh.surface(), centre - half, centre + half, 0.0)) return true;
  }
  return containsPoint(mesh.tree(), mesh.surface(), mesh.topology().shell_is_closed,
                       mesh.topology().shell_of_triangle, centre);
}

// Whether some camera around, up to kSteepest above or below, sees one of two close numbers on the other.
bool covers(const Eigen::Vector3d& number, const Eigen::Vector3d& other, double height) {
  const double beside = (number - other).head<2>().norm();
  return beside < kClose * height &&
         std::abs(number.z() - other.z()) < height / std::cos(kSteepest) + beside * std::tan(kSteepest);
}

Marker numberMarker(const Label& label, int number, const Eigen::Vector3d& place, double height) {
  Marker marker = label.text;
  marker.ns.replace(marker.ns.rfind("text"), 4, "number");
  marker.text = std::to_string(number);
  marker.pose.position = toPoint(place);
  marker.scale.z = height;
  return marker;
}

Marker leaderMarker(const Marker& number, const Label& label, const Eigen::Vector3d& place) {
  Marker leader = number;
  leader.ns += "_leader";
  leader.type = Marker::LINE_LIST;
  leader.text.clear();
  leader.scale.x = kLeaderWidth * number.scale.z;
  leader.scale.z = 0.0;
  leader.pose.position = geometry_msgs::Point();
  const Eigen::Vector3d back = (label.place - place).normalized();
  leader.points = {toPoint(label.place), toPoint(place + kRadius * number.scale.z * back)};
  return leader;
}

}  // namespace

// A label that was drawn before keeps its number; the others get the smallest free ones.
void LabelNumbers::assign(std::vector<Label>& labels) {
  const auto keyOf = [](const Label& label) { return std::make_pair(label.text.ns, label.text.id); };
  decltype(choices_) kept;
  for (const Label& label : labels) kept.insert(choices_.extract(keyOf(label)));
  choices_ = std::move(kept);
  const auto isTaken = [&](int number) {
    return std::any_of(choices_.begin(), choices_.end(),
                       [&](const auto& choice) { return choice.second.number == number; });
  };
  for (const Label& label : labels) {
    int number = choices_[keyOf(label)].number;
    if (number != 0) continue;
    while (isTaken(++number)) continue;
    choices_[keyOf(label)].number = number;
  }
  std::sort(labels.begin(), labels.end(), [&](const Label& left, const Label& right) {
    return choices_[keyOf(left)].number < choices_[keyOf(right)].number;
  });
}

std::vector<Marker> LabelNumbers::number(std::vector<Label>& labels, const Scene& scene,
                                         const std::vector<LocatedBody>& bodies, double letter_height) {
  assign(labels);
  std::vector<Marker> markers;
  if (labels.size() < 2) return markers;
  const double height = kNumberShare * letter_height;
  std::vector<Eigen::Vector3d> taken;
  const auto isFree = [&](const Eigen::Vector3d& place, double room) {
    return std::none_of(taken.begin(), taken.end(),
                        [&](const Eigen::Vector3d& other) { return covers(place, other, room * height); }) &&
           std::none_of(bodies.begin(), bodies.end(), [&](const LocatedBody& body) {
             return touches(scene.bodies[body.index], body, place, room * kRadius * height);
           });
  };
  for (Label& label : labels) {
    Choice& choice = choices_[{label.text.ns, label.text.id}];
    const auto placeOf = [&](int k) -> Eigen::Vector3d {
      const double distance = (kNearest + kStep * (k / kDirectionCount)) * height;
      return label.place + distance * kDirections[k % kDirectionCount];
    };
    int k = 0;
    while (k < kPlaces && !isFree(placeOf(k), k < choice.place ? kWorthMoving : 1.0)) ++k;
    choice.place = k;
    const Eigen::Vector3d place = placeOf(k);
    taken.push_back(place);
    markers.push_back(numberMarker(label, choice.number, place, height));
    if ((place - label.place).norm() > kLeader * height) {
      markers.push_back(leaderMarker(markers.back(), label, place));
    }
    label.text.text = std::to_string(choice.number) + "   " + label.text.text;
  }
  return markers;
}

}  // namespace concave_distance

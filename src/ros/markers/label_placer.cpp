#include "label_placer.h"

#include <algorithm>
#include <cmath>

#include "mesh/trees/triangle_tree.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

constexpr std::size_t kMostLabels = 50;  // the time to place them grows with the square of their number
constexpr double kPeriod = 1.0;          // s between two searches for a lower place
// Heights of a label above the upper end of its line, in heights of its letters.
constexpr double kLowest = 1.2;
constexpr double kStep = 0.7;
constexpr int kSteps = 60;       // up to here a place is looked for at which bodies do not hide the label
constexpr int kMostSteps = 600;  // more than labels can take
constexpr double kLeader = 2.5;  // the height beyond which a thin line joins label and line

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

double heightOf(int step) {
  return kLowest + kStep * step;
}

Eigen::Vector3d placeOf(const Label& label, int step, double letter_height) {
  Eigen::Vector3d place = 0.5 * (label.from + label.to);
  place.z() = std::max(label.from.z(), label.to.z()) + heightOf(step) * letter_height;
  return place;
}

bool isFree(const LabelSpace& space, const std::vector<LabelSpace>& taken) {
  return std::none_of(taken.begin(), taken.end(), [&](const LabelSpace& other) {
    return std::any_of(usualViews().begin(), usualViews().end(),
                       [&](const View& view) { return overlap(space, other, view); });
  });
}

// Whether the middle and both ends of the text stand in front of all bodies, in at least half of the views.
bool isSeen(const LabelSpace& space, const LabelSurroundings& surroundings) {
  const auto seen = std::count_if(usualViews().begin(), usualViews().end(), [&](const View& view) {
    const Eigen::Vector3d half = 0.5 * space.width * view.right;
    return !isHidden(space.centre, view.towards, surroundings) &&
           !isHidden(space.centre - half, view.towards, surroundings) &&
           !isHidden(space.centre + half, view.towards, surroundings);
  });
  return 2 * seen >= static_cast<std::ptrdiff_t>(usualViews().size());
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
    const auto key = std::make_pair(label.marker.ns, label.marker.id);
    const auto before = choices_.find(key);
    const bool is_kept =
        before != choices_.end() && now >= before->second.time && now - before->second.time < kPeriod;
    Choice choice = is_kept ? before->second : Choice{0, now};
    // Another label may have come to where this one stood. Where bodies hide every place, the lowest that is
    // free is taken.
    int lowest_free = kMostSteps;
    for (;; ++choice.step) {
      space.centre = placeOf(label, choice.step, letter_height);
      const bool is_free = isFree(space, taken);
      if (is_free && (is_kept || isSeen(space, surroundings))) break;
      if (is_free) lowest_free = std::min(lowest_free, choice.step);
      if (choice.step >= kSteps && (lowest_free < kMostSteps || choice.step >= kMostSteps)) {
        choice.step = lowest_free;
        space.centre = placeOf(label, choice.step, letter_height);
        break;
      }
    }
    choices[key] = choice;
    taken.push_back(space);
    label.marker.pose.position = toPoint(space.centre);
    placed.push_back(label.marker);
    if (heightOf(choice.step) > kLeader) placed.push_back(leaderOf(label, space));
  }
  choices_ = std::move(choices);
  return placed;
}

}  // namespace concave_distance

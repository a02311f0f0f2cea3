// The picture of a whole scene: what is drawn, how large, where the labels are, what is deleted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "ros/box_scene.h"
#include "ros/markers/marker_parts.h"
#include "ros/markers/marker_selection.h"
#include "ros/markers/scene_markers.h"
#include "ros/messages/conversions.h"

namespace concave_distance::scene_markers_test {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kLifetime = 0.5;

SceneBody box(const std::string& name, double size) {
  SceneBody body;
  body.name = name;
  body.frame = name;
  BodyMeshOptions options;
  options.max_edge_length = size;
  body.mesh = std::make_shared<const BodyMesh>(name, makeBox(Eigen::Vector3d::Constant(size)), options);
  body.bounds = boundsOf(body.mesh->surface());
  return body;
}

// A cube of side 1 in the middle and `count` more around it, the first 0.1 away, each 0.05 farther than the
// one before; all lengths times `unit`. As after a cycle of the node.
class Picture {
 public:
  explicit Picture(std::size_t count, double unit = 1.0) : unit_(unit) {
    scene_.bodies.push_back(box("middle", unit));
    for (std::size_t k = 0; k < count; ++k) {
      scene_.bodies.push_back(box("box_" + std::to_string(k + 1), unit));
      ScenePair pair;
      pair.name = "middle/box_" + std::to_string(k + 1);
      pair.body_b = k + 1;
      scene_.pairs.push_back(pair);
      tracked_.push_back(std::make_shared<TrackedPair>(scene_, k, 0));
      pairs_.push_back(std::make_unique<PublishedPair>(scene_, pair, "world"));
      pairs_.back()->tracked = tracked_.back();
      solve(k);
    }
    header_.frame_id = "world";
    header_.stamp = ros::Time(100.0);
  }

  MarkerArray draw() {
    std::vector<PairNiches> messages;
    for (const auto& pair : pairs_) {
      messages.push_back(pair->status.code == PairStatus::OK
                             ? toNiches(pair->heading, pair->tracked->solution)
                             : emptyNiches(pair->heading, pair->status));
    }
    return drawing_.draw(scene_, style, pairs_, messages, contacts, header_, kLifetime);
  }
  MarkerArray clear() { return drawing_.draw(scene_, style, pairs_, {}, {}, header_, kLifetime); }
  // @return the pairs whose niches the next picture needs
  std::set<std::string> wanted() const {
    std::set<std::string> pairs;
    for (const auto& pair : pairs_) {
      if (drawing_.draws(pair->heading.pair)) pairs.insert(pair->heading.pair);
    }
    return pairs;
  }
  void moveNearest(std::size_t pair, double distance) {
    PairSolution& solution = tracked_[pair]->solution;
    const Eigen::Vector3d away = (solution.point_b_in_a - solution.point_a_in_a).normalized();
    solution.distance = distance;
    solution.point_b_in_a = solution.point_a_in_a + distance * away;
  }
  void dropNiches(std::size_t pair) { tracked_[pair]->solution.niches.clear(); }
  void makeStale(std::size_t pair) { pairs_[pair]->status.code = PairStatus::STALE_TRANSFORM; }
  void makeLink(std::size_t body) { scene_.bodies.edit(body).is_robot_link = true; }
  void makeCloud(std::size_t body) { scene_.bodies.edit(body).cloud = std::make_shared<const CloudState>(); }
  void replaceBody(std::size_t body, const std::string& name) {
    NamedList<SceneBody> bodies;
    for (std::size_t k = 0; k < scene_.bodies.size(); ++k) {
      if (k == body) {
        bodies.push_back(box(name, unit_));
        for (const auto& pair : pairs_) {
          if (pair->heading.body_b == scene_.bodies[k].name) pair->heading.body_b = name;
        }
      } else {
        bodies.appendShared(scene_.bodies, k);
      }
    }
    scene_.bodies = bodies;
  }
  void warn(std::size_t pair, bool raised) { pairs_[pair]->heading.warning = raised; }
  void wait(double seconds) { header_.stamp += ros::Duration(seconds); }
  SceneMarkers& drawing() { return drawing_; }

  MarkerStyle style;
  std::vector<PairContactState> contacts;

 private:
  // Eight directions in the plane, then the same one floor higher.
  void solve(std::size_t k) {
    TrackedPair& pair = *tracked_[k];
    const double angle = 2.0 * M_PI * static_cast<double>(k % 8) / 8.0;
    const Eigen::Vector3d away(std::cos(angle), std::sin(angle), 0.0);
    const double gap = unit_ * (0.1 + 0.05 * static_cast<double>(k));
    const Eigen::Vector3d from = 0.5 * unit_ * away;
    const Eigen::Vector3d to = from + gap * away;
    pair.demand.due = pair.demand.watched = pair.demand.niches = true;
    pairs_[k]->status.code = PairStatus::OK;
    pairs_[k]->heading.with_niches = true;
    pair.state = PairState::Solved;
    pair.input.a_from_b.translation() = to + 0.75 * unit_ * away;
    pair.solution.status = SolveStatus::Ok;
    for (int niche = 0; niche < 2; ++niche) {
      TrackedNiche found;
      found.id = static_cast<std::uint64_t>(niche + 1);
      found.distance = gap * (1.0 + niche);
      found.point_a_in_a = from;
      found.point_b_in_a = from + found.distance * away;
      found.normal_in_a = away;
      pair.solution.niches.push_back(found);
    }
    pair.solution.distance = gap;
    pair.solution.point_a_in_a = from;
    pair.solution.point_b_in_a = to;
  }

  double unit_;
  Scene scene_;
  std::vector<std::shared_ptr<TrackedPair>> tracked_;
  PublishedPairs pairs_;
  SceneMarkers drawing_;
  std_msgs::Header header_;
};

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::vector<Marker> withKind(const MarkerArray& message, const std::string& kind, int action = Marker::ADD) {
  std::vector<Marker> found;
  for (const Marker& marker : message.markers) {
    if (marker.action == action && endsWith(marker.ns, kind)) found.push_back(marker);
  }
  return found;
}

TEST(SceneMarkers, NeedTheNichesOfTheNearestPairsAndOfThoseInWarning) {
  Picture picture(12);
  picture.style.pair_count = 2;
  EXPECT_TRUE(picture.wanted().empty()) << "nothing has been drawn";
  const MarkerArray message = picture.draw();
  EXPECT_EQ(picture.wanted(), (std::set<std::string>{"middle/box_1", "middle/box_2"}));
  EXPECT_EQ(withKind(message, "middle/box_2/line").size(), 2U);
  EXPECT_TRUE(withKind(message, "middle/box_3/line").empty());
  picture.warn(11, true);
  picture.moveNearest(2, 0.05);  // before the other two
  picture.draw();
  EXPECT_EQ(picture.wanted(), (std::set<std::string>{"middle/box_3", "middle/box_1", "middle/box_12"}));
  picture.drawing().forget();
  EXPECT_TRUE(picture.wanted().empty()) << "nobody looks";
}

TEST(SceneMarkers, DrawTheShortestDistanceOfAPairWhoseNichesAreNotKnown) {
  Picture picture(1);
  picture.dropNiches(0);
  const std::vector<Marker> lines = withKind(picture.draw(), "middle/box_1/line");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].id, 0);
  EXPECT_NEAR(lines[0].points[1].x - lines[0].points[0].x, 0.1, 1e-12);
}

// A row of contacts far from each other, the last the deepest: k + 1 mm.
PairContactState manyContacts(std::size_t count) {
  PairContactState state;
  state.pair = "middle/box_1";
  for (std::size_t k = 0; k < count; ++k) {
    Contact contact;
    contact.id = k + 1;
    contact.has_depth = 1;
    contact.depth = 1e-3 * static_cast<double>(k + 1);
    contact.centroid.x = 100.0 * static_cast<double>(k + 1);
    state.contacts.push_back(contact);
  }
  return state;
}

TEST(SceneMarkers, NameEveryDrawnPairAboveItsLineAndDrawTheNearestThick) {
  Picture picture(12);
  picture.style.pair_count = 0;
  picture.style.scale = 0.001;  // no label is near another one
  const MarkerArray message = picture.draw();
  const std::vector<Marker> texts = withKind(message, "/text");
  ASSERT_EQ(texts.size(), 12U);
  EXPECT_TRUE(endsWith(texts[0].text, " middle - box_1: 100 mm"));
  EXPECT_TRUE(endsWith(texts[1].text, " middle - box_2: 150 mm"));
  const double first = withKind(message, "middle/box_1/line").front().scale.x;
  for (const Marker& text : texts) {
    const Marker line = withKind(message, text.ns.substr(0, text.ns.rfind('/')) + "/line").front();
    EXPECT_NEAR(text.pose.position.x, 0.5 * (line.points[0].x + line.points[1].x), 1e-12);
    EXPECT_NEAR(text.pose.position.y, 0.5 * (line.points[0].y + line.points[1].y), 1e-12);
    EXPECT_GT(text.pose.position.z, line.points[0].z + 0.5 * text.scale.z);
    EXPECT_EQ(line.scale.x < 0.6 * first, text.ns != "middle/box_1/text");
  }
}

TEST(SceneMarkers, LabelsAtOnePlaceStandAboveEachOtherTheNearestLowest) {
  Picture picture(3);
  picture.contacts = {manyContacts(6)};
  for (Contact& contact : picture.contacts[0].contacts) contact.centroid.x *= 1e-6;
  const std::vector<Marker> labels = withKind(picture.draw(), "/contact_text");
  ASSERT_EQ(labels.size(), 6U);
  for (std::size_t k = 1; k < labels.size(); ++k) {
    EXPECT_LT(labels[k].id, labels[k - 1].id) << "the deepest first";
    EXPECT_EQ(labels[k].pose.position.x, labels[0].pose.position.x);
    EXPECT_GT(labels[k].pose.position.z, labels[k - 1].pose.position.z + labels[k].scale.z);
    EXPECT_LT(labels[k].pose.position.z, labels[k - 1].pose.position.z + 1.5 * labels[k].scale.z);
  }
}

TEST(SceneMarkers, APairWhoseTransformsBecomeStaleStaysAsItWas) {
  Picture picture(2);
  picture.draw();
  picture.makeStale(0);
  for (int k = 0; k < 2; ++k) {
    const MarkerArray message = picture.draw();
    EXPECT_EQ(withKind(message, "box_1/line").front().points.size(), 10U) << "dashed";
    EXPECT_EQ(withKind(message, "box_1/line").size(), 2U) << "with its other niche";
    EXPECT_TRUE(endsWith(withKind(message, "box_1/text").front().text, " middle - box_1: 100 mm, stale"));
  }
}

TEST(SceneMarkers, GrowWithTheScene) {
  const auto sizes = [](double unit) {
    Picture picture(3, unit);
    std::vector<double> values;
    for (const Marker& marker : picture.draw().markers) {
      const bool text = marker.type == Marker::TEXT_VIEW_FACING;
      values.push_back((text ? marker.scale.z : marker.scale.x) / unit);
    }
    return values;
  };
  const std::vector<double> small = sizes(1.0);
  const std::vector<double> large = sizes(1000.0);
  ASSERT_EQ(small.size(), large.size());
  for (std::size_t k = 0; k < small.size(); ++k) EXPECT_NEAR(small[k], large[k], 1e-9 * large[k]);
}

TEST(SceneMarkers, LabelTheDeepestContactsAsManyAsNiches) {
  Picture picture(2);
  picture.style.niche_count = 12;
  picture.contacts = {manyContacts(40)};
  const MarkerArray message = picture.draw();
  const std::vector<Marker> labels = withKind(message, "/contact_text");
  ASSERT_EQ(labels.size(), 12U);
  for (const Marker& label : labels) EXPECT_GT(label.id, 40 - 12);
  EXPECT_EQ(withKind(message, "/contact_depth").size(), 40U);
  EXPECT_EQ(withKind(message, "box_2/text").size(), 1U) << "a pair without contacts keeps its label";
  EXPECT_TRUE(withKind(message, "box_1/text").empty());
  picture.style.niche_count = 0;
  EXPECT_EQ(withKind(picture.draw(), "/contact_text").size(), 40U);
}

TEST(SceneMarkers, TintTheBodiesOfAPairInWarningAndNoOther) {
  Picture picture(3);
  EXPECT_TRUE(withKind(picture.draw(), "warning").empty());
  picture.warn(1, true);
  const MarkerArray raised = picture.draw();
  const std::vector<Marker> tints = withKind(raised, "warning");
  ASSERT_EQ(tints.size(), 2U);
  EXPECT_EQ(tints[0].header.frame_id, "middle");
  EXPECT_EQ(tints[1].header.frame_id, "box_2");
  EXPECT_EQ(tints[1].points.size(), 36U);
  EXPECT_TRUE(tints[1].frame_locked);
  EXPECT_LT(tints[1].color.a, 0.7F);
  EXPECT_EQ(tints[1].lifetime, ros::Duration(3.0 * kLifetime));
  EXPECT_EQ(withKind(raised, "/line").front().lifetime, ros::Duration(kLifetime));
  EXPECT_NE(withKind(raised, "box_2/text").front().text.find("middle - box_2"), std::string::npos)
      << "names where it is too close";
  picture.wait(0.1);
  EXPECT_TRUE(withKind(picture.draw(), "warning").empty()) << "a mesh is not sent in every message";
  picture.wait(kLifetime);
  EXPECT_EQ(withKind(picture.draw(), "warning").size(), 2U) << "but renewed";
  picture.warn(1, false);
  EXPECT_EQ(withKind(picture.draw(), "warning", Marker::DELETE).size(), 2U);
  EXPECT_TRUE(withKind(picture.draw(), "warning", Marker::DELETE).empty());
}

TEST(SceneMarkers, TintABodyAnewThatTakesAnothersNumber) {
  Picture picture(1);
  picture.warn(0, true);
  EXPECT_EQ(withKind(picture.draw(), "warning").size(), 2U);
  picture.replaceBody(1, "other");
  picture.wait(0.1);
  const std::vector<Marker> tints = withKind(picture.draw(), "warning");
  ASSERT_EQ(tints.size(), 1U);
  EXPECT_EQ(tints[0].header.frame_id, "other");
}

TEST(SceneMarkers, TintWhatIsWarnedOfAndTheNearestLinkOfARobot) {
  Picture picture(3);
  for (const std::size_t link : {1U, 2U, 3U}) picture.makeLink(link);
  for (const std::size_t pair : {1U, 2U}) picture.warn(pair, true);
  const std::vector<Marker> tints = withKind(picture.draw(), "warning");
  ASSERT_EQ(tints.size(), 2U);
  EXPECT_EQ(tints[0].header.frame_id, "middle");
  EXPECT_EQ(tints[1].header.frame_id, "box_2");
}

TEST(SceneMarkers, TintTheLinkAndNotTheCloud) {
  Picture picture(2);
  picture.makeLink(0);
  picture.makeCloud(1);
  picture.warn(0, true);
  const std::vector<Marker> tints = withKind(picture.draw(), "warning");
  ASSERT_EQ(tints.size(), 1U);
  EXPECT_EQ(tints[0].header.frame_id, "middle");
}

TEST(SceneMarkers, AreAllDeletedWhenNothingIsToBeDrawn) {
  Picture picture(3);
  picture.warn(0, true);
  std::set<std::pair<std::string, int>> shown;
  for (const Marker& marker : picture.draw().markers) shown.emplace(marker.ns, marker.id);
  EXPECT_FALSE(picture.drawing().empty());
  for (const Marker& marker : picture.clear().markers) {
    EXPECT_EQ(marker.action, Marker::DELETE);
    shown.erase({marker.ns, marker.id});
  }
  EXPECT_TRUE(shown.empty());
  EXPECT_TRUE(picture.drawing().empty());
}

}  // namespace
}  // namespace concave_distance::scene_markers_test

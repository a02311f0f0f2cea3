// The picture of a whole scene: what is drawn, how large, where the labels are, what is deleted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "ros/box_scene.h"
#include "ros/markers/marker_layout.h"
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
  // One cycle of the node with nobody but the markers. @return the pairs whose niches were asked for
  std::vector<std::string> runCycle(double seconds) {
    std::vector<std::string> asked;
    drawing_.demand().begin(seconds);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const bool wanted = drawing_.demand().wantsNiches(pairs_[k]->heading.pair);
      tracked_[k]->demand.niches = pairs_[k]->heading.with_niches = wanted;
      tracked_[k]->solution.solve_seconds = solve_seconds;
      if (wanted) asked.push_back(pairs_[k]->heading.pair);
    }
    drawing_.demand().take(pairs_);
    return asked;
  }
  void moveNearest(std::size_t pair, double distance) {
    PairSolution& solution = tracked_[pair]->solution;
    const Eigen::Vector3d away = (solution.point_b_in_a - solution.point_a_in_a).normalized();
    solution.distance = distance;
    solution.point_b_in_a = solution.point_a_in_a + distance * away;
  }
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
  std::vector<LocatedBody> bodies() const { return locateBodies(scene_, pairs_); }

  MarkerStyle style;
  std::vector<PairContactState> contacts;
  double solve_seconds = 0.0;

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

// Cycles until each selected pair was asked; how often each was.
std::map<std::string, int> askedIn(Picture& picture, int cycles, double seconds) {
  std::map<std::string, int> asked;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    for (const std::string& pair : picture.runCycle(seconds)) ++asked[pair];
    picture.draw();
  }
  return asked;
}

TEST(SceneMarkers, AskForTheNichesOfTheNearestPairsAndDrawThemWhenTheyCome) {
  Picture picture(12);
  picture.style.pair_count = 5;
  picture.runCycle(1.0);
  EXPECT_EQ(withKind(picture.draw(), "/line").size(), 5U) << "the shortest distances need no niches";
  EXPECT_EQ(askedIn(picture, 6, 1.0).size(), 5U);
  const MarkerArray message = picture.draw();
  EXPECT_EQ(withKind(message, "middle/box_5/line").size(), 2U);
  EXPECT_TRUE(withKind(message, "middle/box_6/line").empty());
  EXPECT_NE(withKind(message, "legend").front().text.find("5 nearest of 12"), std::string::npos);
  picture.warn(11, true);
  picture.draw();
  EXPECT_EQ(askedIn(picture, 8, 1.0).size(), 6U) << "and of every pair in warning";
  picture.warn(11, false);
  picture.wait(0.9);
  picture.draw();
  EXPECT_EQ(askedIn(picture, 2, 1.0).size(), 6U) << "it may come back";
  picture.wait(0.2);
  picture.draw();
  EXPECT_EQ(askedIn(picture, 2, 1.0).size(), 5U);
  picture.drawing().forget();
  EXPECT_TRUE(picture.runCycle(1.0).empty()) << "nobody looks";
}

TEST(SceneMarkers, AskInTurnsForNoMoreThanTheirShareOfTheTime) {
  Picture picture(12);
  picture.style.pair_count = 5;
  picture.solve_seconds = 0.008;
  picture.runCycle(0.005);
  picture.draw();
  const std::map<std::string, int> asked = askedIn(picture, 400, 0.005);
  EXPECT_EQ(asked.size(), 5U);
  for (const auto& [pair, count] : asked) EXPECT_NEAR(count, 400 * 0.005 / 0.008 / 5, 1.0) << pair;
  picture.solve_seconds = 0.0005;
  askedIn(picture, 20, 0.005);
  for (const auto& [pair, count] : askedIn(picture, 10, 0.005)) EXPECT_EQ(count, 10) << pair;
  picture.solve_seconds = 10.0;  // a first solve
  askedIn(picture, 1, 0.005);
  picture.solve_seconds = 0.0;
  EXPECT_TRUE(askedIn(picture, 198, 0.005).empty());
  EXPECT_FALSE(askedIn(picture, 6, 0.005).empty()) << "the debt has an end";
}

TEST(SceneMarkers, DrawTheNearestPointsOfThePresentCycleBetweenTwoQuestions) {
  Picture picture(3);
  picture.runCycle(1.0);
  picture.draw();
  askedIn(picture, 4, 1.0);
  picture.runCycle(0.0);  // nothing is asked
  picture.moveNearest(0, 0.07);
  const std::vector<Marker> lines = withKind(picture.draw(), "middle/box_1/line");
  ASSERT_EQ(lines.size(), 2U) << "the other niche is that of the last question";
  const geometry_msgs::Point& to = lines[0].points[1];
  EXPECT_NEAR(std::hypot(to.x - lines[0].points[0].x, to.y - lines[0].points[0].y), 0.07, 1e-12);
}

// The text without the empty rows above and below it.
std::string wordsOf(const Marker& text) {
  const std::size_t first = text.text.find_first_not_of('\n');
  return text.text.substr(first, text.text.find_last_not_of('\n') + 1 - first);
}
Eigen::Vector3d placeOf(const Marker& marker) {
  return {marker.pose.position.x, marker.pose.position.y, marker.pose.position.z};
}

TEST(SceneMarkers, EveryDrawnPairIsNamedAboveTheSceneInARowThatHidesNoOther) {
  Picture picture(12);
  picture.style.pair_count = 0;
  const MarkerArray message = picture.draw();
  const std::vector<Marker> texts = withKind(message, "/text");
  ASSERT_EQ(texts.size(), 12U);
  EXPECT_EQ(wordsOf(texts[0]), "1   middle - box_1: 100 mm");
  EXPECT_EQ(wordsOf(texts[1]), "2   middle - box_2: 150 mm");
  double top = 0.0;
  for (const LocatedBody& body : picture.bodies()) top = std::max(top, body.box.max().z());
  std::set<std::size_t> rows;
  for (const Marker& text : texts) {
    EXPECT_EQ(text.pose, texts[0].pose);
    EXPECT_EQ(std::count(text.text.begin(), text.text.end(), '\n'), 12 - 1 + 5) << "and the legend's rows";
    rows.insert(text.text.find_first_not_of('\n'));
    EXPECT_GT(placeOf(text).z() - 0.5 * 17.0 * (text.scale.z + 0.01), top);
  }
  EXPECT_EQ(rows.size(), texts.size());
}

TEST(SceneMarkers, NumbersLieInNoBodyAndCamerasAllAroundSeeCloseOnesApart) {
  Picture picture(16);
  picture.style.pair_count = 0;
  const MarkerArray message = picture.draw();
  const std::vector<Marker> numbers = withKind(message, "/number");
  ASSERT_EQ(numbers.size(), 16U);
  for (const Marker& number : numbers) {
    EXPECT_EQ(number.text, number.ns.substr(11, number.ns.find("/number") - 11))
        << "of the pair middle/box_k";
    for (const LocatedBody& body : picture.bodies()) {
      EXPECT_GT(std::sqrt(body.box.squaredExteriorDistance(placeOf(number))), 0.3 * number.scale.z);
    }
    for (const Marker& other : numbers) {
      if (other.ns == number.ns) continue;
      for (const double pitch : {0.0, 0.3, 0.59}) {
        for (double yaw = 0.0; yaw < 2.0 * M_PI; yaw += 0.1) {
          const Eigen::Vector3d right(-std::sin(yaw), std::cos(yaw), 0.0);
          const Eigen::Vector3d up(-std::sin(pitch) * std::cos(yaw), -std::sin(pitch) * std::sin(yaw),
                                   std::cos(pitch));
          const Eigen::Vector3d between = placeOf(number) - placeOf(other);
          const double height = number.scale.z;
          if (between.head<2>().norm() > 4.0 * height) continue;
          EXPECT_GT(std::max(std::abs(between.dot(right)), std::abs(between.dot(up))), height);
        }
      }
    }
  }
}

TEST(SceneMarkers, ANumberStaysWithItsPairAndAFreeOneIsTaken) {
  Picture picture(4);
  picture.style.pair_count = 2;
  picture.draw();
  picture.moveNearest(2, 0.05);  // before the other two
  const MarkerArray message = picture.draw();
  const std::vector<Marker> texts = withKind(message, "/text");
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(wordsOf(texts[0]), "1   middle - box_1: 100 mm");
  EXPECT_EQ(wordsOf(texts[1]), "2   middle - box_3: 50.0 mm");
  picture.style.pair_count = 1;
  const MarkerArray single = picture.draw();
  EXPECT_EQ(wordsOf(withKind(single, "/text").front()), "middle - box_3: 50.0 mm");
  EXPECT_TRUE(withKind(single, "/number").empty()) << "one needs no number";
}

TEST(SceneMarkers, APairWhoseTransformsBecomeStaleStaysAsItWas) {
  Picture picture(2);
  picture.runCycle(1.0);
  picture.draw();
  askedIn(picture, 4, 1.0);
  picture.makeStale(0);
  const MarkerArray message = picture.draw();
  EXPECT_EQ(withKind(message, "box_1/line").front().points.size(), 10U) << "dashed";
  EXPECT_EQ(wordsOf(withKind(message, "box_1/text").front()), "1   middle - box_1: 100 mm, stale");
  EXPECT_NE(withKind(message, "legend").front().text.find("dashed"), std::string::npos);
}

TEST(SceneMarkers, NumbersStayWhereTheyAreWhileNothingMoves) {
  Picture picture(5);
  const std::vector<Marker> before = withKind(picture.draw(), "/number");
  for (int k = 0; k < 5; ++k) {
    picture.wait(0.7);
    const std::vector<Marker> after = withKind(picture.draw(), "/number");
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t n = 0; n < after.size(); ++n) EXPECT_EQ(after[n].pose, before[n].pose);
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

TEST(SceneMarkers, ListTheDeepestContactsAsManyAsNichesAndAtMostFiftyRows) {
  Picture picture(2);
  picture.style.niche_count = 12;
  picture.contacts = {manyContacts(40)};
  const MarkerArray message = picture.draw();
  const std::vector<Marker> labels = withKind(message, "/contact_text");
  ASSERT_EQ(labels.size(), 12U);
  for (const Marker& label : labels) EXPECT_GT(label.id, 40 - 12);
  EXPECT_EQ(withKind(message, "/contact_depth").size(), 40U);
  EXPECT_EQ(withKind(message, "box_2/text").size(), 1U) << "a pair without contacts keeps its row";
  EXPECT_EQ(wordsOf(withKind(message, "more").front()), "and 28 more");
  picture.style.niche_count = 0;
  picture.contacts = {manyContacts(1000)};
  EXPECT_EQ(withKind(picture.draw(), "/contact_text").size(), 50U);
}

TEST(SceneMarkers, CountThePairsInWarningThatTheListHasNoRoomFor) {
  Picture picture(12);
  for (std::size_t pair = 0; pair < 12; ++pair) picture.warn(pair, true);
  MarkerArray message = picture.draw();
  EXPECT_EQ(withKind(message, "/line").size(), 12U);
  EXPECT_EQ(withKind(message, "/number").size(), 8U);
  EXPECT_EQ(withKind(message, "/text").size(), 8U);
  EXPECT_EQ(wordsOf(withKind(message, "more").front()), "and 4 more");
  picture.style.pair_count = 11;
  message = picture.draw();
  EXPECT_EQ(withKind(message, "/text").size(), 11U) << "as many as are asked for";
  EXPECT_EQ(wordsOf(withKind(message, "more").front()), "and 1 more");
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

TEST(SceneMarkers, HaveOneLegendThatCanBeSwitchedOff) {
  Picture picture(3);
  const std::vector<Marker> legend = withKind(picture.draw(), "legend");
  ASSERT_GE(legend.size(), 3U);
  std::set<int> ids;
  for (const Marker& marker : legend) ids.insert(marker.id);
  EXPECT_EQ(ids.size(), legend.size());
  picture.style.legend = false;
  const MarkerArray without = picture.draw();
  EXPECT_TRUE(withKind(without, "legend").empty());
  EXPECT_EQ(withKind(without, "legend", Marker::DELETE).size(), legend.size());
}

// rviz puts a centimetre between the rows of one text.
TEST(SceneMarkers, RowsOfTheLegendOfASmallSceneStandByThemselves) {
  Picture picture(3, 0.02);
  const std::vector<Marker> legend = withKind(picture.draw(), "legend");
  ASSERT_GE(legend.size(), 3U);
  double above = legend.front().pose.position.z;
  for (const Marker& marker : legend) {
    EXPECT_EQ(marker.text.find('\n'), std::string::npos);
    const double lower = above - marker.pose.position.z;
    EXPECT_TRUE(lower == 0.0 || lower > 1.2 * marker.scale.z) << "rows " << lower << " apart";
    above = marker.pose.position.z;
  }
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

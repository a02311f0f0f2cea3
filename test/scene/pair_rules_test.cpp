#include "concave_distance/scene/pair_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/random_engine.h"
#include "concave_distance/scene/scene.h"
#include "scene/rule_edits.h"

namespace concave_distance::pair_rules_test {
namespace {

using Flags = std::vector<bool>;

BodySet setOf(const Flags& flags) {
  BodySet set;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i]) set.insert(i);
  }
  return set;
}

TEST(BodySet, IsWhatFlagsSay) {
  RandomEngine engine(3);
  for (int round = 0; round < 200; ++round) {
    const std::size_t size = 1 + engine() % 200;
    const auto some = [&] {
      Flags flags(size, false);
      for (std::size_t i = 0; i < size; ++i) flags[i] = engine() % 3 == 0;
      return flags;
    };
    const Flags a = some();
    const Flags b = some();
    Flags both = a;
    Flags either = a;
    Flags only_a = a;
    Flags left;
    bool is_within = true;
    for (std::size_t i = 0; i < size; ++i) {
      both[i] = a[i] && b[i];
      either[i] = a[i] || b[i];
      only_a[i] = a[i] && !b[i];
      is_within = is_within && !only_a[i];
      if (!b[i]) left.push_back(a[i]);
    }
    EXPECT_EQ(setOf(a) & setOf(b), setOf(both));
    EXPECT_EQ(setOf(a) | setOf(b), setOf(either));
    EXPECT_EQ(setOf(a) - setOf(b), setOf(only_a));
    EXPECT_EQ(setOf(a).isWithin(setOf(b)), is_within);
    EXPECT_TRUE(setOf(both).isWithin(setOf(a)));
    BodySet taken = setOf(a);
    taken.takeOut(b);
    EXPECT_EQ(taken, setOf(left));
    const std::size_t end = engine() % (size + 2);
    BodySet first = setOf(a);
    first.keepBefore(end);
    EXPECT_EQ(first, setOf(a) & BodySet::before(end));
    const std::vector<std::size_t> indices = setOf(a).indices();
    EXPECT_EQ(indices.size(), static_cast<std::size_t>(std::count(a.begin(), a.end(), true)));
    EXPECT_EQ(setOf(a).size(), indices.size());
    EXPECT_EQ(BodySet(indices), setOf(a));
    for (std::size_t i = 0; i < size + 70; ++i) EXPECT_EQ(setOf(a).contains(i), i < size && a[i]);
    if (indices.empty()) continue;
    EXPECT_EQ(setOf(a).first(), indices.front());
    EXPECT_EQ(setOf(a).last(), indices.back());
    EXPECT_EQ(BodySet::before(size), setOf(Flags(size, true)));
  }
}

/// Keeps the settings of one pair, as an oracle that has no rules.
struct Said {
  bool is_watched = false;
  bool is_enabled = true;
  bool later_is_a = false;
  double cutoff = 0.0;
};

/// Makes the same changes in the rules of a scene and in a table of all its pairs.
class Twin {
 public:
  explicit Twin(std::uint64_t seed) : engine_(seed) {
    scene.defaults.pairs.tracker.cutoff = 0.0;
    for (int i = 0; i < 9; ++i) add({}, 0.0);
  }

  void step() {
    switch (engine_() % 6) {
      case 0:
        add(someBodies(), static_cast<double>(engine_() % 3));
        break;
      case 1:
        if (scene.bodies.size() > 4) takeOut();
        break;
      default:
        change();
    }
  }

  void check() {
    const std::size_t count = scene.bodies.size();
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const PairRule& rule = scene.rules.of(i, j);
        const Said& said = said_[j][i];
        ASSERT_EQ(rule.is_watched, said.is_watched) << i << " " << j;
        ASSERT_EQ(rule.is_enabled, said.is_enabled) << i << " " << j;
        ASSERT_EQ(settingsOf(scene, rule).tracker.cutoff, said.cutoff) << i << " " << j;
        if (!said.is_watched) continue;
        ASSERT_EQ(rule.ordered(j, i).first, said.later_is_a ? j : i);
      }
    }
    const BodySet a = someBodies();
    const BodySet b = BodySet::before(count) - a;
    EXPECT_EQ(countPairsByRule(scene), counted(BodySet::before(count), BodySet::before(count)));
    EXPECT_EQ(countPairsByRule(scene, {{a, b}, {b, a}}), counted(a, b) + counted(b, a));
    checkBodies();
  }

  Scene scene;

 private:
  BodySet someBodies() {
    BodySet set;
    const std::uint64_t some = 1 + engine_() % 4;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (engine_() % some == 0) set.insert(i);
    }
    return set;
  }

  void add(const BodySet& partners, double cutoff) {
    SceneBody body;
    body.name = body.frame = "b" + std::to_string(++names_);
    scene.bodies.push_back(std::move(body));
    PairSettings settings;
    settings.tracker.cutoff = cutoff;
    detail::addRulesOfNewBody(scene, partners, settings);
    said_.emplace_back();
    for (std::size_t i = 0; i + 1 < scene.bodies.size(); ++i)
      said_.back().push_back({partners.contains(i), true, true, cutoff});
  }

  void takeOut() {
    const std::size_t gone = engine_() % scene.bodies.size();
    Flags flags(scene.bodies.size(), false);
    flags[gone] = true;
    NamedList<SceneBody> bodies;
    for (std::size_t i = 0; i < flags.size(); ++i) {
      if (i != gone) bodies.appendShared(scene.bodies, i);
    }
    scene.bodies = std::move(bodies);
    detail::takeOutOfRules(scene.rules, flags);
    for (std::size_t j = gone + 1; j < said_.size(); ++j)
      said_[j].erase(said_[j].begin() + static_cast<std::ptrdiff_t>(gone));
    said_.erase(said_.begin() + static_cast<std::ptrdiff_t>(gone));
  }

  void change() {
    const BodySet a = someBodies();
    const BodySet b = engine_() % 3 == 0 ? a : someBodies();
    const std::uint64_t kind = engine_() % 4;
    const double cutoff = static_cast<double>(engine_() % 3);
    const bool is_ordered = engine_() % 4 == 0;
    const detail::RuleChange to_rule = [&](PairRule& rule, PairSettings& settings, PairOrder order) {
      if (kind == 0) rule.watch(order);
      if (kind == 1) rule.is_enabled = false;
      if (kind == 2) rule.is_enabled = true;
      if (kind == 3) settings.tracker.cutoff = cutoff;
    };
    if (is_ordered) {
      detail::changeOrderedRules(scene, a, b, PairOrder::Later, to_rule);
    } else {
      detail::changeRules(scene, a, b, to_rule);
    }
    for (std::size_t j = 0; j < said_.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const bool forwards = a.contains(i) && b.contains(j);
        const bool backwards = !is_ordered && a.contains(j) && b.contains(i);
        if (!forwards && !backwards) continue;
        Said& said = said_[j][i];
        if (kind == 0 && !said.is_watched) said.later_is_a = is_ordered || !forwards;
        if (kind == 0) said.is_watched = true;
        if (kind == 1) said.is_enabled = false;
        if (kind == 2) said.is_enabled = true;
        if (kind == 3) said.cutoff = cutoff;
      }
    }
  }

  std::size_t counted(const BodySet& earlier, const BodySet& later) const {
    std::size_t count = 0;
    for (const std::size_t j : later.indices()) {
      for (const std::size_t i : earlier.indices())
        count += i < j && said_[j][i].is_watched && said_[j][i].is_enabled ? 1 : 0;
    }
    return count;
  }

  // Bodies whose pairs a rule decides are among those that it names for itself.
  void checkBodies() const {
    const std::vector<PairRule>& list = scene.rules.list;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const BodySet bodies = scene.rules.bodiesOf(k);
      for (std::size_t j = 0; j < said_.size(); ++j) {
        for (std::size_t i = 0; i < j; ++i) {
          if (&scene.rules.of(i, j) != &list[k]) continue;
          ASSERT_TRUE(bodies.contains(i) && bodies.contains(j));
        }
      }
    }
  }

  RandomEngine engine_;
  std::vector<std::vector<Said>> said_;  ///< of a later and an earlier body
  int names_ = 0;
};

TEST(PairRules, SayOfEachPairWhatWasSaidOfItLast) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Twin twin(seed);
    for (int step = 0; step < 30 && !::testing::Test::HasFatalFailure(); ++step) {
      twin.step();
      twin.check();
    }
  }
}

Scene sceneOf(std::size_t bodies) {
  Scene scene;
  for (std::size_t i = 0; i < bodies; ++i) {
    SceneBody body;
    body.name = body.frame = "b" + std::to_string(i);
    scene.bodies.push_back(std::move(body));
    detail::addRulesOfNewBody(scene, BodySet::before(i), scene.defaults.pairs);
  }
  return scene;
}

// A client may switch the same pairs on and off, and set their distances, for days.
TEST(PairRules, DoNotBecomeMoreWhenTheSamePairsAreChangedAgain) {
  Scene scene = sceneOf(40);
  EXPECT_EQ(scene.rules.list.size(), 1U) << "bodies that are watched alike have one rule";
  const BodySet even({0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20});
  const BodySet low = BodySet::before(15);
  std::size_t rules = 0;
  for (int round = 0; round < 50; ++round) {
    for (const BodySet& side : {even, low}) {
      detail::changeRules(scene, side, BodySet::before(40),
                          [&](PairRule& rule, PairSettings& settings, PairOrder) {
                            rule.is_enabled = round % 3 == 0;
                            settings.warning_distance = 0.01 * round;
                          });
    }
    if (round == 3) rules = scene.rules.list.size();
  }
  EXPECT_LE(scene.rules.list.size(), rules);
  EXPECT_LE(scene.rules.settings.size(), scene.rules.list.size() + 1);
  detail::takeOutOfRules(scene.rules, Flags(40, true));
  EXPECT_TRUE(scene.rules.list.empty());
}

}  // namespace
}  // namespace concave_distance::pair_rules_test

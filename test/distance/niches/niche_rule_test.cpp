#include "distance/niches/niche_rule.h"

#include <gtest/gtest.h>

#include "base/constants.h"

namespace concave_distance::niche_rule_test {
namespace {

TEST(NicheRule, AMinimumIsANicheFromTheLevelOfItsLeastProminenceOn) {
  const NicheRule rule{0.25, 0.0};
  EXPECT_EQ(rule.levelOf(2.0), 2.5);
  EXPECT_EQ(NicheRule::prominenceOf(2.0, rule.levelOf(2.0)), 0.25);
  EXPECT_EQ(NicheRule::prominenceOf(2.0, 2.0), 0.0);
  EXPECT_EQ(NicheRule::prominenceOf(2.0, kInfinity), kInfinity);
  EXPECT_EQ(NicheRule::prominenceOf(0.0, 1.0), kInfinity);
  EXPECT_EQ((NicheRule{0.0, 0.0}.levelOf(2.0)), 2.0);
}

TEST(NicheRule, ProminencesAreMeasuredUpToTheirLimitAndTheCutoffButNeverLessThanDecides) {
  EXPECT_FALSE((NicheRule{0.25, 0.25}.measuresProminences()));
  const NicheRule rule{0.25, 1.0};
  EXPECT_TRUE(rule.measuresProminences());
  EXPECT_EQ(rule.measuredLevelOf(2.0, kInfinity), 4.0);
  EXPECT_EQ(rule.measuredLevelOf(2.0, 3.0), 3.0);
  EXPECT_EQ(rule.measuredLevelOf(2.0, 1.0), 2.5);
  EXPECT_EQ((NicheRule{0.25, kInfinity}.measuredLevelOf(2.0, 3.0)), 3.0);
}

TEST(NicheRule, OneNicheIsAllThatDistancesCloserThanTheLeastProminenceAllow) {
  const NicheRule rule{0.25, 0.0};
  EXPECT_TRUE(rule.allowsOneNicheOnly(2.0, 2.4));
  EXPECT_FALSE(rule.allowsOneNicheOnly(2.0, 2.5));
  EXPECT_FALSE(rule.allowsOneNicheOnly(0.0, 0.0));
}

}  // namespace
}  // namespace concave_distance::niche_rule_test

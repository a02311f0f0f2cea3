#include "distance/niches/niche_rule.h"

#include <gtest/gtest.h>

#include "base/constants.h"

namespace concave_distance::niche_rule_test {
namespace {

TEST(NicheRule, AMinimumIsANicheFromTheLevelOfItsLeastProminenceOn) {
  const NicheRule rule{0.25, 0.0};
  EXPECT_EQ(rule.levelOf(2.0), 2.5);
  EXPECT_EQ(rule.prominenceOf(2.0, rule.levelOf(2.0)), 0.25);
  EXPECT_EQ(rule.prominenceOf(2.0, 2.0), 0.0);
  EXPECT_EQ(rule.prominenceOf(2.0, kInfinity), kInfinity);
  EXPECT_EQ(rule.prominenceOf(0.0, 1.0), kInfinity);
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

TEST(NicheRule, WithAMarginTheLevelAndTheProminenceAreThoseOfTheDistanceLessTheMargin) {
  const NicheRule rule{0.25, 1.0, 1.0};
  EXPECT_EQ(rule.levelOf(3.0), 3.5);
  EXPECT_EQ(rule.riseAt(3.0), 0.5);
  EXPECT_EQ(rule.leastRiseFrom(3.0), 0.5);
  EXPECT_EQ(rule.prominenceOf(3.0, 3.5), 0.25);
  EXPECT_EQ(rule.measuredLevelOf(3.0, kInfinity), 5.0);
  EXPECT_EQ(rule.measuredLevelOf(3.0, 4.0), 4.0);
  EXPECT_TRUE(rule.allowsOneNicheOnly(3.0, 3.4));
  EXPECT_FALSE(rule.allowsOneNicheOnly(3.0, 3.5));
}

TEST(NicheRule, WhatLiesWithinTheMarginIsAtZeroUpToTheMargin) {
  const NicheRule rule{0.25, kInfinity, 1.0};
  for (const double distance : {0.0, 0.5, 1.0}) {
    EXPECT_TRUE(rule.isAtZero(distance));
    EXPECT_EQ(rule.levelOf(distance), 1.0);
    EXPECT_EQ(rule.measuredLevelOf(distance, kInfinity), 1.0);
    EXPECT_EQ(rule.riseAt(distance), 1.0 - distance);
    EXPECT_EQ(rule.leastRiseFrom(distance), 0.0);
    EXPECT_EQ(rule.prominenceOf(distance, 2.0), kInfinity);
    EXPECT_FALSE(rule.allowsOneNicheOnly(distance, distance));
  }
}

}  // namespace
}  // namespace concave_distance::niche_rule_test

#include "tracking/niche_archive.h"

#include <gtest/gtest.h>

namespace concave_distance::niche_archive_test {
namespace {

NicheRecord recordAt(NicheArchive& archive, double distance, bool reported) {
  NicheRecord record;
  record.niche.id = archive.takeId();
  record.niche.distance = distance;
  record.niche.point_a_in_a = Eigen::Vector3d(distance, 0.0, 0.0);
  record.point_b_in_b = Eigen::Vector3d::Zero();
  record.reported = reported;
  return record;
}

TEST(NicheArchive, AMergeKeepsTheDeeperPlaceAndTheOlderId) {
  NicheArchive archive;
  std::vector<NicheEvent> events;
  archive.records().push_back(recordAt(archive, 2.0, true));  // id 1, shallower
  archive.records().push_back(recordAt(archive, 1.0, true));  // id 2, deeper
  archive.settle();
  archive.unite(0, 1, events);
  ASSERT_EQ(archive.records().size(), 1U);
  EXPECT_EQ(archive.records()[0].niche.id, 1U);
  EXPECT_EQ(archive.records()[0].niche.distance, 1.0);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, NicheEvent::Kind::Merge);
  EXPECT_EQ(events[0].id, 2U);
  EXPECT_EQ(events[0].into_id, 1U);
}

TEST(NicheArchive, AKnownIdDoesNotFallFartherThanItCanHaveMoved) {
  NicheArchive archive;
  std::vector<NicheEvent> events;
  archive.records().push_back(recordAt(archive, 2.0, true));
  archive.records().push_back(recordAt(archive, 1.0, false));
  archive.records()[0].least_distance = 1.5;
  EXPECT_EQ(archive.unite(0, 1, events), 2U);
  ASSERT_EQ(archive.records().size(), 1U);
  EXPECT_EQ(archive.records()[0].niche.id, 2U);
  EXPECT_EQ(archive.records()[0].niche.distance, 1.0);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].id, 1U);
  EXPECT_EQ(events[0].into_id, 2U);
}

TEST(NicheArchive, WhatWasNeverReportedEndsInSilence) {
  NicheArchive archive;
  std::vector<NicheEvent> events;
  archive.records().push_back(recordAt(archive, 1.0, true));
  archive.records().push_back(recordAt(archive, 2.0, false));
  archive.unite(0, 1, events);
  EXPECT_TRUE(events.empty());
  EXPECT_TRUE(archive.records()[0].reported);
}

TEST(NicheArchive, ARemovedNicheDiesAndItsIdIsNotUsedAgain) {
  NicheArchive archive;
  std::vector<NicheEvent> events;
  archive.records().push_back(recordAt(archive, 1.0, true));
  archive.remove(0, events);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, NicheEvent::Kind::Death);
  EXPECT_EQ(events[0].id, 1U);
  archive.clear();
  EXPECT_EQ(archive.takeId(), 2U);
}

TEST(NicheArchive, FindsARecordOnlyWhereBothPointsAgree) {
  NicheArchive archive;
  archive.records().push_back(recordAt(archive, 1.0, true));
  EXPECT_NE(archive.findSamePlace({1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 1e-9), nullptr);
  EXPECT_EQ(archive.findSamePlace({1.0, 0.0, 0.0}, {0.0, 1e-3, 0.0}, 1e-9), nullptr);
}

}  // namespace
}  // namespace concave_distance::niche_archive_test

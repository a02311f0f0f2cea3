#include "kinematics/slot_table.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace concave_distance::slot_table_test {
namespace {

using detail::NicheKey;
using detail::SlotRequest;
using detail::SlotTable;

SlotRequest request(std::uint64_t niche, double distance, double x = 0.0) {
  SlotRequest made;
  made.key = {1, 2, niche};
  made.distance = distance;
  made.on_a = made.on_b = Eigen::Vector3d(x, 0, 0);
  return made;
}

std::vector<std::size_t> slotsOf(SlotTable& table, std::vector<SlotRequest> requests) {
  table.assign(requests);
  std::vector<std::size_t> slots;
  for (const SlotRequest& each : requests) slots.push_back(each.slot);
  return slots;
}

using Slots = std::vector<std::size_t>;

TEST(SlotTable, BeginsInTheOrderOfDistance) {
  SlotTable table(4);
  EXPECT_EQ(slotsOf(table, {request(1, 0.3), request(2, 0.1), request(3, 0.2)}), (Slots{2, 0, 1}));
  table.clear();
  EXPECT_EQ(slotsOf(table, {request(1, 0.1), request(2, 0.2)}), (Slots{0, 1})) << "as after the start";
}

TEST(SlotTable, KeepsASlotWhileTheNicheLivesWhateverItsDistance) {
  SlotTable table(4);
  slotsOf(table, {request(1, 0.1), request(2, 0.2), request(3, 0.3)});
  EXPECT_EQ(slotsOf(table, {request(3, 0.1), request(2, 0.2), request(1, 0.3)}), (Slots{2, 1, 0}));
}

TEST(SlotTable, LeavesAFreedSlotAloneForTenCycles) {
  SlotTable table(3);
  slotsOf(table, {request(1, 0.1), request(2, 0.2)});
  EXPECT_EQ(slotsOf(table, {request(2, 0.2)}), (Slots{1}));
  EXPECT_EQ(table.slots()[0].state, SlotState::Freed);
  EXPECT_EQ(slotsOf(table, {request(2, 0.2), request(3, 0.1)}), (Slots{1, 2})) << "not the one just freed";
  for (std::uint64_t cycle = 2; cycle <= ConstraintRows::kQuarantine; ++cycle) {
    EXPECT_EQ(table.slots()[0].state, SlotState::Freed);
    slotsOf(table, {request(2, 0.2), request(3, 0.1)});
  }
  EXPECT_EQ(table.slots()[0].state, SlotState::Free);
  EXPECT_EQ(slotsOf(table, {request(2, 0.2), request(3, 0.1), request(4, 0.3)}), (Slots{1, 2, 0}));
}

TEST(SlotTable, UsesAFreedSlotRatherThanLeaveARowWithoutOne) {
  SlotTable table(2);
  slotsOf(table, {request(1, 0.1), request(2, 0.2)});
  slotsOf(table, {request(2, 0.2)});
  EXPECT_EQ(slotsOf(table, {request(2, 0.2), request(3, 0.1)}), (Slots{1, 0}));
}

TEST(SlotTable, LetsTheFarthestGoWhereThereAreMoreRowsThanSlots) {
  SlotTable table(2);
  std::vector<SlotRequest> requests{request(1, 0.3), request(2, 0.2)};
  EXPECT_EQ(table.assign(requests), 0U);
  requests = {request(1, 0.3), request(2, 0.2), request(3, 0.1), request(4, 0.4)};
  EXPECT_EQ(table.assign(requests), 2U);
  EXPECT_EQ(requests[0].slot, SlotRequest::kNone);
  EXPECT_EQ(requests[1].slot, 0U);
  EXPECT_EQ(requests[2].slot, 1U);
  EXPECT_EQ(requests[3].slot, SlotRequest::kNone);
}

TEST(SlotTable, GivesEachCornerOfANicheTheSlotOfTheNearestOne) {
  SlotTable table(8);
  slotsOf(table, {request(1, 0.1, 0.0), request(1, 0.2, 1.0), request(1, 0.3, 2.0)});
  EXPECT_EQ(slotsOf(table, {request(1, 0.1, 2.1), request(1, 0.2, 0.1)}), (Slots{2, 0}));
  EXPECT_EQ(table.slots()[1].state, SlotState::Freed);
}

TEST(SlotTable, KeepsARowAtTheEdgeAndBeginsNoneThere) {
  SlotTable table(2);
  slotsOf(table, {request(1, 0.1)});
  SlotRequest leaving = request(1, 0.104);
  SlotRequest arriving = request(2, 0.104);
  leaving.may_begin = arriving.may_begin = false;
  EXPECT_EQ(slotsOf(table, {leaving, arriving}), (Slots{0, SlotRequest::kNone}));
}

// Rows come, go and change their distances at random; what the rules promise is checked from outside.
TEST(SlotTable, HoldsItsPromisesInTheLongRun) {
  constexpr std::size_t kCapacity = 12;
  SlotTable table(kCapacity);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::map<std::uint64_t, std::size_t> slot_of;
  std::map<std::uint64_t, double> alive;
  std::map<std::size_t, int> last_used;
  std::uint64_t next = 1;
  for (int cycle = 0; cycle < 20'000; ++cycle) {
    for (auto niche = alive.begin(); niche != alive.end();) {
      niche->second = unit(engine);
      niche = unit(engine) < 0.1 ? alive.erase(niche) : std::next(niche);
    }
    while (unit(engine) < 0.55) alive[next++] = unit(engine);
    std::vector<SlotRequest> requests;
    for (const auto& [niche, distance] : alive) requests.push_back(request(niche, distance));
    const std::size_t overflow = table.assign(requests);
    ASSERT_EQ(overflow, alive.size() > kCapacity ? alive.size() - kCapacity : 0U);
    std::set<std::size_t> used;
    double farthest_kept = 0.0;
    double nearest_left = 2.0;
    for (const SlotRequest& each : requests) {
      if (each.slot == SlotRequest::kNone) {
        nearest_left = std::min(nearest_left, each.distance);
        slot_of.erase(each.key.niche);
        continue;
      }
      farthest_kept = std::max(farthest_kept, each.distance);
      ASSERT_TRUE(used.insert(each.slot).second) << "two rows in one slot";
      const auto known = slot_of.find(each.key.niche);
      if (known != slot_of.end()) {
        ASSERT_EQ(known->second, each.slot) << "a row has moved";
      }
      slot_of[each.key.niche] = each.slot;
    }
    ASSERT_LE(farthest_kept, nearest_left);
  }
}

}  // namespace
}  // namespace concave_distance::slot_table_test

// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/cost_queue.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <queue>

#include "tests/support/shapes.h"

namespace limber {
namespace {

constexpr auto kSameCost = [](Index, float cost) { return cost; };

std::vector<Index> all_in_order(CostQueue& queue) {
  std::vector<Index> order;
  while (queue.advance(kSameCost)) {
    order.push_back(queue.front());
    queue.pop();
  }
  return order;
}

TEST(CostQueue, WithoutItemsHasNoFront) {
  CostQueue queue(0);
  EXPECT_FALSE(queue.advance(kSameCost));
  EXPECT_FALSE(queue.advance(kSameCost));
}

TEST(CostQueue, GivesTheCheapestFirstAndTheLowerItemOfATie) {
  CostQueue queue(6);
  const float costs[] = {3, 1, 1, 0, 1e-30f, 3};
  for (const Index item : {5u, 2u, 0u, 4u, 1u, 3u}) queue.push(item, costs[item]);
  EXPECT_EQ(all_in_order(queue), (std::vector<Index>{3, 4, 1, 2, 0, 5}));
}

TEST(CostQueue, OrdersCostsThatDifferInTheLastBitOnly) {
  CostQueue queue(3);
  const float one_above = std::nextafter(1.0f, 2.0f);
  queue.push(0, std::nextafter(one_above, 2.0f));
  queue.push(1, one_above);
  queue.push(2, 1.0f);
  EXPECT_EQ(all_in_order(queue), (std::vector<Index>{2, 1, 0}));
}

TEST(CostQueue, TakesTheSmallestAndTheLargestCosts) {
  using Limits = std::numeric_limits<float>;
  CostQueue queue(5);
  const float costs[] = {Limits::infinity(), Limits::max(), Limits::min(), Limits::denorm_min(), 0};
  for (Index item = 0; item < 5; ++item) queue.push(item, costs[item]);
  EXPECT_EQ(all_in_order(queue), (std::vector<Index>{4, 3, 2, 1, 0}));
}

TEST(CostQueue, TakesACheaperItemAfterDearerOnes) {
  CostQueue queue(3);
  queue.push(0, 100);
  ASSERT_TRUE(queue.advance(kSameCost));
  queue.push(1, 50);
  ASSERT_TRUE(queue.advance(kSameCost));
  EXPECT_EQ(queue.front(), 1u);
}

TEST(CostQueue, CanBeUsedAgainOnceItIsEmpty) {
  CostQueue queue(2);
  queue.push(0, 1000);
  EXPECT_EQ(all_in_order(queue), std::vector<Index>{0});
  queue.push(1, 1);
  queue.push(0, 2);
  EXPECT_EQ(all_in_order(queue), (std::vector<Index>{1, 0}));
}

TEST(CostQueue, DropsWhatHasANegativePrice) {
  CostQueue queue(10);
  for (Index item = 0; item < 10; ++item) queue.push(item, 1 + static_cast<float>(item));
  std::vector<Index> order;
  while (queue.advance([](Index item, float cost) { return item % 2 ? -1.0f : cost; })) {
    order.push_back(queue.front());
    queue.pop();
  }
  EXPECT_EQ(order, (std::vector<Index>{0, 2, 4, 6, 8}));
}

TEST(CostQueue, KeepsTheOrderOfAHeapUnderGrowingCostsAndNewItems) {
  test::Random random(1);
  const auto random_cost = [&] {
    const std::uint32_t kind = random.below(4);
    if (kind == 0) return static_cast<float>(random.below(4));  // ties
    return std::ldexp(1 + random.unit() * 0.5f, static_cast<int>(random.below(kind == 1 ? 3 : 90)) - 60);
  };
  for (int round = 0; round < 50; ++round) {
    constexpr Index kItemCount = 300;
    CostQueue queue(kItemCount, round % 2 == 0 ? 32 : 1 << round % 6);
    std::priority_queue<std::pair<float, Index>, std::vector<std::pair<float, Index>>, std::greater<>> expected;
    std::vector<float> now(kItemCount);  // what the items cost; stale in `queue` until it asks
    std::vector<bool> inside(kItemCount, false);
    const auto push = [&](Index item) {
      now[item] = random_cost();
      inside[item] = true;
      queue.push(item, now[item]);
      expected.push({now[item], item});
    };
    for (Index item = 0; item < kItemCount; item += 2) push(item);
    for (int step = 0; step < 2000; ++step) {
      if (const Index grown = random.below(kItemCount); inside[grown]) now[grown] = std::max(now[grown], random_cost());
      if (const Index item = random.below(kItemCount); !inside[item] && random.below(3) == 0) push(item);

      // Either queue may hold old prices: an item at the front is put back until its price is that of now.
      while (!expected.empty() && expected.top().first != now[expected.top().second]) {
        const Index item = expected.top().second;
        expected.pop();
        expected.push({now[item], item});
      }
      // What lay in the heap when its price grew comes out under the old one.
      const auto now_of = [&](Index item, float) { return now[item]; };
      bool any = queue.advance(now_of);
      for (Index turns = 0; any && !expected.empty() && queue.front() != expected.top().second; ++turns) {
        ASSERT_LT(turns, kItemCount) << "a price of now comes out before a lower one";
        const Index item = queue.front();
        queue.pop();
        queue.push(item, now[item]);
        any = queue.advance(now_of);
      }
      ASSERT_EQ(any, !expected.empty());
      if (!any) continue;
      ASSERT_EQ(queue.front(), expected.top().second);
      inside[queue.front()] = false;
      queue.pop();
      expected.pop();
    }
  }
}

}  // namespace
}  // namespace limber

#include "app/bench/suite.hpp"

#include <gmock/gmock.h>

#include <map>
#include <set>

namespace lucerna::app::bench {
namespace {

// How often each variant comes directly after each other one.
std::map<std::pair<std::size_t, std::size_t>, int> followers(std::size_t count,
                                                             std::size_t rounds) {
  std::map<std::pair<std::size_t, std::size_t>, int> found;
  for (std::size_t round = 0; round < rounds; ++round) {
    const auto order = turnOrder(count, round);
    for (std::size_t i = 0; i + 1 < order.size(); ++i) ++found[{order[i], order[i + 1]}];
  }
  return found;
}

TEST(BenchTurns, EveryVariantTakesOneInARound) {
  for (const std::size_t count : {1u, 2u, 5u, 12u})
    for (std::size_t round = 0; round < 2 * count; ++round) {
      const auto order = turnOrder(count, round);
      EXPECT_EQ(order.size(), count);
      EXPECT_EQ(std::set(order.begin(), order.end()).size(), count);
      EXPECT_LT(*std::ranges::max_element(order), count);
    }
  EXPECT_TRUE(turnOrder(0, 3).empty());
}

TEST(BenchTurns, NoneAlwaysFollowsTheSameNeighbour) {
  for (const auto& [count, rounds, times] : {std::tuple{2u, 2u, 1}, {6u, 6u, 1}, {5u, 10u, 2}}) {
    const auto found = followers(count, rounds);
    EXPECT_EQ(found.size(), count * (count - 1));
    for (const auto& [pair, often] : found) EXPECT_EQ(often, times) << count << " variants";
  }
}

}  // namespace
}  // namespace lucerna::app::bench

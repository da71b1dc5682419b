// Logs that are torn or damaged, byte by byte.
#include "bake/unit_log.hpp"

#include <gmock/gmock.h>

#include <map>

#include "core/test_folder.hpp"

namespace lucerna::bake {
namespace {

using ::testing::HasSubstr;

constexpr std::uint64_t kPlan = 77;
constexpr std::size_t kUnits = 4;

class UnitLogTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto log = UnitLog::open(path_, kPlan, kUnits);
    ASSERT_TRUE(log);
    for (std::uint32_t unit = 0; unit < 3; ++unit) {
      payloads_[unit].assign(5 + unit, std::byte(unit + 1));
      ASSERT_TRUE(log->append(unit, payloads_[unit]));
    }
    auto bytes = readFile(path_);
    ASSERT_TRUE(bytes);
    bytes_ = *bytes;
  }
  // Writes these bytes, reads them as a log, and expects that nothing comes back that was not put
  // in.
  LogState read(std::span<const std::byte> bytes) {
    EXPECT_TRUE(writeFile(path_, bytes));
    const auto state = readUnitLog(path_, kPlan, kUnits, [&](std::uint32_t unit, auto payload) {
      EXPECT_TRUE(std::ranges::equal(payload, payloads_[unit]));
      return Status();
    });
    EXPECT_TRUE(state);
    return state ? *state : LogState{};
  }

  TestFolder folder_;
  std::filesystem::path path_ = folder_ / "shard-1-of-1.log";
  std::map<std::uint32_t, Bytes> payloads_;
  Bytes bytes_;
};

TEST_F(UnitLogTest, GivesBackWhatWasAppended) {
  const LogState state = read(bytes_);
  EXPECT_EQ(state.done, (std::vector<bool>{true, true, true, false}));
  EXPECT_TRUE(state.damage.empty());
}

TEST_F(UnitLogTest, EveryFlippedByteIsNamedAndMended) {
  for (std::size_t i = 0; i < bytes_.size(); ++i) {
    Bytes flipped = bytes_;
    flipped[i] ^= std::byte{0x10};
    const LogState state = read(flipped);
    ASSERT_EQ(state.damage.size(), 1u) << i;
    EXPECT_THAT(state.damage[0], HasSubstr("at byte "));
    EXPECT_LT(std::ranges::count(state.done, true), 3) << i;
    auto log = UnitLog::open(path_, kPlan, kUnits);
    ASSERT_TRUE(log);
    EXPECT_EQ(log->state().done, state.done) << i;
    for (std::uint32_t unit = 0; unit < 3; ++unit)
      if (!state.done[unit]) {
        ASSERT_TRUE(log->append(unit, payloads_[unit]));
      }
    const auto mended = readUnitLog(path_, kPlan, kUnits, {});
    ASSERT_TRUE(mended);
    EXPECT_EQ(mended->done, (std::vector<bool>{true, true, true, false})) << i;
  }
}

TEST_F(UnitLogTest, ATornTailIsDropped) {
  for (std::size_t size = 0; size < bytes_.size(); ++size) {
    const LogState state = read(std::span(bytes_).first(size));
    EXPECT_TRUE(state.damage.empty()) << size;
    EXPECT_LT(std::ranges::count(state.done, true), 3) << size;
    auto log = UnitLog::open(path_, kPlan, kUnits);
    ASSERT_TRUE(log);
    ASSERT_TRUE(log->append(3, payloads_[0]));
    const auto after = readUnitLog(path_, kPlan, kUnits, {});
    ASSERT_TRUE(after);
    EXPECT_TRUE(after->done[3]) << size;
  }
}

TEST_F(UnitLogTest, OfAnotherPlanIsRefused) {
  EXPECT_FALSE(readUnitLog(path_, kPlan + 1, kUnits, {}));
  EXPECT_FALSE(UnitLog::open(path_, kPlan, kUnits + 1));
}

TEST_F(UnitLogTest, OneProcessAtATime) {
  const auto first = UnitLog::open(path_, kPlan, kUnits);
  ASSERT_TRUE(first);
  const auto second = UnitLog::open(path_, kPlan, kUnits);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message, HasSubstr("another process"));
}

}  // namespace
}  // namespace lucerna::bake

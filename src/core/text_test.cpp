#include "core/text.hpp"

#include <gmock/gmock.h>

#include <cstring>
#include <set>

#include "core/hash.hpp"
#include "core/time_text.hpp"

namespace lucerna {
namespace {

using testing::ElementsAre;

TEST(EditDistance, CountsEachKindOfEditOnce) {
  EXPECT_EQ(editDistance("", ""), 0);
  EXPECT_EQ(editDistance("", "abc"), 3);
  EXPECT_EQ(editDistance("abc", ""), 3);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3);
  EXPECT_EQ(editDistance("depth", "detph"), 1) << "a transposition is one edit";
  EXPECT_EQ(editDistance("ca", "abc"), 3) << "optimal string alignment: no edit inside a swap";
  EXPECT_EQ(editDistance("GBuffer", "gbuffer"), 0) << "case does not count";
}

TEST(EditDistance, IsSymmetric) {
  const std::vector<std::string> words{"", "a", "radius", "raduis", "Lighting", "sampels"};
  for (const auto& a : words)
    for (const auto& b : words) EXPECT_EQ(editDistance(a, b), editDistance(b, a)) << a << ' ' << b;
}

TEST(Closest, FindsTyposAndBeginningsAndNothingElse) {
  const std::vector<std::string> names{"GBuffer", "Lighting", "ToneMap", "Transparency"};
  EXPECT_EQ(closest("Gbufer", names), "GBuffer");
  EXPECT_EQ(closest("Lihgting", names), "Lighting");
  EXPECT_EQ(closest("tone", names), "ToneMap");
  EXPECT_EQ(closest("Bloom", names), "");
  EXPECT_EQ(closest("x", names), "");
  EXPECT_EQ(closest("", names), "");
  EXPECT_EQ(didYouMean("TonMap", names), " (did you mean 'ToneMap'?)");
  EXPECT_EQ(didYouMean("Bloom", names), "");
}

TEST(Split, KeepsEmptyPartsAndIsUndoneByJoin) {
  EXPECT_THAT(split("a,b,,c", ','), ElementsAre("a", "b", "", "c"));
  EXPECT_THAT(split("", ','), ElementsAre(""));
  EXPECT_THAT(split("a,", ','), ElementsAre("a", ""));
  EXPECT_EQ(join(split("x.y.z", '.'), "."), "x.y.z");
  EXPECT_EQ(join({}), "");
}

TEST(Hash, DependsOnEveryByteLengthAndSeed) {
  std::set<std::uint64_t> seen;
  std::string text(40, 'x');
  seen.insert(hashText(text));
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = 'y';
    seen.insert(hashText(changed));
  }
  for (std::size_t size = 0; size < 40; ++size) seen.insert(hashText(std::string(size, '\0')));
  seen.insert(hashText(text, 1));
  EXPECT_EQ(seen.size(), 1 + 40 + 40 + 1u);
  EXPECT_NE(hashCombine(1, 2), hashCombine(2, 1));
}

TEST(Hash, SpreadsHighBitsOfTheInput) {
  // Words that differ only in their top bit must not collide after further words follow.
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 256; ++i) {
    const std::uint64_t words[3] = {i << 56, 0, 0};
    seen.insert(hashBytes(std::as_bytes(std::span(words))) & 0xffff'ffff);
  }
  EXPECT_EQ(seen.size(), 256u);
}

TEST(Text, CountsOneAndMany) {
  EXPECT_EQ(counted(1, "map"), "1 map");
  EXPECT_EQ(counted(0, "map"), "0 maps");
  EXPECT_EQ(counted(12, "chart"), "12 charts");
}

TEST(Text, TimesAreAsPeopleSayThem) {
  EXPECT_EQ(secondsText(0.04), "under 0.1 s");
  EXPECT_EQ(secondsText(9.94), "9.9 s");
  EXPECT_EQ(secondsText(4), "4 s");
  EXPECT_EQ(secondsText(9.96), "10 s");
  EXPECT_EQ(secondsText(119.4), "119 s");
  EXPECT_EQ(secondsText(119.6), "2 min");
  EXPECT_EQ(secondsText(185), "3 min 5 s");
  EXPECT_EQ(secondsText(3599.6), "1 h");
  EXPECT_EQ(secondsText(339 * 60 + 50), "5 h 40 min");
  EXPECT_EQ(secondsText(76 * 3600.), "3 d 4 h");
}

TEST(Text, EstimatesSayNoMoreThanTheyKnow) {
  EXPECT_EQ(aboutText(18, 4), "about 18 s, give or take 4 s");
  EXPECT_EQ(aboutText(20400, 3600), "about 5 h 40 min, give or take 1 h");
  EXPECT_EQ(aboutText(18, 18.5), "at most 37 s");
  EXPECT_EQ(aboutText(18, 0.4), "about 18 s");
  EXPECT_EQ(aboutText(0.02, 0), "about 0.1 s");
}

}  // namespace
}  // namespace lucerna

#include "core/json.hpp"

#include <gmock/gmock.h>

#include "core/json_value.hpp"

namespace lucerna {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string faultOf(std::string_view text) {
  const auto result = parseJson(text, "a.json", ErrorKind::Pipeline);
  if (result) return "no fault";
  EXPECT_EQ(result.error().kind, ErrorKind::Pipeline);
  return result.error().message;
}

TEST(Json, KeepsTheOrderTheKindsAndTheLines) {
  const auto parsed = parseJson(
      "// a comment\n{\"z\": 1,\n\"a\": [\n-2.5, true /* and\nanother */, null], "
      "\"t\":\n\"x\\ny\", "
      "\"big\": 18446744073709551615, \"o\": {}}\n",
      "a.json", ErrorKind::Input);
  ASSERT_TRUE(parsed) << parsed.error().message;
  const auto& members = *parsed->root.as<JsonNode::Members>();
  std::vector<std::string> keys;
  std::vector<int> lines;
  for (const JsonMember& member : members) {
    keys.push_back(member.key);
    lines.push_back(member.value.line);
  }
  EXPECT_THAT(keys, ElementsAre("z", "a", "t", "big", "o"));
  EXPECT_THAT(lines, ElementsAre(2, 3, 6, 6, 6));
  EXPECT_EQ(parsed->root.line, 2);
  EXPECT_EQ(*members[0].value.as<std::int64_t>(), 1);
  const auto& list = *members[1].value.as<JsonNode::List>();
  EXPECT_EQ(*list[0].as<double>(), -2.5);
  EXPECT_EQ(list[0].line, 4);
  EXPECT_TRUE(*list[1].as<bool>());
  EXPECT_TRUE(list[2].as<std::nullptr_t>());
  EXPECT_EQ(list[2].line, 5);
  EXPECT_EQ(*parsed->root.find("t")->as<std::string>(), "x\ny");
  EXPECT_EQ(*parsed->root.find("big")->as<double>(), 18446744073709551615.);
  EXPECT_EQ(parsed->root.find("nobody"), nullptr);
}

TEST(Json, SaysInItsOwnWordsWhereATextIsNoJson) {
  EXPECT_EQ(faultOf(""), "a.json: is empty, wanted a JSON object");
  EXPECT_EQ(faultOf(" \n\t"), "a.json: is empty, wanted a JSON object");
  EXPECT_EQ(faultOf("{\n \"a\":\n  oops}"),
            "a.json:3:3: is no JSON: found oops; texts need double quotes");
  EXPECT_EQ(faultOf("{\"a\": 1e999}"),
            "a.json:1:12: found the number 1e999, wanted at most 1.7e308");
  EXPECT_EQ(faultOf("{\"a\": NaN}"),
            "a.json:1:7: found NaN, wanted a finite number; JSON has no others");
  EXPECT_THAT(faultOf("{\"a\": nan}"), HasSubstr("found nan, wanted a finite number"));
  EXPECT_THAT(faultOf("{\"a\": -Infinity}"), HasSubstr("found -Infinity, wanted a finite number"));
  EXPECT_EQ(faultOf("\n{\"a\": \"\xff\"}"),
            "a.json:2:8: found the byte 0xFF, wanted UTF-8; the file is damaged there, or has to "
            "be saved as UTF-8");
  // One that could begin a character.
  EXPECT_THAT(faultOf("\n{\"a\": \"M\xfcll\"}"), StartsWith("a.json:2:9: found the byte 0xFC,"));
  EXPECT_THAT(faultOf("\"ab\xe9"), StartsWith("a.json:1:4: found the byte 0xE9,"));
  EXPECT_THAT(faultOf("\xff\xfe{"), HasSubstr("saved as UTF-8"));
  EXPECT_THAT(faultOf("{\"a\" 1}"), AllOf(StartsWith("a.json:1:7: is no JSON"), HasSubstr("':'")));
  EXPECT_THAT(faultOf("{\"a\": 1,}"), StartsWith("a.json:1:9: is no JSON"));
  EXPECT_THAT(faultOf("{\"a\": 1} x"), StartsWith("a.json:1:10: is no JSON"));
  EXPECT_THAT(faultOf("[1"), AllOf(StartsWith("a.json:1:"), HasSubstr("unexpected end of input")));
  EXPECT_THAT(faultOf("\"unfinished\\"), StartsWith("a.json:1:"));
}

TEST(Json, DepthAndSizeAreLimited) {
  EXPECT_THAT(faultOf("\n" + std::string(1'000'000, '[')),
              StartsWith("a.json:2:65: found more than 64 lists and objects inside one another"));
  const std::string deepest(kMaxJsonDepth, '[');
  EXPECT_TRUE(parseJson(deepest + std::string(kMaxJsonDepth, ']'), "a", ErrorKind::Input));
  std::string many = "[0";
  for (std::size_t i = 0; i < kMaxJsonValues; ++i) many += ",0";
  EXPECT_THAT(faultOf(many + "]"), HasSubstr("found more than 1000000 values"));
}

// What a reader of {"size", "kind", "inner"} says.
std::string faultsOf(const std::string& text) {
  auto document = JsonDocument::parse(text, "a.json", ErrorKind::Input);
  if (!document) return document.error().message;
  const JsonValue root = document->root();
  if (root.object({"lucerna", "size", "kind", "names", "count", "inner"})) {
    float size = 0;
    int kind = 0, count = 0;
    std::string name;
    root.read("size", size, {0.f, 10.f, "m"});
    root.readChoice("kind", {"round", "square"}, kind);
    root.readInteger("count", count, 1, 9);
    if (root.has("names"))
      for (const JsonValue& entry : root.at("names").elements()) entry.text(name);
    if (root.has("inner")) root.at("inner").placedAt("a.js:7").require({"a~/b"});
  }
  const Status status = document->status();
  return status ? "" : status.error().message;
}

TEST(JsonValue, TellsEveryFaultWithItsPlace) {
  EXPECT_EQ(faultsOf("{\"size\": 3, \"kind\": \"round\", \"count\": 9, \"names\": []}"), "");
  EXPECT_EQ(faultsOf("{\n\"size\": -1,\n\"knid\": 1, \"kind\": \"rund\",\n\"names\":\n[\"a\", 3]}"),
            "a.json:3: /knid: found the unknown key 'knid' (did you mean 'kind'?), wanted one of "
            "lucerna, size, kind, names, count, inner\n"
            "a.json:2: /size: found -1, wanted a number from 0 to 10 m\n"
            "a.json:3: /kind: found \"rund\", wanted one of round, square (did you mean 'round'?)\n"
            "a.json:5: /names/1: found 3, wanted a text");
  EXPECT_EQ(faultsOf("[]"), "a.json:1: /: found [], wanted an object");
  EXPECT_THAT(faultsOf("{\"count\": 1.5}"),
              HasSubstr("found 1.5, wanted a whole number from 1 to 9"));
  EXPECT_EQ(faultsOf("{\"size\": 1e200}"),
            "a.json:1: /size: found 1e+200, wanted a number from 0 to 10");
  EXPECT_EQ(faultsOf("{\"inner\": {}}"), "a.js:7: /inner: 'a~/b' is missing");
}

TEST(JsonValue, AKeyThatStandsTwiceIsAFault) {
  EXPECT_EQ(faultsOf("{\"size\": 1,\n\"names\": [\"a\"], \"size\":\n2}"),
            "a.json:3: the key \"size\" stands twice in its object; remove one");
}

TEST(JsonValue, LongValuesAndManyFaultsAreCutShort) {
  const std::string faults =
      faultsOf("{\"names\": [[" + std::string(100'000, ' ') + "\"" + std::string(100'000, 'a') +
               "\"], " + "1,1,1,1,1,1,1,1,1,1]}");
  EXPECT_LT(faults.size(), 1000u);
  EXPECT_THAT(faults, HasSubstr("found [\"aaa"));
  std::string many = "{\"names\": [0";
  for (int i = 1; i < 250; ++i) many += ",\n0";
  EXPECT_THAT(faultsOf(many + "]}"),
              AllOf(HasSubstr("a.json:100: /names/99: found 0"),
                    HasSubstr("a.json: 150 more faults"), testing::Not(HasSubstr("/names/100:"))));
}

}  // namespace
}  // namespace lucerna

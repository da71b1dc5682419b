#include "core/html.hpp"

#include <gmock/gmock.h>

namespace lucerna {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string base64Of(std::string_view text) {
  return base64(std::as_bytes(std::span(text)));
}

TEST(Html, EscapesWhatWouldEndTextOrAttributes) {
  EXPECT_EQ(escapedXml("a<b>&\"c'\n\x01 d"), "a&lt;b&gt;&amp;&quot;c&#39; d");
  EXPECT_EQ(escapedXml("Žluťoučký"), "Žluťoučký");
}

// The examples of RFC 4648, section 10, and the last two digits of the alphabet.
TEST(Html, Base64) {
  EXPECT_EQ(base64Of(""), "");
  EXPECT_EQ(base64Of("f"), "Zg==");
  EXPECT_EQ(base64Of("fo"), "Zm8=");
  EXPECT_EQ(base64Of("foo"), "Zm9v");
  EXPECT_EQ(base64Of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64Of("\xfb\xff\xbf"), "+/+/");
  EXPECT_EQ(dataUri("image/png", std::as_bytes(std::span("foo", 3))), "data:image/png;base64,Zm9v");
}

TEST(Html, APageHoldsItsPartsAndNoEmptyScript) {
  const std::string page = htmlText({.title = "a < b", .style = "p{}", .body = "<p>text</p>\n"});
  EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(page, HasSubstr("<title>a &lt; b</title>"));
  EXPECT_THAT(page, HasSubstr("p{}</style>"));
  EXPECT_THAT(page, EndsWith("<p>text</p>\n</body>\n</html>\n"));
  EXPECT_THAT(page, Not(HasSubstr("script")));
  EXPECT_THAT(htmlText({.script = "f();"}), HasSubstr("<script>f();</script>\n</body>"));
}

}  // namespace
}  // namespace lucerna

#include "core/markdown.hpp"

#include <gmock/gmock.h>

namespace lucerna {
namespace {

TEST(Markdown, ShowsTextAsItIs) {
  EXPECT_EQ(escapedMarkdown("a|b_c\n<d>"), "a\\|b\\_c\\<d\\>");
}

TEST(Markdown, ATableHasItsHeadARuleAndItsRows) {
  const std::vector<std::vector<std::string>> rows{{"Ao|2", "1.5"}, {"Cull", "0.1"}};
  EXPECT_EQ(markdownTable({"pass", "ms"}, rows),
            "| pass | ms |\n|---|--:|\n| Ao\\|2 | 1.5 |\n| Cull | 0.1 |\n");
}

}  // namespace
}  // namespace lucerna

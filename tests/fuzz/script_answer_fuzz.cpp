#include "fuzz/fuzz.hpp"
#include "script/script_answer.hpp"

namespace lucerna::fuzz {

void scriptAnswer(ByteView bytes) {
  const script::ScriptInput input{.params = {{"count", "4"}}, .seed = 0};
  const auto pipeline = script::pipelineFromAnswer(textOf(bytes), "fuzz.js", input);
  if (!pipeline) {
    // The script's own words may be anything, also none.
    CHECK(pipeline.error().kind == ErrorKind::Pipeline ||
          pipeline.error().kind == ErrorKind::Usage);
    return;
  }
  CHECK(!pipeline->name.empty());
  for (const graph::PassRow& row : pipeline->passes) {
    CHECK(row.place.starts_with("fuzz.js:"), "'{}'", row.place);
    CHECK(!row.name.empty());
  }
}

}  // namespace lucerna::fuzz

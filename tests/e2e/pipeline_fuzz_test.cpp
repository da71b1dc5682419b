// A pipeline is really data: random orders, duplicates, disabled rows and parameter values of the
// shipped passes either are refused with a reason or draw a clean picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "graph/validate.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{48, 27};

std::uint32_t below(Random& random, std::size_t count) {
  return random.below(static_cast<std::uint32_t>(count));
}

graph::Value randomValue(Random& random, const graph::ParamDescription& param) {
  using Type = graph::ParamType;
  const double low = param.min.value_or(0), high = param.max.value_or(1);
  switch (param.type) {
    case Type::Bool:
      return random.below(2) == 1;
    case Type::Choice:
      return param.choices[below(random, param.choices.size())];
    case Type::Int:
      return static_cast<std::int64_t>(low) +
             static_cast<std::int64_t>(below(random, static_cast<std::size_t>(high - low) + 1));
    case Type::Float:
      return low + (high - low) * random.uniform();
    case Type::Color:
    case Type::Vector:
      return std::vector<double>(param.size, low + (high - low) * random.uniform());
    case Type::Text:
    case Type::File:
      break;
  }
  return param.defaultValue;
}

void giveNames(graph::Pipeline& pipeline) {
  auto& rows = pipeline.passes;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].name = rows[i].type + std::to_string(i + 1);
    rows[i].place = "row " + std::to_string(i + 1);
  }
}

// The deferred or forward rows, with rows of any type added, swapped, doubled and disabled.
graph::Pipeline randomPipeline(Random& random) {
  graph::Pipeline pipeline =
      testing::rows(random.below(2) == 0 ? testing::kDeferredRows : testing::kForwardRows);
  const std::vector<std::string> types = testing::registry().typeNames();
  auto& rows = pipeline.passes;
  for (std::uint32_t i = random.below(4); i > 0; --i) {
    graph::PassRow row;
    row.type = types[below(random, types.size())];
    rows.insert(rows.begin() + below(random, rows.size() + 1), row);
  }
  if (random.below(3) == 0)
    std::swap(rows[below(random, rows.size())], rows[below(random, rows.size())]);
  if (random.below(3) == 0) rows[below(random, rows.size())].enabled = false;
  giveNames(pipeline);
  for (graph::PassRow& row : rows) {
    const graph::PassDescription description = testing::registry().find(row.type)->describe({});
    for (const graph::ParamDescription& param : description.params)
      if (random.below(2) == 0) row.params[param.name] = randomValue(random, param);
  }
  return pipeline;
}

// Rows that are valid by what the passes' pages say, whatever the validator thinks: a producer of
// radiance, then any number of passes that add to it, doubled or disabled at will, then one tone
// map or none, then what draws over either.
graph::Pipeline validPipeline(Random& random) {
  graph::Pipeline pipeline;
  const auto add = [&](const std::string& type, bool mayBeDisabled) {
    graph::PassRow row;
    row.type = type;
    row.enabled = !mayBeDisabled || random.below(4) > 0;
    pipeline.passes.push_back(row);
  };
  const auto addOneOrTwo = [&](const std::string& type) {
    if (random.below(2) == 0) add(type, true);
    add(type, false);
  };
  const auto addSome = [&](const std::vector<std::string>& types) {
    for (std::uint32_t i = random.below(4); i > 0; --i)
      add(types[below(random, types.size())], true);
  };
  addOneOrTwo("Cull");
  if (random.below(2) == 0) {
    addOneOrTwo("GBuffer");
    addOneOrTwo("TiledLighting");
  } else {
    addOneOrTwo("Forward");
  }
  addSome({"Background", "Transparency", "ShowBvh", "Cull"});
  if (random.below(4) > 0) add("ToneMap", false);
  addSome({"ShowBvh", "Cull"});
  giveNames(pipeline);
  return pipeline;
}

std::string listing(const graph::Pipeline& pipeline) {
  std::string text;
  for (const graph::PassRow& row : pipeline.passes) text += (row.enabled ? " " : " -") + row.name;
  return text;
}

bool allFinite(const Image& image) {
  const Image values = converted(image, ComponentType::F32, 4);
  return std::ranges::all_of(values.as<float>(), [](float v) { return std::isfinite(v); });
}

TEST(PipelineFuzz, RandomRowsDrawCleanlyOrAreRefusedWithAReason) {
  const scene::Scene scene = testing::sampleScene();
  testing::SceneRenderer renderer(scene);
  Random random(20260);
  int drawn = 0, refused = 0;
  for (int round = 0; round < 400; ++round) {
    const graph::Pipeline pipeline = randomPipeline(random);
    SCOPED_TRACE("round " + std::to_string(round) + ":" + listing(pipeline));
    const graph::Validation validation =
        graph::validate(pipeline, testing::registry(), testing::device().capabilities());
    auto output = renderer.render(pipeline, kSize, testing::radianceNames(pipeline));
    ASSERT_EQ(static_cast<bool>(output), validation.ok()) << validation.text();
    if (output) {
      ++drawn;
      EXPECT_FALSE(output->picture.empty());
      EXPECT_TRUE(allFinite(output->picture));
      for (const auto& [name, radiance] : output->kept) EXPECT_TRUE(allFinite(radiance)) << name;
    } else {
      ++refused;
      EXPECT_GT(output.error().message.size(), 20u);
    }
    testing::expectNoDebugMessages();
    if (HasFailure()) break;
  }
  std::printf("pipeline fuzz: %d drawn, %d refused\n", drawn, refused);
  EXPECT_GE(drawn, 100);
  EXPECT_GE(refused, 20);
}

TEST(PipelineFuzz, ValidRowsInAnyOrderAreNeverRefused) {
  const scene::Scene scene = testing::sampleScene();
  testing::SceneRenderer renderer(scene);
  Random random(7);
  for (int round = 0; round < 200; ++round) {
    const graph::Pipeline pipeline = validPipeline(random);
    SCOPED_TRACE("round " + std::to_string(round) + ":" + listing(pipeline));
    auto output = renderer.render(pipeline, kSize, testing::radianceNames(pipeline));
    ASSERT_TRUE(output) << output.error().message;
    EXPECT_TRUE(allFinite(output->picture));
    testing::expectNoDebugMessages();
    if (HasFailure()) break;
  }
}

// A pass that replaces what it makes may stand twice: the second does it all again.
TEST(PipelineFuzz, DoublingARowThatOnlyReplacesChangesNoPixel) {
  const scene::Scene scene = testing::sampleScene();
  testing::SceneRenderer renderer(scene);
  for (const auto& types : {testing::kDeferredRows, testing::kForwardRows}) {
    auto expected = renderer.render(testing::rows(types), {160, 90});
    ASSERT_TRUE(expected) << expected.error().message;
    for (std::size_t i = 0; i < types.size(); ++i) {
      if (types[i] == "Transparency" || types[i] == "ToneMap")
        continue;  // these build on the input
      graph::Pipeline doubled = testing::rows(types);
      graph::PassRow copy = doubled.passes[i];
      copy.name += "Again";
      doubled.passes.insert(doubled.passes.begin() + static_cast<std::ptrdiff_t>(i) + 1, copy);
      auto output = renderer.render(doubled, {160, 90});
      ASSERT_TRUE(output) << output.error().message;
      EXPECT_TRUE(std::ranges::equal(output->picture.bytes(), expected->picture.bytes()))
          << "doubled " << types[i];
    }
  }
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna

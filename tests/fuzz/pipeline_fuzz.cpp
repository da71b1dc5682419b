#include <nlohmann/json.hpp>

#include "fuzz/fuzz.hpp"
#include "graph/schedule.hpp"
#include "passes/register_passes.hpp"

namespace lucerna::fuzz {
namespace {

using namespace graph;

const Registry& registry() {
  static const Registry* const kRegistry = [] {
    auto* made = new Registry;
    passes::registerPasses(*made);
    return made;
  }();
  return *kRegistry;
}

// Reading what was written gives the same again, and no fault of form.
void checkRoundTrip(const Pipeline& read) {
  const std::string written = toJson(read);
  const auto again = pipelineFromJson(written, "again.json");
  CHECK(again, "{}\n{}", again.error().message, written);
  CHECK(!read.formFaults.empty() || again->formFaults.empty(), "{}\n{}",
        again->formFaults.front().text(), written);
  CHECK(toJson(*again) == written, "{}\nbecame\n{}", written, toJson(*again));
}

// Values that live at the same time have textures of their own.
void checkLifetimes(const Schedule& schedule) {
  const std::size_t end = schedule.steps.size();
  for (const Version& version : schedule.versions) {
    const std::size_t homes =
        version.type.texture ? schedule.textures.size() : schedule.data.size();
    CHECK(version.physical < homes, "{} is nowhere", version.name);
    CHECK(version.firstStep <= version.lastStep && version.lastStep <= end,
          "{} lives from {} to {}", version.name, version.firstStep, version.lastStep);
  }
  for (const PhysicalTexture& texture : schedule.textures) {
    std::size_t free = 0;
    for (const std::size_t index : texture.versions) {
      const Version& version = schedule.versions.at(index);
      CHECK(version.firstStep >= free, "{} is overwritten", version.name);
      free = version.lastStep;
      CHECK(version.texture.width > 0 && version.texture.height > 0, "{} has no size",
            version.name);
    }
  }
  for (const Step& step : schedule.steps)
    for (const std::size_t version : step.versions)
      CHECK(version == kNoVersion || version < schedule.versions.size());
  CHECK(schedule.output < schedule.versions.size());
}

void checkPrints(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule) {
  CHECK(!printWiring(pipeline, plan, schedule).empty());
  CHECK(toDot(pipeline, plan, schedule).starts_with("digraph"));
  CHECK(toSvg(pipeline, plan, schedule).starts_with("<svg"));
  CHECK(nlohmann::json::accept(wiringJson(pipeline, plan, schedule)));
}

}  // namespace

void pipeline(ByteView bytes) {
  const auto read = pipelineFromJson(std::string(textOf(bytes)), "fuzz.json");
  if (!read) return checkRefusal(read.error(), ErrorKind::Pipeline, "fuzz.json");
  checkRoundTrip(*read);
  const Validation validation = validate(*read, registry(), gpu::Capabilities::baseline());
  for (const Fault& fault : validation.faults)
    CHECK(fault.text().size() > 20, "'{}'", fault.text());
  CHECK(validation.ok() || !validation.faults.empty());
  if (!validation.ok()) return;
  for (const uvec2 size : {uvec2(1, 1), uvec2(320, 180), uvec2(16384, 3)}) {
    const Schedule schedule = makeSchedule(*validation.plan, size);
    checkLifetimes(schedule);
    checkPrints(*read, *validation.plan, schedule);
  }
}

}  // namespace lucerna::fuzz

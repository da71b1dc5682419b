// The resolved wiring as text, JSON and DOT.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "graph/print_parts.hpp"

namespace lucerna::graph {
namespace {

using ordered = nlohmann::ordered_json;

std::string lifetimeText(const Schedule& schedule, const Version& version) {
  if (version.lastStep >= schedule.steps.size())
    return fmt::format("step {} to the end", version.firstStep + 1);
  if (version.firstStep == version.lastStep) return fmt::format("step {}", version.firstStep + 1);
  return fmt::format("steps {} to {}", version.firstStep + 1, version.lastStep + 1);
}

void printPorts(std::string& text, const Plan& plan, const Schedule& schedule, const Step& step) {
  const ResolvedRow& row = plan.rows[step.row];
  for (std::size_t p = 0; p < row.description.ports.size(); ++p) {
    const PortDescription& port = row.description.ports[p];
    if (port.direction != Direction::Out)
      text += fmt::format("      <- {:<18} {}{}\n", port.name,
                          sourceText(plan, row.input(port.name)->source),
                          port.history ? ", last frame's" : "");
    if (port.direction != Direction::In)
      text += fmt::format("      -> {:<18} {}\n", port.name,
                          step.versions[p] == kNoVersion
                              ? "not made: nobody reads it"
                              : holderText(schedule, schedule.versions[step.versions[p]]));
  }
}

ordered sourceJson(const Plan& plan, const Source& source) {
  switch (source.kind) {
    case Source::Kind::Unbound:
      return nullptr;
    case Source::Kind::Resource:
      return {{"resource", source.port}};
    case Source::Kind::Output:
      return {{"output", plan.rowNames[source.row] + "." + source.port}};
    case Source::Kind::Fill:
      return {{"standIn", plan.rowNames[source.row] + "." + source.port},
              {"fill", {source.fill.x, source.fill.y, source.fill.z, source.fill.w}}};
  }
  return nullptr;
}

ordered versionJson(const Schedule& schedule, const Version& version) {
  ordered object{{"name", version.name}, {"type", version.type.text()}};
  if (version.type.texture) {
    object["size"] = {version.texture.width, version.texture.height};
    object["format"] = gpu::info(version.texture.format).name;
    object["bytes"] = version.texture.bytes();
    object["texture"] = version.physical;
  } else {
    object["data"] = version.physical;
  }
  object["firstStep"] = version.firstStep;
  object["lastStep"] = version.lastStep;
  object["survivesFrame"] = version.lastStep >= schedule.steps.size();
  if (version.history) object["history"] = true;
  return object;
}

std::string dotText(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

}  // namespace

std::string sourceText(const Plan& plan, const Source& source) {
  switch (source.kind) {
    case Source::Kind::Unbound:
      return "nothing";
    case Source::Kind::Resource:
      return fmt::format("the resource '{}'", source.port);
    case Source::Kind::Output:
      return fmt::format("{}.{}", plan.rowNames[source.row], source.port);
    case Source::Kind::Fill:
      return fmt::format("({}, {}, {}, {}), for {}.{} is disabled", source.fill.x, source.fill.y,
                         source.fill.z, source.fill.w, plan.rowNames[source.row], source.port);
  }
  return "";
}

std::string holderText(const Schedule& schedule, const Version& version) {
  if (!version.type.texture)
    return fmt::format("{}, object {}", version.type.text(), version.physical);
  return fmt::format("{} {} x {}, texture {}, {}", gpu::info(version.texture.format).name,
                     version.texture.width, version.texture.height, version.physical,
                     lifetimeText(schedule, version));
}

std::string printWiring(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule) {
  std::string text =
      fmt::format("pipeline '{}' {} x {}, output {}\n", pipeline.name, schedule.outputSize.x,
                  schedule.outputSize.y, sourceText(plan, plan.output));
  for (std::size_t s = 0; s < schedule.steps.size(); ++s) {
    const Step& step = schedule.steps[s];
    if (step.kind == Step::Kind::Pass) {
      const PassDescription& description = plan.rows[step.row].description;
      text +=
          fmt::format("{:4}  {}{}  {}\n", s + 1, step.name,
                      step.name == description.type ? "" : fmt::format(" ({})", description.type),
                      nameOf(step.frequency));
      printPorts(text, plan, schedule, step);
    } else {
      text += fmt::format("{:4}  {}\n      -> {}\n", s + 1, step.name,
                          holderText(schedule, schedule.versions[step.to]));
    }
  }
  for (const PassRow& row : pipeline.passes)
    if (!row.enabled) text += fmt::format("   -  {} is disabled\n", row.name);
  for (const ResolvedRow& row : plan.rows)
    if (row.culled) text += fmt::format("   -  {} is left out: nothing reads it\n", row.name);
  const double saved = schedule.bytesWithoutReuse() == 0
                           ? 0
                           : 100.0 * (1 - static_cast<double>(schedule.bytes()) /
                                              static_cast<double>(schedule.bytesWithoutReuse()));
  text += fmt::format("{} textures, {:.1f} MiB; without reuse {:.1f} MiB (saved: {:.0f} %)\n",
                      schedule.textures.size(), mebibytes(schedule.bytes()),
                      mebibytes(schedule.bytesWithoutReuse()), saved);
  return text;
}

std::string toDot(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule) {
  std::string text =
      fmt::format("digraph {} {{\n  rankdir=TB;\n  node [shape=box, fontname=\"sans-serif\"];\n",
                  dotText(pipeline.name));
  for (const Step& step : schedule.steps)
    if (step.kind == Step::Kind::Pass)
      text += fmt::format("  {};\n", dotText(step.name));
    else
      text += fmt::format("  {} [style=dashed];\n", dotText(step.name));
  for (const Wire& wire : wiresOf(plan, schedule))
    text += fmt::format(
        "  {} -> {} [label={}{}];\n",
        wire.from == kNoVersion ? dotText(wire.resource) : dotText(schedule.steps[wire.from].name),
        wire.to >= schedule.steps.size() ? dotText("output")
                                         : dotText(schedule.steps[wire.to].name),
        dotText(wire.label), wire.history ? ", style=dotted" : "");
  for (std::size_t t = 0; t < schedule.textures.size(); ++t) {
    std::string lines = fmt::format("texture {}: {}", t, textureText(schedule.textures[t]));
    for (const std::size_t v : schedule.textures[t].versions)
      lines += fmt::format("; {} ({})", schedule.versions[v].name,
                           lifetimeText(schedule, schedule.versions[v]));
    text += fmt::format("  // {}\n", lines);
  }
  return text + "}\n";
}

std::string wiringJson(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule) {
  ordered root{{"name", pipeline.name},
               {"size", {schedule.outputSize.x, schedule.outputSize.y}},
               {"output", sourceJson(plan, plan.output)},
               {"rows", ordered::array()},
               {"steps", ordered::array()},
               {"versions", ordered::array()},
               {"textures", ordered::array()}};
  for (const ResolvedRow& row : plan.rows) {
    ordered object{{"name", row.name},
                   {"type", row.description.type},
                   {"runs", nameOf(row.description.frequency)},
                   {"culled", row.culled},
                   {"reads", ordered::object()}};
    for (const ResolvedInput& input : row.inputs)
      object["reads"][input.port] = sourceJson(plan, input.source);
    root["rows"].push_back(std::move(object));
  }
  for (const Step& step : schedule.steps) {
    const char* kind = step.kind == Step::Kind::Pass   ? "pass"
                       : step.kind == Step::Kind::Copy ? "copy"
                                                       : "fill";
    root["steps"].push_back(ordered{{"name", step.name}, {"kind", kind}});
  }
  for (const Version& version : schedule.versions)
    root["versions"].push_back(versionJson(schedule, version));
  for (const PhysicalTexture& texture : schedule.textures)
    root["textures"].push_back(ordered{{"format", gpu::info(texture.desc.format).name},
                                       {"size", {texture.desc.width, texture.desc.height}},
                                       {"bytes", texture.desc.bytes() * (texture.history ? 2 : 1)},
                                       {"keepsContent", texture.keepsContent},
                                       {"versions", texture.versions}});
  root["bytes"] = schedule.bytes();
  root["bytesWithoutReuse"] = schedule.bytesWithoutReuse();
  return root.dump(2, ' ', false, ordered::error_handler_t::replace);
}

std::vector<Wire> wiresOf(const Plan& plan, const Schedule& schedule) {
  std::vector<Wire> wires;
  const auto from = [&](std::size_t version) { return schedule.versions[version].firstStep; };
  for (std::size_t s = 0; s < schedule.steps.size(); ++s) {
    const Step& step = schedule.steps[s];
    if (step.kind == Step::Kind::Copy)
      wires.push_back({.from = writerOf(plan, schedule, step.from),
                       .to = s,
                       .version = step.from,
                       .label = "copy"});
    if (step.kind != Step::Kind::Pass) continue;
    const ResolvedRow& row = plan.rows[step.row];
    for (std::size_t p = 0; p < row.description.ports.size(); ++p) {
      const PortDescription& port = row.description.ports[p];
      if (port.direction == Direction::Out) continue;
      const Source& source = row.input(port.name)->source;
      Wire wire{.to = s, .label = port.name, .history = port.history};
      if (source.kind == Source::Kind::Unbound) continue;
      if (source.kind == Source::Kind::Resource) {
        wire.resource = source.port;
      } else if (port.direction == Direction::InOut && from(step.versions[p]) < s) {
        wire.from = from(step.versions[p]);  // the copy before it
        wire.version = step.versions[p];
      } else {
        wire.version = versionOf(plan, schedule, source);
        wire.from = writerOf(plan, schedule, wire.version);
      }
      wires.push_back(std::move(wire));
    }
  }
  if (schedule.output != kNoVersion)
    wires.push_back({.from = writerOf(plan, schedule, schedule.output),
                     .to = schedule.steps.size(),
                     .version = schedule.output,
                     .label = plan.output.port});
  return wires;
}

std::size_t versionOf(const Plan& plan, const Schedule& schedule, const Source& source) {
  const std::string name = plan.rowNames[source.row] + "." + source.port;
  for (std::size_t v = 0; v < schedule.versions.size(); ++v)
    if (schedule.versions[v].name == name) return v;
  return kNoVersion;
}

std::size_t writerOf(const Plan& plan, const Schedule& schedule, std::size_t version) {
  for (std::size_t s = 0; s < schedule.steps.size(); ++s) {
    const Step& step = schedule.steps[s];
    if (step.kind == Step::Kind::Fill && step.to == version) return s;
    for (std::size_t p = 0; p < step.versions.size(); ++p)
      if (step.versions[p] == version &&
          plan.rows[step.row].description.ports[p].direction != Direction::In)
        return s;
  }
  return kNoVersion;
}

std::string textureText(const PhysicalTexture& texture) {
  return fmt::format("{} {} x {}{}{}", gpu::info(texture.desc.format).name, texture.desc.width,
                     texture.desc.height,
                     texture.desc.layers > 1 ? fmt::format(" x {}", texture.desc.layers) : "",
                     texture.history ? ", two for history" : "");
}

double mebibytes(std::uint64_t bytes) {
  return static_cast<double>(bytes) / (1 << 20);
}

}  // namespace lucerna::graph

#include "graph/executor.hpp"

#include <algorithm>
#include <chrono>

#include "core/log.hpp"
#include "core/text.hpp"
#include "graph/storage.hpp"
#include "graph/value_check.hpp"

namespace lucerna::graph {
namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

gpu::Counters operator-(const gpu::Counters& a, const gpu::Counters& b) {
  return {.draws = a.draws - b.draws,
          .dispatches = a.dispatches - b.dispatches,
          .primitives = a.primitives - b.primitives,
          .uploads = a.uploads - b.uploads,
          .targetSwitches = a.targetSwitches - b.targetSwitches};
}
gpu::Counters operator+(const gpu::Counters& a, const gpu::Counters& b) {
  return {.draws = a.draws + b.draws,
          .dispatches = a.dispatches + b.dispatches,
          .primitives = a.primitives + b.primitives,
          .uploads = a.uploads + b.uploads,
          .targetSwitches = a.targetSwitches + b.targetSwitches};
}

// A pass at work for one row.
struct Row {
  std::string name, type;
  ParamValues params;
  std::unique_ptr<PassInstance> instance;
};

// A resource that the pipeline reads, found anew in every frame (or view).
struct UsedResource {
  std::string name;
  std::type_index type = typeid(void);
  bool perView = false;
  void* data = nullptr;
};

// A port whose pointer changes from frame to frame or from view to view.
struct MovingPort {
  enum class Kind { Resource, Current, Previous } kind;
  std::size_t port;   // in the description's order
  std::size_t index;  // Resource: in resources; else: the version
};

struct RunStep {
  PassInstance* instance = nullptr;           // of a Pass
  std::vector<std::vector<BoundPort>> ports;  // per view
  std::vector<MovingPort> moving;
  std::uint64_t textureBytes = 0;
};

}  // namespace

void* Imports::find(std::string_view name, std::type_index type) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return nullptr;
  CHECK(found->second.type == type, "the resource '{}' was given as another type", name);
  return found->second.data;
}

struct Executor::Impl {
  Impl(gpu::Device& d, const Registry& r) : device(d), registry(r), storage(d) {}

  Status setPipeline(const Pipeline& next, uvec2 size, const std::vector<std::string>& keptNames);
  Status checkSizes() const;
  void makeInstances();
  void makeSteps();
  void bindStep(const Step& step, RunStep& run);
  void bindPorts();
  BoundPort bind(const PortDescription& port, std::size_t version, std::size_t view, bool previous);
  std::size_t useResource(const std::string& name);
  void findResources(const Imports& imports, bool perView);
  Status execute(const FrameInput& input, const OnView& onView);
  Status runViews(const FrameInput& input, PassContext& context, const OnView& onView);
  void runStep(std::size_t index, PassContext& context);
  void runPass(RunStep& run, PassContext& context);
  void runFill(const Step& step);
  void finishProfile();
  Status takeErrors();
  const gpu::Texture* textureOf(std::size_t version, std::size_t view);
  const void* dataOf(std::size_t version, std::size_t view, std::type_index type);
  std::size_t keptVersion(std::string_view name) const;  // kNoVersion: there is none

  gpu::Device& device;
  const Registry& registry;
  Storage storage;
  Pipeline pipeline;
  std::vector<std::string> keptNames;
  uvec2 outputSize{0};
  Plan plan;
  Schedule schedule;
  std::vector<Row> rows;  // of the passes that run
  std::vector<RunStep> steps;
  std::size_t firstPerView = 0;
  std::vector<UsedResource> resources;
  bool ready = false;
  bool rebuilt = false;  // per-scene steps must run again
  std::size_t currentView = 0;
  bool profiling = false;
  FrameProfile profile;
  std::vector<std::filesystem::path> written;  // in the last frame
  std::vector<std::string> warnings;           // of the pipeline
};

Status Executor::Impl::setPipeline(const Pipeline& next, uvec2 size,
                                   const std::vector<std::string>& kept) {
  ready = false;
  plan = {};
  schedule = {};
  steps.clear();
  Validation validation = validate(next, registry, device.capabilities(), kept);
  if (!validation.ok()) return Error{ErrorKind::Pipeline, validation.text()};
  std::vector<std::string> found;
  for (const Fault& fault : validation.faults) found.push_back(fault.text());
  if (found != warnings)
    for (const std::string& warning : found) log::warning("{}", warning);
  warnings = std::move(found);
  pipeline = next;
  keptNames = kept;
  outputSize = size;
  plan = std::move(*validation.plan);
  schedule = makeSchedule(plan, size);
  Status status = checkSizes();
  if (status) {
    makeInstances();
    storage.prepare(schedule);
    makeSteps();
    status = takeErrors();
    if (!status) rows.clear();  // a kept instance would not ask for its broken program again
  }
  if (!status) {
    plan = {};
    schedule = {};
    steps.clear();
    return status;
  }
  ready = rebuilt = true;
  return {};
}

Status Executor::Impl::checkSizes() const {
  const int limit = device.capabilities().maxTextureSide;
  for (const Version& version : schedule.versions) {
    const gpu::TextureDesc& desc = version.texture;
    if (version.type.texture && (desc.width > limit || desc.height > limit))
      return error(ErrorKind::Pipeline,
                   "'{}' would be {} x {} pixels; {} has at most {}; render smaller, or in tiles",
                   version.name, desc.width, desc.height, device.capabilities().name, limit);
  }
  return {};
}

void Executor::Impl::makeInstances() {
  std::vector<Row> old = std::exchange(rows, {});
  for (const ResolvedRow& resolved : plan.rows) {
    const PassRow& wanted = pipeline.passes[resolved.row];
    Row row{.name = wanted.name, .type = wanted.type, .params = wanted.params, .instance = nullptr};
    if (resolved.culled) {
      rows.push_back(std::move(row));
      continue;
    }
    for (Row& known : old)
      if (known.instance && known.name == row.name && known.type == row.type) {
        row.instance = std::move(known.instance);
        break;
      }
    if (!row.instance) row.instance = registry.find(row.type)->create(device);
    row.instance->setParams(row.params);
    rows.push_back(std::move(row));
  }
}

void Executor::Impl::makeSteps() {
  resources.clear();
  firstPerView = schedule.steps.size();
  steps.resize(schedule.steps.size());
  for (std::size_t s = steps.size(); s-- > 0;)
    if (schedule.steps[s].frequency == Frequency::PerView) firstPerView = s;
  bindPorts();
}

void Executor::Impl::bindPorts() {
  for (std::size_t s = 0; s < steps.size(); ++s) {
    steps[s] = {};
    bindStep(schedule.steps[s], steps[s]);
  }
}

void Executor::Impl::bindStep(const Step& step, RunStep& run) {
  if (step.kind != Step::Kind::Pass) {
    run.textureBytes = schedule.versions[step.to].texture.bytes();
    return;
  }
  const ResolvedRow& row = plan.rows[step.row];
  run.instance = rows[step.row].instance.get();
  const auto& ports = row.description.ports;
  for (std::size_t p = 0; p < ports.size(); ++p) {
    const std::size_t version = step.versions[p];
    const ResolvedInput* input =
        ports[p].direction == Direction::Out ? nullptr : row.input(ports[p].name);
    if (input && input->source.kind == Source::Kind::Resource) {
      run.moving.push_back({MovingPort::Kind::Resource, p, useResource(input->source.port)});
    } else if (version != kNoVersion) {
      const Version& v = schedule.versions[version];
      if (ports[p].history && v.history)
        run.moving.push_back({MovingPort::Kind::Previous, p, version});
      else if (v.type.texture ? schedule.textures[v.physical].history
                              : schedule.data[v.physical].history)
        run.moving.push_back({MovingPort::Kind::Current, p, version});
      if (ports[p].direction != Direction::In && v.type.texture)
        run.textureBytes += v.texture.bytes();
    }
  }
  const bool perView = step.frequency == Frequency::PerView;
  run.ports.resize(perView ? storage.viewCount() : 1);
  for (std::size_t view = 0; view < run.ports.size(); ++view)
    for (std::size_t p = 0; p < ports.size(); ++p) {
      BoundPort& port = run.ports[view].emplace_back(bind(ports[p], step.versions[p], view, false));
      port.isNew = ports[p].makes() && !row.updates(ports[p]);
    }
}

BoundPort Executor::Impl::bind(const PortDescription& port, std::size_t version, std::size_t view,
                               bool previous) {
  BoundPort bound{.port = &port};
  if (version == kNoVersion) return bound;
  const Version& v = schedule.versions[version];
  const auto pick = [&](auto& slot) { return previous ? slot.previous : slot.current; };
  if (v.type.texture) {
    auto& slot = storage.texture(v.physical).of(view);
    if (!previous || slot.valid) bound.texture = &slot.items[pick(slot)];
  } else {
    auto& slot = storage.data(v.physical).of(view);
    if (!previous || slot.valid) bound.data = slot.items[pick(slot)].get();
  }
  return bound;
}

std::size_t Executor::Impl::useResource(const std::string& name) {
  for (std::size_t i = 0; i < resources.size(); ++i)
    if (resources[i].name == name) return i;
  const ResourceDescription* resource = registry.resource(name);
  resources.push_back({.name = name, .type = resource->type.data, .perView = resource->perView});
  return resources.size() - 1;
}

void Executor::Impl::findResources(const Imports& imports, bool perView) {
  for (UsedResource& resource : resources) {
    if (resource.perView != perView) continue;
    resource.data = imports.find(resource.name, resource.type);
    CHECK(resource.data, "the resource '{}' was not given to execute()", resource.name);
  }
}

Status Executor::Impl::execute(const FrameInput& input, const OnView& onView) {
  if (!ready)
    return error(ErrorKind::Pipeline, "there is no valid pipeline: correct the faults reported");
  profile = {};
  profile.frame = input.frame;
  const bool perSceneRuns = input.sceneChanged || rebuilt;
  if (storage.prepareViews(std::max<std::size_t>(1, input.views.size()))) bindPorts();
  storage.beginFrame(input.cut, perSceneRuns);
  findResources(input.shared, false);
  PassContext context{.device = device,
                      .time = input.time,
                      .timeStep = input.timeStep,
                      .frame = input.frame,
                      .viewCount = static_cast<int>(input.views.size()),
                      .outputSize = outputSize,
                      .seed = input.seed};
  for (std::size_t s = 0; s < firstPerView; ++s)
    if (perSceneRuns || schedule.steps[s].frequency != Frequency::PerScene) runStep(s, context);
  const Status drawn = runViews(input, context, onView);
  written = std::move(context.written);
  rebuilt = rebuilt && !drawn;
  if (profiling) finishProfile();
  return drawn;
}

Status Executor::Impl::runViews(const FrameInput& input, PassContext& context,
                                const OnView& onView) {
  for (std::size_t view = 0; view < input.views.size(); ++view) {
    findResources(input.views[view], true);
    context.view = static_cast<int>(view);
    for (std::size_t s = firstPerView; s < steps.size(); ++s) runStep(s, context);
    LUCERNA_TRY_VOID(takeErrors());
    currentView = view;
    if (onView) LUCERNA_TRY_VOID(onView(context.view, *textureOf(schedule.output, view)));
  }
  return {};
}

void Executor::Impl::runStep(std::size_t index, PassContext& context) {
  const Step& step = schedule.steps[index];
  RunStep& run = steps[index];
  if (step.kind == Step::Kind::Fill &&
      storage.texture(schedule.versions[step.to].physical).filled &&
      storage.texture(schedule.versions[step.to].physical).fill == step.fill)
    return;
  const gpu::DebugGroup group(device, step.name);
  const auto work = [&] {
    if (step.kind == Step::Kind::Pass)
      runPass(run, context);
    else if (step.kind == Step::Kind::Fill)
      runFill(step);
    else
      device.copy(*textureOf(step.from, static_cast<std::size_t>(context.view)),
                  *textureOf(step.to, static_cast<std::size_t>(context.view)));
  };
  if (!profiling) return work();
  const gpu::Counters before = device.counters();
  device.beginTimer(step.name);
  const auto begin = Clock::now();  // after the timer's start, which may finish the pipe
  work();
  const double cpuMs = msSince(begin);
  device.endTimer();
  profile.steps.push_back({.row = step.name,
                           .view = context.view,
                           .cpuMs = cpuMs,
                           .counters = device.counters() - before,
                           .textureBytes = run.textureBytes});
}

void Executor::Impl::runPass(RunStep& run, PassContext& context) {
  const auto view = static_cast<std::size_t>(context.view);
  std::vector<BoundPort>& ports = run.ports[run.ports.size() == 1 ? 0 : view];
  for (const MovingPort& moving : run.moving) {
    BoundPort& port = ports[moving.port];
    const bool isNew = port.isNew;
    if (moving.kind == MovingPort::Kind::Resource)
      port.data = resources[moving.index].data;
    else
      port = bind(*port.port, moving.index, view, moving.kind == MovingPort::Kind::Previous);
    port.isNew = isNew;
  }
  run.instance->execute(context, ports);
}

void Executor::Impl::runFill(const Step& step) {
  TextureSlots& slots = storage.texture(schedule.versions[step.to].physical);
  device.clear(slots.of(0).items[0], step.fill);
  slots.filled = true;
  slots.fill = step.fill;
}

void Executor::Impl::finishProfile() {
  std::size_t next = 0;
  for (const auto& [name, ms] : device.takeTimes()) {
    if (next == profile.steps.size() || profile.steps[next].row != name) continue;
    profile.steps[next++].gpuMs = ms;
  }
  for (const StepProfile& step : profile.steps) {
    profile.cpuMs += step.cpuMs;
    profile.gpuMs += step.gpuMs;
    profile.counters = profile.counters + step.counters;
  }
  profile.textureBytes = storage.textureBytes();
}

Status Executor::Impl::takeErrors() {
  const std::vector<Error> errors = device.takeErrors();
  if (errors.empty()) return {};
  std::vector<std::string> messages;
  for (const Error& e : errors) messages.push_back(e.message);
  return Error{errors.front().kind, join(messages, "\n")};
}

const gpu::Texture* Executor::Impl::textureOf(std::size_t version, std::size_t view) {
  if (version == kNoVersion || !schedule.versions[version].type.texture) return nullptr;
  auto& slot = storage.texture(schedule.versions[version].physical).of(view);
  return &slot.items[slot.current];
}

const void* Executor::Impl::dataOf(std::size_t version, std::size_t view, std::type_index type) {
  if (version == kNoVersion || schedule.versions[version].type.data != type) return nullptr;
  auto& slot = storage.data(schedule.versions[version].physical).of(view);
  return slot.items[slot.current].get();
}

std::size_t Executor::Impl::keptVersion(std::string_view name) const {
  const auto found = std::ranges::find(plan.keptNames, name);
  return found == plan.keptNames.end()
             ? kNoVersion
             : schedule.kept[static_cast<std::size_t>(found - plan.keptNames.begin())];
}

Executor::Executor(gpu::Device& device, const Registry& registry)
    : impl_(std::make_unique<Impl>(device, registry)) {}
Executor::~Executor() = default;

Status Executor::setPipeline(const Pipeline& pipeline, uvec2 outputSize,
                             const std::vector<std::string>& kept) {
  return impl_->setPipeline(pipeline, outputSize, kept);
}

Status Executor::setParam(const std::string& rowName, const std::string& param,
                          const Value& value) {
  std::size_t index = 0;
  while (index < impl_->rows.size() && impl_->rows[index].name != rowName) ++index;
  if (!impl_->ready || index == impl_->rows.size())
    return error(ErrorKind::Usage, "no pass named '{}' is running", rowName);
  const ResolvedRow& resolved = impl_->plan.rows[index];
  const ParamDescription* description = resolved.description.param(param);
  if (!description)
    return error(ErrorKind::Usage, "pass '{}' ({}) has no parameter '{}'", rowName,
                 resolved.description.type, param);
  if (const auto fault = checkValue(*description, value))
    return error(ErrorKind::Usage, "{}.{}: found {}, wanted {}; {}", rowName, param, fault->found,
                 fault->wanted, fault->remedy);
  if (description->rebuild == Rebuild::Ports) {
    Pipeline changed = impl_->pipeline;
    changed.passes[resolved.row].params[param] = value;
    const gpu::Capabilities& capabilities = impl_->device.capabilities();
    const Validation check = validate(changed, impl_->registry, capabilities, impl_->keptNames);
    if (!check.ok()) return Error{ErrorKind::Pipeline, check.text()};
    return impl_->setPipeline(changed, impl_->outputSize, std::vector(impl_->keptNames));
  }
  impl_->pipeline.passes[resolved.row].params[param] = value;
  Row& row = impl_->rows[index];
  row.params[param] = value;
  if (row.instance) row.instance->setParams(row.params);
  if (resolved.description.frequency == Frequency::PerScene) impl_->rebuilt = true;
  return {};
}

Status Executor::execute(const FrameInput& input, const OnView& onView) {
  return impl_->execute(input, onView);
}

const gpu::Texture* Executor::kept(std::string_view name) const {
  return impl_->textureOf(impl_->keptVersion(name), impl_->currentView);
}

const void* Executor::keptData(std::string_view name, std::type_index type) const {
  return impl_->dataOf(impl_->keptVersion(name), impl_->currentView, type);
}

void Executor::setProfiling(bool on) {
  impl_->profiling = on;
}
const std::vector<std::filesystem::path>& Executor::written() const {
  return impl_->written;
}

const FrameProfile& Executor::profile() const {
  return impl_->profile;
}
const Plan& Executor::plan() const {
  return impl_->plan;
}
const std::vector<std::string>& Executor::warnings() const {
  return impl_->warnings;
}
const Schedule& Executor::schedule() const {
  return impl_->schedule;
}

}  // namespace lucerna::graph

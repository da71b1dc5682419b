#include "graph/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "graph/size_relation.hpp"

namespace lucerna::graph {
namespace {

using Key = std::tuple<Source::Kind, std::size_t, std::string>;
Key keyOf(const Source& source) {
  return {source.kind, source.row, source.port};
}

class Scheduler {
 public:
  Scheduler(const Plan& plan, uvec2 outputSize) : plan_(plan), sizes_(plan) {
    schedule_.outputSize = outputSize;
  }

  Schedule run() {
    orderRows();
    findReads();
    makeFills();
    for (order_ = 0; order_ < rows_.size(); ++order_) makeStep();
    if (isMade(plan_.output)) schedule_.output = versions_.at(keyOf(plan_.output));
    for (const Source& source : plan_.kept)
      schedule_.kept.push_back(isMade(source) ? versions_.at(keyOf(source)) : kNoVersion);
    findLifetimes();
    assignData();
    assignTextures();
    return std::move(schedule_);
  }

 private:
  static bool isMade(const Source& source) {
    return source.kind == Source::Kind::Output || source.kind == Source::Kind::Fill;
  }

  void orderRows() {
    for (std::size_t i = 0; i < plan_.rows.size(); ++i)
      if (!plan_.rows[i].culled) rows_.push_back(i);
    std::stable_sort(rows_.begin(), rows_.end(), [&](std::size_t a, std::size_t b) {
      return plan_.rows[a].description.frequency < plan_.rows[b].description.frequency;
    });
  }

  // When each value is last read, in the order of rows_; its updaters read it too.
  struct Reads {
    std::size_t last = 0;
    int atLast = 0;  // ports that read it then
    bool ever = false;
    bool survives = false;  // output, kept or history
    bool history = false;
  };

  void findReads() {
    for (std::size_t order = 0; order < rows_.size(); ++order) {
      const ResolvedRow& row = plan_.rows[rows_[order]];
      for (const ResolvedInput& input : row.inputs) {
        if (!isMade(input.source)) continue;
        Reads& reads = reads_[keyOf(input.source)];
        reads.ever = true;
        if (row.description.input(input.port)->history) {
          reads.survives = reads.history = true;
        } else {
          reads.atLast = reads.last == order ? reads.atLast + 1 : 1;
          reads.last = order;
        }
        if (input.source.kind == Source::Kind::Fill)
          fills_.emplace(keyOf(input.source), &input.source);
      }
    }
    const auto keep = [&](const Source& source) {
      if (!isMade(source)) return;
      Reads& reads = reads_[keyOf(source)];
      reads.ever = reads.survives = true;
      if (source.kind == Source::Kind::Fill) fills_.emplace(keyOf(source), &source);
    };
    keep(plan_.output);
    for (const Source& source : plan_.kept) keep(source);
  }

  uvec2 pixelsOf(const Source& source) { return sizes_.of(source).inPixels(schedule_.outputSize); }

  std::size_t addVersion(Version version) {
    schedule_.versions.push_back(std::move(version));
    return schedule_.versions.size() - 1;
  }

  static gpu::TextureDesc descOf(const PortType& type, uvec2 size) {
    if (!type.texture) return {};
    const TextureSpec& spec = *type.texture;
    CHECK(!spec.formats.empty(), "a texture without a format is asked for");
    return {.kind = spec.kind,
            .format = spec.formats[0],
            .width = static_cast<int>(size.x),
            .height = static_cast<int>(size.y),
            .layers = spec.layers,
            .levels = spec.levels,
            .samples = spec.samples};
  }

  void makeFills() {
    for (const auto& [key, source] : fills_) {
      const std::string name = fmt::format("{}.{}", plan_.rowNames[source->row], source->port);
      const std::size_t version = addVersion({.name = name,
                                              .type = source->type,
                                              .texture = descOf(source->type, pixelsOf(*source)),
                                              .frequency = Frequency::PerScene,
                                              .standIn = true});
      versions_[key] = version;
      chains_.push_back({version});
      if (source->type.texture)
        schedule_.steps.push_back({.kind = Step::Kind::Fill,
                                   .name = "(fill) " + name,
                                   .to = version,
                                   .fill = source->fill,
                                   .frequency = Frequency::PerScene});
    }
  }

  void makeStep() {
    const ResolvedRow& row = plan_.rows[rows_[order_]];
    Step step{.name = row.name, .row = rows_[order_], .frequency = row.description.frequency};
    for (const PortDescription& port : row.description.ports) {
      if (row.updates(port))
        step.versions.push_back(makeUpdate(row, port));
      else if (port.makes())
        step.versions.push_back(makeOutput(row, port));
      else
        step.versions.push_back(kNoVersion);  // known only when all outputs are: see bindInputs
    }
    schedule_.steps.push_back(std::move(step));
  }

  Version versionOf(const ResolvedRow& row, const PortDescription& port, const PortType& type) {
    Source source;
    source.kind = Source::Kind::Output;
    source.row = row.row;
    source.port = port.name;
    const auto reads = reads_.find(keyOf(source));
    return {.name = fmt::format("{}.{}", row.name, port.name),
            .type = type,
            .texture = descOf(type, pixelsOf(source)),
            .frequency = row.description.frequency,
            .history = reads != reads_.end() && reads->second.history,
            .persistent = port.persistent};
  }

  std::size_t makeOutput(const ResolvedRow& row, const PortDescription& port) {
    const Key key{Source::Kind::Output, row.row, port.name};
    const bool unread = !reads_[key].ever;
    if (port.direction == Direction::Out && port.optional && unread) return kNoVersion;
    const std::size_t version = addVersion(versionOf(row, port, port.type));
    versions_[key] = version;
    chains_.push_back({version});
    return version;
  }

  std::size_t makeUpdate(const ResolvedRow& row, const PortDescription& port) {
    const Source& source = row.input(port.name)->source;
    if (!isMade(source)) return kNoVersion;
    const std::size_t old = versions_.at(keyOf(source));
    const std::size_t version = addVersion(versionOf(row, port, source.type));
    versions_[{Source::Kind::Output, row.row, port.name}] = version;
    if (mayUpdateInPlace(row, source, schedule_.versions[old])) {
      const auto chain = std::find_if(chains_.begin(), chains_.end(),
                                      [&](const auto& c) { return c.back() == old; });
      CHECK(chain != chains_.end(), "'{}' is updated twice", schedule_.versions[old].name);
      chain->push_back(version);
    } else {
      chains_.push_back({version});
      schedule_.steps.push_back({.kind = Step::Kind::Copy,
                                 .name = "(copy) " + schedule_.versions[old].name,
                                 .from = old,
                                 .to = version,
                                 .frequency = row.description.frequency});
    }
    return version;
  }

  // Unless someone still needs the older version: a later reader, this row through another port,
  // the next frame, or a pass that runs less often than this one and so would not make it again.
  bool mayUpdateInPlace(const ResolvedRow& row, const Source& source, const Version& old) {
    if (!old.type.texture) return true;  // validated: nobody reads the older one
    const Reads& reads = reads_.at(keyOf(source));
    const bool readLater = reads.last > order_ || (reads.last == order_ && reads.atLast > 1);
    return !readLater && !reads.survives && !old.standIn && !old.persistent &&
           old.frequency == row.description.frequency;
  }

  void bindInputs() {
    for (Step& step : schedule_.steps) {
      if (step.kind != Step::Kind::Pass) continue;
      const ResolvedRow& row = plan_.rows[step.row];
      for (std::size_t i = 0; i < step.versions.size(); ++i) {
        const PortDescription& port = row.description.ports[i];
        if (port.direction != Direction::In) continue;
        const Source& source = row.input(port.name)->source;
        if (isMade(source)) step.versions[i] = versions_.at(keyOf(source));
      }
    }
  }

  void findLifetimes() {
    bindInputs();
    auto& versions = schedule_.versions;
    const std::size_t end = schedule_.steps.size();
    for (std::size_t s = 0; s < end; ++s) {
      const Step& step = schedule_.steps[s];
      if (step.to != kNoVersion) write(step.to, s);
      if (step.from != kNoVersion) read(step.from, s);
      for (std::size_t i = 0; i < step.versions.size(); ++i) {
        if (step.versions[i] == kNoVersion) continue;
        const ResolvedRow& row = plan_.rows[step.row];
        const PortDescription& port = row.description.ports[i];
        if (port.direction == Direction::In)
          read(step.versions[i], port.history ? end : s);
        else
          write(step.versions[i], s);
        if (row.updates(port)) read(versions_.at(keyOf(row.input(port.name)->source)), s);
      }
    }
    if (schedule_.output != kNoVersion) versions[schedule_.output].lastStep = end;
    for (const std::size_t kept : schedule_.kept)
      if (kept != kNoVersion) versions[kept].lastStep = end;
  }

  void write(std::size_t index, std::size_t step) {
    Version& version = schedule_.versions[index];
    if (written_.size() < schedule_.versions.size()) written_.resize(schedule_.versions.size());
    if (!written_[index]) version.firstStep = step;
    written_[index] = true;
    version.lastStep = std::max(version.lastStep, step);
  }

  // What was made for all views must last until the last view has read it.
  void read(std::size_t index, std::size_t step) {
    Version& version = schedule_.versions[index];
    const std::size_t end = schedule_.steps.size();
    const bool sharedByViews = version.frequency != Frequency::PerView && step < end &&
                               schedule_.steps[step].frequency == Frequency::PerView;
    version.lastStep = std::max(version.lastStep, sharedByViews ? end : step);
  }

  template <typename Predicate>
  bool anyOf(const std::vector<std::size_t>& chain, Predicate predicate) const {
    return std::any_of(chain.begin(), chain.end(),
                       [&](std::size_t v) { return predicate(schedule_.versions[v]); });
  }

  void assignData() {
    for (const auto& chain : chains_) {
      const Version& first = schedule_.versions[chain[0]];
      if (first.type.texture) continue;
      const bool history = anyOf(chain, [](const Version& v) { return v.history; });
      const bool persistent = anyOf(chain, [](const Version& v) { return v.persistent; });
      for (const std::size_t v : chain) schedule_.versions[v].physical = schedule_.data.size();
      schedule_.data.push_back(
          {.type = first.type,
           .versions = chain,
           .history = history,
           .perView = (history || persistent) && first.frequency == Frequency::PerView});
    }
  }

  // Linear scan over lifetimes in the order of their beginning: a texture is free again after the
  // last step that reads what it held. For textures of one description this uses as few as
  // possible.
  void assignTextures() {
    std::vector<const std::vector<std::size_t>*> chains;
    for (const auto& chain : chains_)
      if (schedule_.versions[chain[0]].type.texture) chains.push_back(&chain);
    std::stable_sort(chains.begin(), chains.end(), [&](const auto* a, const auto* b) {
      return schedule_.versions[a->front()].firstStep < schedule_.versions[b->front()].firstStep;
    });
    std::vector<std::size_t> busyUntil;
    for (const auto* chain : chains) {
      const Version& first = schedule_.versions[chain->front()];
      std::size_t last = 0;
      for (const std::size_t v : *chain) last = std::max(last, schedule_.versions[v].lastStep);
      PhysicalTexture wanted = physicalFor(*chain);
      std::size_t slot = schedule_.textures.size();
      for (std::size_t t = 0; t < schedule_.textures.size() && !wanted.keepsContent; ++t)
        if (schedule_.textures[t].desc == wanted.desc && !schedule_.textures[t].keepsContent &&
            busyUntil[t] < first.firstStep) {
          slot = t;
          break;
        }
      if (slot == schedule_.textures.size()) {
        schedule_.textures.push_back(std::move(wanted));
        busyUntil.push_back(0);
      }
      auto& texture = schedule_.textures[slot];
      texture.versions.insert(texture.versions.end(), chain->begin(), chain->end());
      for (const std::size_t v : *chain) schedule_.versions[v].physical = slot;
      busyUntil[slot] = last;
    }
  }

  PhysicalTexture physicalFor(const std::vector<std::size_t>& chain) const {
    const Version& first = schedule_.versions[chain.front()];
    const bool history = anyOf(chain, [](const Version& v) { return v.history; });
    const bool keeps = history || first.standIn || first.frequency == Frequency::PerScene ||
                       anyOf(chain, [](const Version& v) { return v.persistent; });
    return {.desc = first.texture,
            .keepsContent = keeps,
            .history = history,
            .perView = keeps && first.frequency == Frequency::PerView};
  }

  const Plan& plan_;
  SizeRelations sizes_;
  Schedule schedule_;
  std::vector<std::size_t> rows_;  // indices in plan_.rows, in the order of running
  std::size_t order_ = 0;          // position in rows_ while steps are made
  std::map<Key, Reads> reads_;
  std::map<Key, const Source*> fills_;
  std::map<Key, std::size_t> versions_;
  std::vector<std::vector<std::size_t>>
      chains_;  // versions that share one slot by updates in place
  std::vector<bool> written_;
};

}  // namespace

std::uint64_t Schedule::bytes() const {
  std::uint64_t sum = 0;
  for (const PhysicalTexture& texture : textures)
    sum += texture.desc.bytes() * (texture.history ? 2 : 1);
  return sum;
}

std::uint64_t Schedule::bytesWithoutReuse() const {
  std::uint64_t sum = 0;
  for (const Version& version : versions)
    if (version.type.texture) sum += version.texture.bytes() * (version.history ? 2 : 1);
  return sum;
}

Schedule makeSchedule(const Plan& plan, uvec2 outputSize) {
  return Scheduler(plan, outputSize).run();
}

}  // namespace lucerna::graph

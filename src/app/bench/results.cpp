#include "app/bench/results.hpp"

#include <fmt/chrono.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>

#include "app/bench/statistics.hpp"
#include "core/log.hpp"
#include "core/version.hpp"

namespace lucerna::app::bench {
namespace {

std::string nameOfCpu() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      return line.substr(std::min(line.find(':') + 2, line.size()));
  return "unknown";
}

std::string listed(const std::vector<double>& values) {
  std::string text;
  for (const double value : values)
    text += fmt::format("{}{:.2f}", text.empty() ? "" : ", ", value);
  return text;
}

bool beginsWith(const Name& name, const Name& begin) {
  return name.size() >= begin.size() && std::equal(begin.begin(), begin.end(), name.begin());
}

}  // namespace

void Measurement::count(std::string_view counter, double value) {
  auto found = std::ranges::find(counters, counter, &Counter::name);
  if (found == counters.end()) found = counters.insert(found, {std::string(counter), {}});
  found->samples.push_back(value);
}

const std::vector<double>& Measurement::samples(std::string_view counter) const {
  static const std::vector<double> none;
  const auto found = std::ranges::find(counters, counter, &Counter::name);
  return found == counters.end() ? none : found->samples;
}

std::vector<std::pair<std::string, std::string>> Context::described() const {
  std::vector<std::pair<std::string, std::string>> pairs{
      {"date", date},
      {"Lucerna", fmt::format("{}, {} build", version, build)},
      {"CPU", fmt::format("{}, {} cores, load {}", cpu, cores, listed(load))}};
  if (!driver.empty()) {
    pairs.emplace_back("OpenGL", driver);
    pairs.emplace_back("time of a pass",
                       timers == "gpu-timer"
                           ? "by the GPU's timer"
                           : "by the CPU's clock, the GPU's work finished before and after");
  }
  pairs.emplace_back("seed",
                     fmt::format("{}{}", seed, quick ? "; measured quickly (--quick)" : ""));
  return pairs;
}

Context contextOfMachine() {
  Context context;
  context.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  context.version = kVersion;
#ifdef NDEBUG
  context.build = "release";
#else
  context.build = "debug";
#endif
  context.cpu = nameOfCpu();
  context.cores = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  std::array<double, 3> load{};
  const int known = getloadavg(load.data(), static_cast<int>(load.size()));
  context.load.assign(load.begin(), load.begin() + std::max(known, 0));
  return context;
}

Measurement& Results::at(const Name& name) {
  const auto found = std::ranges::find(measurements, name, &Measurement::name);
  if (found != measurements.end()) return *found;
  return measurements.emplace_back(Measurement{.name = name});
}

const Measurement* Results::find(const Name& name) const {
  const auto found = std::ranges::find(measurements, name, &Measurement::name);
  return found == measurements.end() ? nullptr : &*found;
}

std::vector<double> Results::times(const Name& begin) const {
  std::vector<double> all;
  for (const Measurement& m : measurements)
    if (beginsWith(m.name, begin)) all.insert(all.end(), m.realMs.begin(), m.realMs.end());
  return all;
}

std::vector<double> Results::samples(const Name& begin, std::string_view counter) const {
  std::vector<double> all;
  for (const Measurement& m : measurements)
    if (const auto& own = m.samples(counter); beginsWith(m.name, begin))
      all.insert(all.end(), own.begin(), own.end());
  return all;
}

std::vector<double> Results::ratios(const Name& begin, const Name& baseline) const {
  std::vector<double> all;
  for (const Measurement& m : measurements) {
    if (!beginsWith(m.name, begin)) continue;
    Name other = baseline;
    other.insert(other.end(), m.name.begin() + static_cast<std::ptrdiff_t>(begin.size()),
                 m.name.end());
    if (const Measurement* against = find(other)) {
      const std::vector<double> own = pairedRatios(m.realMs, against->realMs);
      all.insert(all.end(), own.begin(), own.end());
    }
  }
  return all;
}

void Results::note(const std::string& text) {
  if (std::ranges::find(notes, text) == notes.end()) notes.push_back(text);
}

void Results::fail(const std::string& what, const Error& error) {
  std::string text = fmt::format("Failed: {}: {}", what, error.message);
  std::ranges::replace(text, '\n', ' ');
  note(text);
  if (!failed) failed = error.kind;
  log::error("{}: {}: {}", suite, what, error.message);
}

Context sharedContext(const std::vector<Results>& suites) {
  if (suites.empty()) return {};
  const auto opened =
      std::ranges::find_if(suites, [](const Results& r) { return !r.context.driver.empty(); });
  return opened == suites.end() ? suites.front().context : opened->context;
}

std::vector<std::string> Results::parts(std::size_t place, const Name& begin) const {
  std::vector<std::string> found;
  for (const Measurement& m : measurements)
    if (m.name.size() > place && beginsWith(m.name, begin) &&
        std::ranges::find(found, m.name[place]) == found.end())
      found.push_back(m.name[place]);
  return found;
}

}  // namespace lucerna::app::bench

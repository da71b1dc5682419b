#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/bench/results.hpp"
#include "app/bench/statistics.hpp"
#include "core/text.hpp"

namespace lucerna::app::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Aggregate {
  const char* name;
  double Spread::* value;
};
constexpr Aggregate kAggregates[] = {{"median", &Spread::median},
                                     {"lower_quartile", &Spread::lower},
                                     {"upper_quartile", &Spread::upper},
                                     {"min", &Spread::min},
                                     {"max", &Spread::max}};

Json contextJson(const std::vector<Results>& suites) {
  const Context context = sharedContext(suites);
  Json extents = Json::object();
  for (const Results& results : suites)
    extents[results.suite] = {{"sizes", results.sizes},
                              {"cameras", results.cameras},
                              {"rounds", results.rounds},
                              {"cancelled", results.cancelled},
                              {"notes", results.notes}};
  return {{"date", context.date},
          {"executable", "lucerna bench"},
          {"num_cpus", context.cores},
          {"cpu", context.cpu},
          {"load_avg", context.load},
          {"library_version", context.version},
          {"library_build_type", context.build},
          {"json_schema_version", 1},
          {"driver", context.driver},
          {"timers", context.timers},
          {"quick", context.quick},
          {"seed", context.seed},
          {"suites", std::move(extents)}};
}

// What a run of either type begins with.
Json runJson(const std::string& name, const std::string& runName, std::size_t family,
             const Measurement& m) {
  return {{"name", name},        {"family_index", family},         {"per_family_instance_index", 0},
          {"run_name", runName}, {"repetitions", m.realMs.size()}, {"threads", 1}};
}

void addTimes(Json& run, double real, double cpu) {
  run["real_time"] = real;
  run["cpu_time"] = cpu;
  run["time_unit"] = "ms";
}

void addMeasurement(Json& runs, const std::string& suite, std::size_t family,
                    const Measurement& m) {
  const std::string name = suite + "/" + join(m.name, "/");
  for (std::size_t i = 0; i < m.realMs.size(); ++i) {
    Json run = runJson(name, name, family, m);
    run["run_type"] = "iteration";
    run["repetition_index"] = i;
    run["iterations"] = 1;
    addTimes(run, m.realMs[i], m.cpuMs[i]);
    runs.push_back(std::move(run));
  }
  for (const auto& [aggregate, value] : kAggregates) {
    Json run = runJson(name + "_" + aggregate, name, family, m);
    run["run_type"] = "aggregate";
    run["aggregate_name"] = aggregate;
    run["aggregate_unit"] = "time";
    run["iterations"] = m.realMs.size();
    addTimes(run, spreadOf(m.realMs).*value, spreadOf(m.cpuMs).*value);
    for (const Counter& counter : m.counters)
      if (const double v = spreadOf(counter.samples).*value; std::isfinite(v))
        run[counter.name] = v;
    runs.push_back(std::move(run));
  }
}

}  // namespace

std::string googleBenchmarkJson(const std::vector<Results>& suites) {
  Json document{{"context", contextJson(suites)}, {"benchmarks", Json::array()}};
  std::size_t family = 0;
  for (const Results& results : suites)
    for (const Measurement& m : results.measurements)
      addMeasurement(document["benchmarks"], results.suite, family++, m);
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lucerna::app::bench

// What a suite measured, on what machine. Nothing is made of it yet: report.hpp does that.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.hpp"

namespace lucerna::app::bench {

// Exact counts and errors: one a frame, or one a camera.
struct Counter {
  std::string name;
  std::vector<double> samples;
};

// From the general to the special, as the suite says: {"800x600", "GBuffer", "atrium"}.
using Name = std::vector<std::string>;

struct Measurement {
  Name name{};
  std::vector<double> realMs{};  // one a frame, until the GPU has finished
  std::vector<double> cpuMs{};   // one a frame, until the commands are given
  std::vector<Counter> counters{};

  void add(double real, double cpu) {
    realMs.push_back(real);
    cpuMs.push_back(cpu);
  }
  void count(std::string_view counter, double value);
  const std::vector<double>& samples(std::string_view counter) const;  // empty if there are none
};

// Where and how it was measured.
struct Context {
  std::string date;            // ISO 8601, UTC
  std::string version, build;  // "0.1.0", "release"
  std::string cpu;
  int cores = 0;
  std::vector<double> load;  // of the machine over 1, 5 and 15 minutes, when it began
  std::string driver;        // "": nothing was drawn
  std::string timers;        // "gpu-timer" or "cpu-after-finish"
  bool quick = false;
  unsigned long long seed = 0;

  // As pairs to read.
  std::vector<std::pair<std::string, std::string>> described() const;
};
Context contextOfMachine();  // what does not depend on a driver or the suite

struct Results {
  std::string suite{};
  Context context{};
  std::vector<std::string> sizes{};  // of pictures: "800x600" px
  // Each variant takes `rounds` turns at each camera; no cameras: the suite draws nothing.
  int cameras = 0, rounds = 0;
  bool ownCameras = false;  // those of the scenes, as many of them as there are
  std::vector<Measurement> measurements{};
  std::vector<std::string> notes{};   // what was left out, and why
  bool cancelled = false;             // scenes are missing
  std::optional<ErrorKind> failed{};  // what went wrong first, if anything did; notes say what

  // The measurement of that name, made if there is none.
  Measurement& at(const Name& name);
  const Measurement* find(const Name& name) const;
  // The samples of all measurements whose names begin so: of real time, or of a counter.
  std::vector<double> times(const Name& begin) const;
  std::vector<double> samples(const Name& begin, std::string_view counter) const;
  // pairedRatios() of real times, each measurement against that whose name begins with `baseline`
  // in place of `begin`: of the same scene, and sample by sample of the same place and round.
  std::vector<double> ratios(const Name& begin, const Name& baseline) const;
  // Adds the note unless it is there already.
  void note(const std::string& text);
  // Notes that `what` is missing for this error, and says so.
  void fail(const std::string& what, const Error& error);
  // The different parts at `place` of names that begin with `begin`, in order.
  std::vector<std::string> parts(std::size_t place, const Name& begin = {}) const;
};

// Said once for all suites of a run: that of the first one which came to open a scene.
Context sharedContext(const std::vector<Results>& suites);

// As Google Benchmark writes it (--benchmark_out, json_schema_version 1), so that its tools read
// it: a run of type "iteration" for each sample of time and the aggregates "median",
// "lower_quartile", "upper_quartile", "min" and "max", which have the counters that are finite (the
// PSNR of equal pictures is not).
std::string googleBenchmarkJson(const std::vector<Results>& suites);

}  // namespace lucerna::app::bench

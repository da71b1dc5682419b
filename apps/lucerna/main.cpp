// lucerna: the command line. Exit codes are those of ErrorKind.

#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include "command_line.hpp"
#include "core/log.hpp"
#include "core/progress.hpp"
#include "core/version.hpp"

namespace lucerna::cli {
namespace {

constexpr const char* kMemory =
    "out of memory; render smaller (--size, --scale), take a smaller scene, or close other "
    "programs";
constexpr const char* kBakeMemory =
    "out of memory; bake fewer texels (a lower --density), leave out the light of surfaces that "
    "shine (\"bake\": {\"areaLights\": false} in the scene), or close other programs; --dry-run "
    "says what a bake takes";

// Errors go to stderr; with --json the one document on stdout says it too.
int fail(const Error& fault, bool json) {
  // A list of faults says of each line itself whether it is an error or a warning.
  const bool saysItself =
      fault.message.starts_with("error: ") || fault.message.starts_with("warning: ");
  const char* prefix = saysItself ? "" : "error: ";
  std::fprintf(stderr, "%s%s\n", prefix, fault.message.c_str());
  const int code = static_cast<int>(fault.kind);
  if (json) printJson({{"error", {{"code", code}, {"message", fault.message}}}});
  return code;
}

bool wantsJson(int count, char** words) {
  for (int i = 1; i < count; ++i)
    if (std::strcmp(words[i], "--json") == 0) return true;
  return false;
}

int run(int count, char** words) {
  CommandLine line;
  line.app.name("lucerna");
  line.app.description("A real-time renderer whose picture is a list of passes.");
  line.app.set_version_flag("--version", fmt::format("lucerna {}", kVersion));
  line.app.footer(
      "Exit codes: 0 ok, 1 failed or differs, 2 usage, 3 input unreadable, 4 no usable "
      "OpenGL,\n5 pipeline, pass or shader error, 130 cancelled.");
  line.app.require_subcommand(0, 1);  // so that `bench bake` is a suite, not a second command
  addRender(line);
  addReference(line);
  addCompare(line);
  addBake(line);
  addLightmap(line);
  addBench(line);
  addInfo(line);
  addDoctor(line);
  addPass(line);
  addPipeline(line);
  try {
    line.app.parse(count, words);
  } catch (const CLI::Success& done) {
    return line.app.exit(done);  // --help, --version
  } catch (const CLI::ParseError& fault) {
    return fail({ErrorKind::Usage, usageMessage(line.app, fault)}, wantsJson(count, words));
  }
  if (!line.action) {
    std::fputs(helpText(line.app).c_str(), stderr);
    return static_cast<int>(ErrorKind::Usage);
  }
  log::setLevel(line.talk.quiet     ? log::Level::Error
                : line.talk.verbose ? log::Level::Debug
                                    : log::Level::Info);
  Progress::setVisible(!line.talk.quiet);
  Progress::catchInterrupt();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is a write that fails
  try {
    const Result<int> result = line.action();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      return fail({ErrorKind::Failed, "standard output cannot be written: is the disk full?"},
                  false);
    return result ? *result : fail(result.error(), line.talk.json);
  } catch (const std::bad_alloc&) {
    return fail({ErrorKind::Failed, line.app.got_subcommand("bake") ? kBakeMemory : kMemory},
                line.talk.json);
  } catch (const std::exception& fault) {  // gpu::OutOfMemory; nothing else throws by design
    return fail({ErrorKind::Failed, fault.what()}, line.talk.json);
  }
}

}  // namespace
}  // namespace lucerna::cli

int main(int count, char** words) {
  return lucerna::cli::run(count, words);
}

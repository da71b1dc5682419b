// What a suite is, and what runs it: scene after scene, in which the suite's variants take turns.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/bench/report.hpp"
#include "app/bench/results.hpp"
#include "app/bench/stage.hpp"
#include "core/progress.hpp"

namespace lucerna::app::bench {

struct SceneChoice {
  std::string name;
  std::string path;      // what loadScene() takes; of an outside scene within BenchOptions' folder
  bool outside = false;  // a file that does not come with Lucerna
  float elevationDegrees = 40, azimuthDegrees = 30;  // of its sun
  float eyeHeight = 0;                               // m, see CameraWish
  std::vector<uvec2> sizes = {}, quickSizes = {};    // px, instead of the suite's; empty: those
  bool quick = true;                                 // measured by --quick, too
  bool translucent = false;  // its translucent surfaces stay where others are plain
  bool moving = false;       // its animations play: see Stage::at()
};

// Where a scene is seen from.
enum class Places {
  Seeded,  // see cameras.hpp
  Own,     // the first of the scene's own cameras
};

// How much is measured.
struct Extent {
  std::vector<uvec2> sizes;  // px
  int cameras = 1, rounds = 1;
};

struct BenchOptions {
  RenderSettings render;  // seed, threads, plugins, shaders; scene, size and pipeline are not read
  std::vector<std::string> scenes;  // instead of the suite's own
  std::string sceneFolder;          // of outside scenes; "": there are none
  bool quick = false;
  std::vector<uvec2> sizes;  // instead of the suite's own; empty: those
  std::optional<int> cameras, rounds;
};

// One scene's share of a suite.
class Run {
 public:
  Run(Stage& s, Results& r, std::string sceneName, Extent e, Progress& progress)
      : stage(s),
        results(r),
        scene(std::move(sceneName)),
        extent(std::move(e)),
        progress_(progress) {}

  Stage& stage;
  Results& results;
  std::string scene;
  Extent extent;
  std::vector<SeededCamera> cameras;  // as many as extent has

  // A variant that takes turns with the others, its name ending with the scene's. One that cannot
  // be drawn, now or later, fails alone: see Results::fail().
  void add(Name name, const Variant& variant);

  struct Turns {
    std::function<Status()> prepare = nullptr;                         // once, before the warm-up
    std::function<void(const Name& name, const Sample& sample)> take;  // what a frame took
    std::function<void(const Name& name, const Image& picture)> see = nullptr;  // of the warm-up
  };
  // From where the camera stands: draws each variant once to warm up, in the order in which they
  // were added, then in as many rounds as extent has, each in another order. share: of the scene's
  // work that this is. Errors: those of prepare(); ErrorKind::Cancelled.
  Status takeTurns(const Turns& turns, double share);
  // That at each of the cameras.
  Status takeTurnsEverywhere(const Turns& turns);
  // Draws each variant that is wanted once.
  Status drawEach(const std::function<bool(const Name& name)>& wanted,
                  const std::function<void(const Name& name, const Image& picture)>& see);
  // Forgets all variants.
  void clear();

 private:
  struct Lane {
    Name name;
    std::size_t variant;
    bool works = true;
  };
  // None if it fails.
  Result<std::optional<Sample>> draw(Lane& lane, Image* picture = nullptr);
  void advance(double share);

  Progress& progress_;
  double done_ = 0;         // of the scene's work
  std::size_t rounds_ = 0;  // of all places so far
  std::vector<Lane> lanes_;
};

// The same of a suite that draws nothing.
struct SceneRun {
  const scene::Scene& scene;
  Results& results;
  std::string name;  // of the scene
  std::string path;  // what it was loaded from
  Extent extent;
  std::function<void(double share)> advance;  // of the scene's work
};

// In which order `count` variants draw in a round: over `count` rounds (twice as many if count is
// odd) each follows each other one equally often (Williams, "Experimental Designs Balanced for the
// Estimation of Residual Effects of Treatments", 1949).
std::vector<std::size_t> turnOrder(std::size_t count, std::size_t round);

struct Suite {
  std::string_view name, title;
  std::vector<SceneChoice> scenes;
  Extent full, quick;
  Lighting lighting = Lighting::Sun;
  Places places = Places::Seeded;
  Surfaces surfaces = Surfaces::Own;
  Status (*measure)(Run& run) = nullptr;
  // Instead of that: without pictures, cameras and GL.
  Status (*measureScene)(SceneRun& run) = nullptr;
  // Of results with at least one measurement.
  std::vector<Block> (*report)(const Results& results) = nullptr;
};

// In the order in which "all" runs them.
std::span<const Suite> suites();

// What the program does before it measures: ErrorKind::Usage or Input if a scene that the user
// names is not there.
Status checkScenes(const BenchOptions& options);

// Measures. When the user cancels, what is there of whole scenes (Results::cancelled). A scene that
// cannot be read and a chain that does not fit this driver are missing (Results::failed).
Results run(const Suite& suite, const BenchOptions& options);

// FOLDER/NAME.json, .md and .html. Returns the paths.
Result<std::vector<std::string>> writeResults(const std::string& folder, const std::string& name,
                                              const std::vector<Results>& results);

// One file each.
Suite passesSuite();
Suite forwardSuite();
Suite sraaSuite();
Suite ssaoSamplesSuite();
Suite shadowSizeSuite();
Suite depthOfFieldSuite();
Suite softShadowsSuite();
Suite softShadowsQualitySuite();
Suite bakeSuite();

// "800x600"
std::string sizeName(uvec2 size);
// As a screen shows linear colour: encoded to bytes, brighter than white cut off; F32.
Image asShown(const Image& linear);
// The scenes that stand for the thesis' five.
std::vector<SceneChoice> thesisScenes();

}  // namespace lucerna::app::bench

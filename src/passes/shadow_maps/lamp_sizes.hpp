// How large the maps of lamps are: as the picture needs them, within a budget. No GL.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace lucerna::passes {

// Sizes are those of ShadowAtlas: how often the largest side is halved.
class LampSizes {
 public:
  struct Lamp {
    std::uint32_t light = 0;  // index in Scene::lights: who it is from frame to frame
    float share = 1.f;        // of the picture's shorter side that its reach may fill, at most 1
    float importance = 0.f;   // strength times a share of the picture
    int maps = 0;
  };
  // A size for each lamp, most important first; of the last lamps none where not even maps of
  // smallestSize fit the budget, which is in cells of ShadowAtlas.
  //
  // A lamp's maps have the full side, less a halving for each by which its share is below 1. While
  // that is beyond the budget, the lamp is halved once more that has the least importance for each
  // cell. Against flicker, a size stays until the share is a quarter of a halving past it; of two
  // lamps the one that was smaller gives way unless it is now twice as important; and what grows
  // has to leave a sixteenth of the budget free.
  std::vector<int> choose(std::span<const Lamp> lamps, int smallestSize, int budget);

 private:
  std::map<std::uint32_t, int> former_;  // by light
};

}  // namespace lucerna::passes

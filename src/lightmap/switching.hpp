// Lightmaps whose groups of lights are switched, dimmed and coloured (system B, section 4.1).
//
// A patch adds whole numbers to a sum that each texel has, and later takes the same away. So maps
// depend on the present colours alone, whatever was set before and in whatever order, and with all
// of them 0 they are the base, bit by bit. (Floats would drift: (a + b) - b is not a.)
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "lightmap/patch.hpp"

namespace lucerna::lightmap {

class SwitchedMaps {
 public:
  // A colour may be this many times as bright as its patch's own. 1/2^30 of the brightest that a
  // texel can then become is the resolution of sums, rounded up to a power of two.
  static constexpr float kHeadroom = 64.f;

  // maps: F32 RGB, as Lightmap::maps: the base, with all patches off. ErrorKind::Input if a patch
  // is not one of these maps.
  static Result<SwitchedMaps> create(std::vector<Image> maps, std::span<const Patch> patches);

  // color: linear, times intensity, as Patch::color; 0 is off. Adds a patch's value times the
  // colour, rounded to the resolution. ErrorKind::Usage, and nothing is changed, where a channel is
  // negative, not finite or beyond the headroom.
  Status set(std::size_t patch, vec3 color);
  vec3 color(std::size_t patch) const { return switches_[patch].color; }
  std::size_t count() const { return switches_.size(); }

  // Brings the maps up to date, and tells which tiles were touched since the last call: by map,
  // row, column. Tiles at a map's far sides may reach beyond it.
  std::vector<TilePlace> update();
  // As of the last update().
  const std::vector<Image>& maps() const { return maps_; }

  float resolution() const { return resolution_; }  // irradiance

 private:
  struct Switch {
    std::string group;
    TileLight light;
    std::vector<std::uint32_t> slots;  // of each tile
    std::size_t channels = 1;
    float most = 0.f;  // of a channel of the colour
    vec3 color{0.f};
  };

  SwitchedMaps() = default;
  static Switch switchFor(const Patch& patch);
  void addSlots();
  void chooseResolution();
  void keepBase();
  void add(const Switch& patch, int sign);
  void write(std::size_t slot);

  std::vector<Image> maps_;
  std::vector<Switch> switches_;
  float resolution_ = 1.f;
  // Tiles that any patch lights. Values of each: one channel after the other, all texels.
  std::vector<TilePlace> places_;
  std::vector<float> base_;
  std::vector<std::int32_t> sums_;
  std::vector<std::uint8_t> changed_;
};

}  // namespace lucerna::lightmap

// Where the maps of lamps lie: squares of several sizes in the layers of an array texture. No GL.
//
// A layer is a square of 8 x 8 cells, numbered along a Z-order curve: a square of 2^n x 2^n cells
// is then an aligned run of 4^n numbers, and free runs halve and join as in the buddy system
// (Knowlton, "A Fast Storage Allocator", CACM 8(10), 1965).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::passes {

class ShadowAtlas {
 public:
  // A size is how often the side of a layer is halved, 0 to kSizes - 1.
  static constexpr int kSizes = 4;
  static constexpr int kCells = 64;  // of a layer
  static constexpr int cellsOf(int size) { return kCells >> (2 * size); }

  struct Wish {
    std::uint64_t key = 0;  // of whom the square is; no two wishes of a call have the same
    int size = 0;
  };
  struct Square {
    int layer = 0;
    ivec2 corner{0};  // texels, of the least x and y
    int side = 0;     // texels
    bool operator==(const Square&) const = default;
  };

  // side: of a layer, in texels; mostLayers: that may be used. Forgets all if either is new.
  void reshape(int side, int mostLayers);
  // A square for each wish, none over another; cellsOf() them all is at most kCells * mostLayers. A
  // key whose size is that of the last call keeps its square; only where the others do not fit
  // beside those that stay are all placed anew. What is not wished for is free again.
  std::vector<Square> place(std::span<const Wish> wishes);
  // That the squares lie in. Falls only in reshape(), so that a texture may follow.
  int layers() const { return static_cast<int>(used_.size()); }

 private:
  struct Run {
    int size = 0, layer = 0, index = 0;  // the index-th of its size in its layer
    std::uint64_t cells() const;
  };
  bool placeBesideOthers(std::span<const Wish> wishes);
  bool placeNew(const Wish& wish);
  Square squareOf(const Run& run) const;

  int side_ = 0, mostLayers_ = 0;
  std::vector<std::uint64_t> used_;    // of each layer, a bit for each cell
  std::map<std::uint64_t, Run> runs_;  // by key
};

}  // namespace lucerna::passes

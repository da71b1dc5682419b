// Names that the suite `bake` and its report share.
#pragma once

#include <array>
#include <string>

#include "app/bench/report.hpp"

namespace lucerna::app::bench {

// First parts of measurements' names: {kLight, LOAD, SCENE}, {kEngine, ENGINE, LOAD, SCENE},
// {kRate, HOW, LOAD, SCENE}, {kPacking, HOW, SCENE}.
inline const std::string kLight = "light", kEngine = "engine", kRate = "rate", kPacking = "packing";

inline const std::string kEmbree = "embree", kOctree = "octree";
inline const std::string kMasks = "masks", kRectangles = "rectangles";

// How rays are counted: by Embree alone, by the tracer alone, and within the light stage.
inline const std::string kBarePackets = "Embree, packets of 16",
                         kLikeTracer = "the same, set as the tracer",
                         kBareSingle = "Embree, ray by ray", kTracer = "the tracer alone",
                         kTracing = "light stage: tracing",
                         kShading = "light stage: tracing and shading",
                         kWhole = "light stage: all of it";
inline const std::array kHows{kBarePackets, kLikeTracer, kBareSingle, kTracer,
                              kTracing,     kShading,    kWhole};

// The same of the octree's own rays.
inline const std::string kOctreeBare = "octree's rays: Embree, ray by ray",
                         kOctreeRays = "octree's rays: the octree",
                         kNoMailboxes = "octree's rays: without mailboxes",
                         kUnsorted = "octree's rays: unsorted";
inline const std::array kOctreeHows{kOctreeBare, kOctreeRays, kNoMailboxes, kUnsorted};

std::vector<Block> bakeReport(const Results& results);

}  // namespace lucerna::app::bench

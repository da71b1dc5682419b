// How far the pictures of a pipeline look around a pixel: what tiles need as a guard band. No GL.
#pragma once

#include <string>

#include "graph/validate.hpp"

namespace lucerna::graph {

struct Reach {
  int pixels = 0;       // of the output, in every direction
  std::string whole{};  // an input that may read everywhere, "Edges.color"; "" if there is none
};

// Of the output and the kept values, over all passes on the way to them: the sum of the inputs'
// halos. What has a size of its own, whatever the output's (a shadow map), is no picture and counts
// nothing.
Reach reachOf(const Plan& plan);

}  // namespace lucerna::graph

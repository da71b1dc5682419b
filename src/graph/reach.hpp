// How far the pictures of a pipeline look around a pixel: what tiles need as a guard band. No GL.
#pragma once

#include <string>

#include "graph/validate.hpp"

namespace lucerna::graph {

struct Reach {
  int pixels = 0;       // of the output, in every direction
  std::string whole{};  // a port that needs all of the picture, "Edges.color"; "" if none does
  std::string why{};    // what makes it so
};

// Of the output and the kept values, over all passes on the way to them: the sum of the inputs'
// halos. The whole picture is needed by an input that states no halo; by one from which something
// of a size of its own is made (a mean luminance; a shadow map, if it is made per view); by one
// whose halo adds up, as it lies on a circle that a history input closes; and by a picture that is
// made once for all views.
Reach reachOf(const Plan& plan);

}  // namespace lucerna::graph

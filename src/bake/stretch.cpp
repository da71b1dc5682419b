#include "bake/stretch.hpp"

namespace lucerna::bake {

Stretch stretchOf(const std::array<glm::dvec3, 3>& inSpace, const std::array<glm::dvec2, 3>& flat) {
  const glm::dvec3 ab = inSpace[1] - inSpace[0], ac = inSpace[2] - inSpace[0];
  const double length = glm::length(ab), height = glm::length(glm::cross(ab, ac)) / length;
  // Images of two unit vectors of the triangle's plane: along ab, and at a right angle to it.
  const glm::dvec2 x = (flat[1] - flat[0]) / length;
  const glm::dvec2 y = (flat[2] - flat[0] - x * (glm::dot(ab, ac) / length)) / height;
  // The map is a turn and scaling plus a mirrored one; where they agree it grows most.
  const double turn = glm::length(glm::dvec2(x.x + y.y, x.y - y.x)) / 2,
               mirror = glm::length(glm::dvec2(x.x - y.y, x.y + y.x)) / 2;
  return {.most = turn + mirror, .least = turn - mirror};
}

}  // namespace lucerna::bake

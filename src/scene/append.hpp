// One scene put into another.
#pragma once

#include <optional>

#include "scene/scene.hpp"

namespace lucerna::scene {

// Adds everything of `part` below a new node at `place`. The ambient light of both adds up; the
// background and exposure of `part` count only where the scene was empty, its bake hints only where
// it has none. `materials`: where those of `part` stand in the scene already, which then adds none.
void append(Scene& scene, Scene part, const Node& place,
            std::optional<std::size_t> materials = std::nullopt);

// Moves the meshes and textures of `scene` to the end of these lists, which its indices then mean.
void moveShared(Scene& scene, std::vector<Mesh>& meshes, std::vector<Texture>& textures);

// What another copy of the scene takes, meshes and textures aside.
std::uint64_t bytesOf(const Scene& scene);

}  // namespace lucerna::scene

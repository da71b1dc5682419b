// Short ways to fill a Scene while a built-in scene is put together.
#pragma once

#include <memory>
#include <string>

#include "scene/builtin/mesh_builder.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene::builtin {

mat4 translated(vec3 offset);
mat4 turnedY(float angle);  // rad, counter-clockwise seen from above

// The rotation that makes -z look along `direction`, upright where that is possible.
quat lookAlong(vec3 direction);

std::uint32_t addMesh(Scene& scene, Mesh mesh);
std::uint32_t addTexture(Scene& scene, std::string name, std::shared_ptr<const Image> image);
std::uint32_t addCubeMap(Scene& scene, std::string name,
                         std::vector<std::shared_ptr<const Image>> faces);
std::uint32_t addMaterial(Scene& scene, Material material);

// A dielectric metallic-roughness material.
Material matte(std::string name, vec3 albedo, float roughness);
// The same with a texture (sRGB) for its albedo.
Material textured(std::string name, std::uint32_t texture, float roughness);
TextureSlot slot(std::uint32_t texture);

// A node under `parent` (may be kNone) and an object on it; returns the node.
std::uint32_t addObject(Scene& scene, std::uint32_t parent, std::uint32_t mesh,
                        std::uint32_t material, vec3 translation = vec3(0.f), float angleY = 0.f,
                        vec3 scale = vec3(1.f));
// Nothing if the builder is empty.
void addMeshObject(Scene& scene, std::uint32_t parent, MeshBuilder& builder, std::string name,
                   std::uint32_t material);

void addCamera(Scene& scene, std::uint32_t parent, std::string name, vec3 position, vec3 target,
               float fovYDegrees);

}  // namespace lucerna::scene::builtin

// A scene as plain data: what files are read into and what the renderer, the reference and the
// baker read. Metres, seconds, right-handed, y up, radians; colours linear. No GL.
//
// Everything refers to everything by index into the vectors of Scene; kNone means absent.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/math/bounds.hpp"
#include "core/result.hpp"
#include "image/image.hpp"
#include "scene/bake_hints.hpp"
#include "scene/deform.hpp"
#include "scene/light.hpp"
#include "scene/material.hpp"

namespace lucerna::scene {

// Indexed triangles, or else lines or points, in object space. Streams are empty or as long as
// positions.
struct Mesh {
  std::string name;
  std::vector<vec3> positions;
  std::vector<vec3> normals;   // unit; makeNormals() fills them where a file has none
  std::vector<vec4> tangents;  // xyz unit, w = handedness +-1
  std::array<std::vector<vec2>, 2> texCoords;  // (0, 0) is the top left texel's corner, as in glTF
  std::vector<u8vec4> colors;                  // linear unorm, multiplies albedo
  // Where baked light lies: u and v of 0 to 1 as texCoords, and the map's index; -1: nowhere.
  std::vector<vec3> lightmap;
  std::vector<std::uint32_t> indices;  // three a triangle, counter-clockwise seen from the front
  // What a mesh without triangles is made of: drawn one pixel of the rendering wide and, where it
  // has no normals, unlit. It is no surface: it throws no shadow and stops no ray.
  std::vector<std::uint32_t> lines;   // two a line
  std::vector<std::uint32_t> points;  // one a point
  Aabb bounds;                        // of the positions that the elements use

  // What bends it; the streams above are its rest pose.
  std::vector<MorphTarget> targets;
  Influences influences;
  bool flat = false;          // each triangle has its own vertices, and its own normal when bent
  std::uint32_t version = 0;  // raised when its vertices change

  std::size_t triangleCount() const { return indices.size() / 3; }
  // Whichever of the three it is made of.
  const std::vector<std::uint32_t>& elements() const {
    return !lines.empty() ? lines : !points.empty() ? points : indices;
  }
};

struct Node {
  std::string name;
  std::uint32_t parent = kNone;  // parents stand before their children in Scene::nodes
  vec3 translation{0.f};
  quat rotation{1.f, 0.f, 0.f, 0.f};
  vec3 scale{1.f};
  std::vector<float> weights;  // of its meshes' morph targets; absent: 0
  // If the file gave a matrix that translation, rotation and scale cannot express (shear).
  std::optional<mat4> matrix;
  mat4 worldFromNode{1.f};  // kept by updateTransforms()

  mat4 parentFromNode() const;
};

// One mesh drawn with one material where its node stands.
struct Object {
  std::uint32_t node = kNone, mesh = kNone, material = kNone;
  Aabb boundsW;  // kept by updateTransforms()
  std::uint32_t skin = kNone;
  std::uint32_t morphNode = kNone;  // whose weights its mesh's targets take; kNone: its node
};

struct Camera {
  std::string name;
  bool orthographic = false;
  float fovY = 0.9f;            // rad, full vertical angle
  float height = 2.f;           // m, full height of an orthographic view
  float aspect = 0.f;           // width / height; 0: that of the output
  float near = 0.f, far = 0.f;  // m; 0: chosen from the scene's size (far: infinity is allowed)
  std::uint32_t node = kNone;   // looks along -z, +y up
};

enum class Wrap { Repeat, MirroredRepeat, ClampToEdge };

struct Texture {
  std::string name;
  std::shared_ptr<const Image> image;  // never null: a missing file is a checkerboard stand-in
  // A cube map's six pictures, +x -x +y -y +z -z, each what a camera at the origin sees along that
  // axis, upright (up and down by tilting the head from -z): squares of one size and kind, `image`
  // the first. Else empty.
  std::vector<std::shared_ptr<const Image>> faces{};
  bool isCube() const { return !faces.empty(); }
  Wrap wrapS = Wrap::Repeat, wrapT = Wrap::Repeat;
  bool nearest = false;  // magnification without filtering
};

enum class AnimationPath { Translation, Rotation, Scale, Weights };
enum class Interpolation { Step, Linear, CubicSpline };

struct AnimationChannel {
  std::uint32_t node = kNone;
  AnimationPath path = AnimationPath::Translation;
  Interpolation interpolation = Interpolation::Linear;
  std::vector<float> times;  // s, rising
  // One a key (three for CubicSpline); rotation as x, y, z, w. Of weights: see below.
  std::vector<vec4> values;
  // One a key (three for CubicSpline) and morph target, the targets of a key together.
  std::vector<float> weights = {};
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
  bool playing = true;
  float duration() const;  // s; it repeats
};

enum class BackgroundKind { Color, Image, CubeMap };

struct Background {
  BackgroundKind kind = BackgroundKind::Color;
  vec3 color{0.035f, 0.045f, 0.06f};  // linear radiance; the documented default, not black
  float intensity = 1.f;              // of the image or cube map
  std::uint32_t texture = kNone;      // Image: stretched over the output; CubeMap: a cube map
};

struct Scene {
  std::string name;  // for messages and `lucerna info`
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Node> nodes;
  std::vector<Object> objects;
  std::vector<Skin> skins;
  std::vector<Deformation> deformations;  // made by complete()
  std::vector<Light> lights;
  // Of lights: the one that complete() added. It goes with the camera that is looked through.
  std::uint32_t headlight = kNone;
  std::vector<Camera> cameras;
  std::vector<Animation> animations;  // those that play do so at once; of each file the first does
  Background background;
  vec3 ambient{0.f};     // radiance-like: a white surface shows it (IA of the Phong model)
  float exposure = 0.f;  // EV: linear colours are multiplied by 2^exposure before tone mapping
  BakeHints bake;
  // What was repaired or left out while loading, one sentence each.
  std::vector<std::string> warnings;

  Aabb boundsW() const;               // of the objects that are within reach (scene/extent.hpp)
  std::size_t triangleCount() const;  // as drawn: meshes count once per object
};

// World matrices, bent meshes and object boxes from the nodes' local transforms and weights.
void updateTransforms(Scene& scene);
// Sets the nodes' transforms and weights to time t (s) of the animations that play, then
// updateTransforms().
// Returns the indices of objects whose world matrix or mesh changed.
std::vector<std::uint32_t> animate(Scene& scene, float time);

// Lets one animation play and no other: a name, an index, or "none". ErrorKind::Usage says what
// there is to choose from, and changes nothing.
Status chooseAnimation(Scene& scene, const std::string& choice);

// The lights that are on, where they stand.
std::vector<PlacedLight> placeLights(const Scene& scene);

// What a viewer expects where a file is silent: normals, tangents where a normal map needs them, a
// headlight-like directional light with some ambient if there is neither light nor ambient light, a
// camera that fits the scene if there is none. Called once by loadScene().
void complete(Scene& scene);
void makeNormals(Mesh& mesh);  // area-weighted over equal positions that share a vertex
void makeTangents(Mesh& mesh, int texCoord);

std::uint32_t addNode(Scene& scene, Node node);
// Adds a node with the given world placement and no parent.
std::uint32_t addNode(Scene& scene, std::string name, const mat4& worldFromNode);
// Sets translation, rotation and scale from a matrix, or `matrix` itself where they cannot give it.
void setLocalTransform(Node& node, const mat4& parentFromNode);

}  // namespace lucerna::scene

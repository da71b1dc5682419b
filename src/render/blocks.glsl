// The blocks that C++ fills and shaders read. Compiled by both: by GLSL as it stands, by C++ through
// render/blocks.hpp, which lends it the vector types and checks the sizes. Every member is a multiple
// of 16 bytes, so std140, std430 and C++ agree.

// Uniform block ViewBlock (render/view.glsl).
struct ViewValues {
  mat4 viewFromWorld;
  mat4 worldFromView;
  mat4 clipFromView;   // reversed depth, clip z in [0, w]
  mat4 viewFromClip;   // inverted in double precision
  vec4 eyeW;           // perspective: (position, 1); orthographic: (unit vector towards the eye, 0)
  vec4 size;           // of the whole picture: width, height in pixels; 1 / width, 1 / height
  vec4 window;         // of what is drawn of it: its lower left corner, width, height in pixels
  vec4 viewportFromClip;  // xy: factors, zw: shifts (times w) that put the viewport's part in [-w, w]
  vec4 clipPlaneW;     // gl_ClipDistance[0] of (p, 1), in m; (0, 0, 0, 1): nothing is cut
};

// Element of the storage block ShadowViewBlock (render/shadow_views.glsl).
struct ShadowViewValues {
  ViewValues eye;
  vec4 depthPlaneW;    // of directional lights: the depth that the map holds
  uvec4 place;         // layer
};

// How one material slot reads its texture.
struct TextureUse {
  vec4 matrix;         // columns of the 2x2 matrix on uv
  vec4 offset;         // xy: added to it; z: texture coordinate set, 0 or 1; w: 1 if the slot is used
};

// The planes of generated texture coordinates (render/texture_environment.glsl).
struct TextureGeneration {
  vec4 planeS;
  vec4 planeT;
};

// Uniform block MaterialBlock (render/scene.glsl).
struct MaterialValues {
  vec4 albedo;         // linear; a: opacity
  vec4 emissive;       // rgb: linear radiance; w: normal map scale
  vec4 transmission;   // rgb: colour let through; w: alpha cutoff
  vec4 specular;       // rgb: specular, linear; w: Phong exponent
  vec4 surface;        // metallic, roughness, occlusion strength, type of its model (render/surface.glsl)
  TextureUse albedoUse;
  TextureUse emissiveUse;
  TextureUse normalUse;
  TextureUse metallicRoughnessUse;
  TextureUse occlusionUse;
  TextureUse specularUse;
  vec4 codes;          // 1: has a shader of its own; of texture_environment.glsl: combine, coordinates of the
                       // albedo and of the emissive texture
  vec4 blendColor;     // rgb: linear, of the blend combine
  TextureGeneration albedoGeneration;
  TextureGeneration emissiveGeneration;
  vec4 unused[9];     // to the alignment of blocks, twice 256 bytes
};

// Element of the storage block ObjectBlock (render/scene.glsl).
struct ObjectValues {
  mat4 worldFromObject;
  vec4 normalMatrix0;  // columns of the matrix on normals (to be normalised after);
  vec4 normalMatrix1;
  vec4 normalMatrix2;
  uvec4 info;          // x: 1 if the matrix flips orientation
};

// Element of the storage block LightBlock (render/lights.glsl); world space.
struct LightValues {
  vec4 position;       // (position, 1), or (direction towards the light, 0) of a directional one
  vec4 axis;           // xyz: unit, from the light into the scene; w: exponent of the cone
  vec4 intensity;      // rgb; w: 1 / reach in 1/m, 0 if it reaches everywhere
  vec4 attenuation;    // constant, linear, quadratic; w: cosine of the outer cone, -2 without cone
  vec4 shape;          // 1 / (cosine of inner - outer cone), radius in m, angle in rad, unused
};

// Element of the storage block ShadowMapBlock (render/shadows.glsl).
struct ShadowMapValues {
  mat4 clipFromWorld;
  vec4 texel;          // xy: m of a texel at clip-space w of 1; z: 1 / texels of the map's side; w: shear
  vec4 axisW;          // xyz: unit, towards the light along the map's depth; w: depth's range in m, 0: lamps
  vec4 depthPlaneW;    // of directional lights: the depth that the map holds
  vec4 inner;          // x: part of the map, from its middle, that it is made for; of lamps yz: a map's depth d
                       // is at y / (d + z) m along its axis
  vec4 square;         // in its layer, in parts of the layer's side: xy: lower left corner; z: side
  uvec4 place;         // layer; 1: of the lamps' texture; 1: sees translucent surfaces
};

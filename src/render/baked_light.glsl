// Baked light of the surface that is drawn (render/lightmaps.hpp). Goes with BAKED_LIGHT of render/object.vert.
uniform sampler2DArray lightmaps;

layout(location = 6) in vec3 lightmapCoords;  // u, v and the map, the same at a triangle's corners; -1: none

// Irradiance. What has no place in the maps has none, and the back of a surface, for which nothing was baked.
vec3 bakedIrradianceHere() {
  if (lightmapCoords.z < -0.5 || !gl_FrontFacing) return vec3(0.0);
  return textureLod(lightmaps, vec3(lightmapCoords.xy, round(lightmapCoords.z)), 0.0).rgb;
}

// System A's ambient occlusion: of points around the surface, the share that something on the screen is
// in front of.
#include "passes/screen_space_ao/surroundings.glsl"

uniform vec4 offsets[64];  // in the unit hemisphere around +z

layout(location = 0) out float visibility;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 p = positionVAt(pixel, texelFetch(depth, pixel, 0).r);
  vec3 n = normalVAt(pixel);
  // A frame around n, turned from pixel to pixel.
  vec4 turn = rotationAt(pixel);
  vec3 across = normalize(abs(n.z) < 0.9 ? vec3(-n.y, n.x, 0.0) : vec3(0.0, -n.z, n.y));
  vec3 along = cross(n, across);
  vec3 x = across * turn.x + along * turn.y;
  vec3 y = cross(n, x);
  float above = nearestAbove(p);
  float scale = min(radius, reach / pixelsPerMetre(p));
  ivec2 last = textureSize(depth, 0) - 1;

  float hidden = 0.0;
  for (int i = 0; i < sampleCount; ++i) {
    vec3 o = offsets[i].xyz * scale;
    vec3 q = p + x * o.x + y * o.y + n * o.z;
    vec4 clip = view.clipFromView * vec4(q, 1.0);
    vec2 uv = 0.5 + 0.5 * clip.xy / clip.w;
    ivec2 there = ivec2(floor(uv * view.size.xy - view.window.xy));
    if (clip.w <= 0.0 || any(lessThan(there, ivec2(0))) || any(greaterThan(there, last))) continue;
    float found = texelFetch(depth, there, 0).r;
    if (found == 0.0 || found * clip.w <= clip.z) continue;  // nothing, or behind the point
    vec3 occluder = positionVAt(there, found);
    // Not of the plane itself, and not so far in front that it is another thing.
    if (dot(occluder - p, n) < above) continue;
    hidden += 1.0 - smoothstep(0.75, 1.25, abs(occluder.z - p.z) / radius);
  }
  visibility = 1.0 - hidden / float(sampleCount);
}

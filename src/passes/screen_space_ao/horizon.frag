// Ambient visibility between horizons: Jimenez et al., "Practical Realtime Strategies for Accurate Indirect
// Occlusion", 2016, section 4. The hemisphere is cut into slices that hold the line to the eye; in each, the
// two horizons are the highest surfaces within the radius, and the cosine-weighted sky between them is known
// in closed form.
#include "passes/screen_space_ao/surroundings.glsl"

layout(location = 0) out float visibility;

const float kHalfPi = 1.57079632679;

// Cosine-weighted share between the line to the eye and a horizon at angle h, for a normal at angle n.
float sky(float h, float n) { return 0.25 * (-cos(2.0 * h - n) + cos(n) + 2.0 * h * sin(n)); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 p = positionVAt(pixel, texelFetch(depth, pixel, 0).r);
  vec3 n = normalVAt(pixel);
  vec3 toEye = view.eyeW.w == 1.0 ? normalize(-p) : vec3(0.0, 0.0, 1.0);
  float above = nearestAbove(p);
  float pixels = min(radius * pixelsPerMetre(p), reach);
  ivec2 last = textureSize(depth, 0) - 1;
  float turn = rotationAt(pixel).z;
  ivec2 inPicture = pixel + ivec2(view.window.xy);
  float jitter = (float((inPicture.x * 5 + inPicture.y * 3) & 3) + 0.5) / 4.0;

  int slices = max(sampleCount / 12, 1);
  int steps = max(sampleCount / (2 * slices), 1);
  float seen = 0.0, free = 0.0;
  for (int slice = 0; slice < slices; ++slice) {
    float angle = 2.0 * kHalfPi * (float(slice) + turn) / float(slices);
    vec2 direction = vec2(cos(angle), sin(angle));
    // The slice: the plane through the eye and this direction on the screen.
    vec3 aside = vec3(direction, 0.0) - toEye * dot(vec3(direction, 0.0), toEye);
    float asideLength = length(aside);
    if (asideLength < 1e-4) continue;
    aside /= asideLength;
    vec3 axis = cross(aside, toEye);
    vec3 inSlice = n - axis * dot(n, axis);
    float weight = length(inSlice);
    if (weight < 1e-4) continue;
    float angleN = sign(dot(inSlice, aside)) * acos(clamp(dot(inSlice, toEye) / weight, -1.0, 1.0));

    vec2 horizons = vec2(angleN - kHalfPi, angleN + kHalfPi);  // where nothing is in the way
    for (int side = 0; side < 2; ++side) {
      float way = side == 0 ? -1.0 : 1.0;
      float highest = cos(horizons[side]);
      for (int i = 0; i < steps; ++i) {
        float share = (float(i) + jitter) / float(steps);
        vec2 offset = direction * (way * max(share * share * pixels, float(i) + 1.0));
        ivec2 there = pixel + ivec2(round(offset));
        if (any(lessThan(there, ivec2(0))) || any(greaterThan(there, last))) break;
        float found = texelFetch(depth, there, 0).r;
        if (found == 0.0) continue;
        vec3 d = positionVAt(there, found) - p;
        float squared = dot(d, d);
        if (squared > radius * radius || dot(d, n) < above) continue;
        highest = max(highest, dot(d, toEye) * inversesqrt(squared));
      }
      float h = acos(clamp(highest, -1.0, 1.0));
      horizons[side] = side == 0 ? max(-h, horizons[0]) : min(h, horizons[1]);
    }
    seen += weight * (sky(horizons.x, angleN) + sky(horizons.y, angleN));
    free += weight * (cos(angleN) + angleN * sin(angleN));
  }
  visibility = free > 0.0 ? clamp(seen / free, 0.0, 1.0) : 1.0;
}

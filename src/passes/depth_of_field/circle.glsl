// The circle of confusion: the disc of the picture over which a thin lens spreads a point's light.

uniform vec4 lens;  // px: factor and summand of reversed depth, the radius at infinity, the largest

const float kSharp = 0.5;  // px: such a circle lies within its pixel

// What is brighter than halves can say is stored as infinity: no weight would take that away again.
vec3 finite(vec3 color) { return min(color, vec3(65504.0)); }

// Its radius in px, negative before the plane in focus.
float circleAt(float reversedDepth) {
  float radius = reversedDepth == 0.0 ? lens.z : lens.x * reversedDepth + lens.y;
  return clamp(radius, -lens.w, lens.w);
}

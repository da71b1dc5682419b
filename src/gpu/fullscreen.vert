// One triangle that covers the viewport, drawn by Rendering::fullscreen() without vertex data.
// It lies at depth 0, the far plane of reversed depth: with a GreaterEqual depth test it fills
// only what nothing else has covered.

// (0, 0) is the bottom left corner of the viewport, (1, 1) the top right one: the same orientation
// as the texels of a render target.
layout(location = 0) out vec2 uv;

void main() {
  vec2 corner = vec2(float((gl_VertexID & 1) << 1), float(gl_VertexID & 2));
  uv = corner;
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}

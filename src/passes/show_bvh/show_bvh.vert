// The twelve edges of one box an instance, two vertices an edge.
#include "render/view.glsl"

layout(location = 0) in vec3 boxMin;
layout(location = 1) in vec3 boxMax;

void main() {
  int edge = gl_VertexID >> 1;
  int axis = edge >> 2;                 // four edges run along each axis
  ivec3 corner;
  corner[axis] = gl_VertexID & 1;
  corner[(axis + 1) % 3] = edge & 1;
  corner[(axis + 2) % 3] = (edge >> 1) & 1;
  vec3 positionW = mix(boxMin, boxMax, vec3(corner));
  gl_Position = windowPosition(view.viewFromWorld * vec4(positionW, 1.0));
}

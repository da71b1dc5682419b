// The scene's objects and materials.
#include "render/blocks.glsl"

layout(std430) readonly buffer ObjectBlock { ObjectValues objects[]; };
// The material of the batch being drawn. A uniform block, not an element of a storage block: llvmpipe
// masks loads from storage blocks, so pixels beside a triangle's edge would read zeros and texture
// derivatives would be wrong along every edge.
layout(std140) uniform MaterialBlock { MaterialValues material; };

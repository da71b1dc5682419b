// The scene's objects and materials.
#include "render/blocks.glsl"

layout(std430) readonly buffer ObjectBlock { ObjectValues objects[]; };
layout(std430) readonly buffer MaterialBlock { MaterialValues materials[]; };

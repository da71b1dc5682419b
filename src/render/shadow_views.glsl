// The views of shadow maps, for draws whose instances each have their own.
//   SHADOW_VIEWS  `view` of render/view.glsl is one of these: the shader has declared its viewIndex before
#include "render/blocks.glsl"

#ifdef SHADOW_VIEWS
layout(std430) readonly buffer ShadowViewBlock { ShadowViewValues shadowViews[]; };
#define view shadowViews[viewIndex].eye
#endif

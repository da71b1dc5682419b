// Where the colours that translucent surfaces give to each light lie (render/layered_shadows.hpp).

layout(std430) readonly buffer PaneSlotBlock { int paneSlots[]; };  // or one of these:

const int kNoPanes = -1;      // none are in the light's way
const int kPanesInMaps = -2;  // some may be, and only the maps say it

// The entry point of vignette.so: `lucerna render ... --plugin vignette.so`.
#include "graph/plugin.hpp"
#include "vignette.hpp"

LUCERNA_PLUGIN(plugin) {
  plugin.addShaders(Vignette::shaders());
  plugin.add<Vignette>();
}

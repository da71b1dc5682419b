#include "app/bench/suite.hpp"
namespace lucerna::app::bench {
Suite softShadowsQualitySuite() {
  return softShadowsSuite();
}
}  // namespace lucerna::app::bench

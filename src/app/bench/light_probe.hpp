// Each light's visibility as methods of shadows show it (shadow_methods.hpp).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/bench/suite.hpp"
#include "image/image.hpp"

namespace lucerna::app::bench {

// By method, of each light that is on, as scene::placeLights() lists them: F32, one channel.
using Visibilities = std::map<std::string, std::vector<Image>>;

// Draws a run's variants, whose first is `unshadowed` and whose outputs are linear, with lights
// changed so that pictures tell them apart. A light's visibility is its picture as a share of that
// without shadows. The run outlives it; the scene has its lights back in the end.
class LightProbe {
 public:
  // unshadowed: the variant's name begins so.
  LightProbe(Run& run, std::string unshadowed);
  ~LightProbe();
  LightProbe(const LightProbe&) = delete;
  LightProbe& operator=(const LightProbe&) = delete;

  // With all lights on. lit: of each, where it arrives without shadows: U8, 0 where it does not.
  Result<Visibilities> together(std::vector<Image>& lit) const;
  // With one on at a time, of the methods that are wanted.
  Result<Visibilities> alone(const std::function<bool(const std::string& method)>& wanted) const;

 private:
  void shine(std::size_t first, std::size_t count, float others) const;
  Status draw(std::size_t count, const std::function<bool(const Name& name)>& wanted,
              Visibilities& visible, std::vector<Image>& lit) const;

  Run& run_;
  std::string unshadowed_;
  vec3 ambient_;
  std::vector<scene::Light> lights_;
  std::vector<std::size_t> on_;  // of them
  std::size_t atOnce_ = 3;
};

}  // namespace lucerna::app::bench

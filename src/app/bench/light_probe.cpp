#include "app/bench/light_probe.hpp"

#include <algorithm>
#include <utility>

namespace lucerna::app::bench {
namespace {

// Pictures tell lights apart by their colours: three shine at once, red, green and blue, or one
// white one where translucent surfaces tint the light; all others so little that half floats do not
// see it, but they throw shadows.
constexpr float kDim = 1e-6f;
// Radiance below which half floats have too few digits.
constexpr float kFaint = 1e-3f;

Image litIn(const Image& linear, std::size_t channel) {
  Image mask(linear.width(), linear.height(), 1, ComponentType::U8);
  const auto values = linear.as<float>();
  const auto out = mask.as<std::uint8_t>();
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = values[3 * i + channel] > kFaint ? 255 : 0;
  return mask;
}

// Mean over the channels from `first` to before `end`.
Image shareOf(const Image& shadowed, const Image& unshadowed, std::size_t first, std::size_t end) {
  Image result(shadowed.width(), shadowed.height(), 1, ComponentType::F32);
  const auto part = shadowed.as<float>(), whole = unshadowed.as<float>();
  const auto out = result.as<float>();
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t at = 3 * i + first; at < 3 * i + end; ++at)
      if (whole[at] > 0.f)
        out[i] += std::min(part[at] / whole[at], 1.f) / static_cast<float>(end - first);
  return result;
}

}  // namespace

LightProbe::LightProbe(Run& run, std::string unshadowed)
    : run_(run),
      unshadowed_(std::move(unshadowed)),
      ambient_(run.stage.scene().ambient),
      lights_(run.stage.scene().lights) {
  const scene::Scene& scene = run.stage.scene();
  for (std::size_t i = 0; i < lights_.size(); ++i)
    if (lights_[i].on) on_.push_back(i);
  for (const scene::Object& object : scene.objects)
    if (scene.materials[object.material].alphaMode == scene::AlphaMode::Blend) atOnce_ = 1;
}

LightProbe::~LightProbe() {
  run_.stage.relight([&](scene::Scene& scene) {
    scene.ambient = ambient_;
    scene.lights = lights_;
  });
}

Result<Visibilities> LightProbe::together(std::vector<Image>& lit) const {
  Visibilities visible;
  lit.clear();
  for (std::size_t first = 0; first < on_.size(); first += atOnce_) {
    shine(first, atOnce_, kDim);
    const std::size_t count = std::min(atOnce_, on_.size() - first);
    LUCERNA_TRY_VOID(draw(count, [](const Name&) { return true; }, visible, lit));
  }
  return visible;
}

Result<Visibilities> LightProbe::alone(
    const std::function<bool(const std::string& method)>& wanted) const {
  Visibilities visible;
  std::vector<Image> lit;
  for (std::size_t i = 0; i < on_.size(); ++i) {
    shine(i, 1, 0.f);
    LUCERNA_TRY_VOID(draw(
        1, [&](const Name& name) { return name[0] == unshadowed_ || wanted(name[0]); }, visible,
        lit));
  }
  return visible;
}

// Those of on_ that shine; one alone is white. Others that are black are off.
void LightProbe::shine(std::size_t first, std::size_t count, float others) const {
  run_.stage.relight([&](scene::Scene& scene) {
    scene.ambient = vec3(0);
    scene.lights = lights_;
    for (std::size_t i = 0; i < on_.size(); ++i) {
      scene::Light& light = scene.lights[on_[i]];
      const bool shines = i >= first && i < first + count;
      light.color = vec3(shines && count == 1 ? 1.f : others);
      if (shines && count > 1) light.color[static_cast<int>(i - first)] = 1.f;
      light.ambientIntensity = 0;
      light.on = light.color != vec3(0);
    }
  });
}

Status LightProbe::draw(std::size_t count, const std::function<bool(const Name& name)>& wanted,
                        Visibilities& visible, std::vector<Image>& lit) const {
  Image unshadowed;
  return run_.drawEach(wanted, [&](const Name& name, const Image& picture) {
    const Image linear = converted(picture, ComponentType::F32, 3);
    const bool open = name[0] == unshadowed_;
    if (open) unshadowed = linear;
    for (std::size_t light = 0; light < count; ++light) {
      const std::size_t end = atOnce_ == 1 ? 3 : light + 1;  // its channels
      if (open)
        lit.push_back(litIn(linear, light));
      else
        visible[name[0]].push_back(shareOf(linear, unshadowed, light, end));
    }
  });
}

}  // namespace lucerna::app::bench

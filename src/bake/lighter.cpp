#include "bake/lighter.hpp"

#include <algorithm>
#include <cmath>

#include "bake/brightness.hpp"
#include "bake/light_points.hpp"
#include "bake/light_set.hpp"

namespace lucerna::bake {
namespace {

using scene::PlacedLight;

// Calls what(first, end) for each texel's range of samples.
template <typename What>
void forTexels(const Samples& samples, const What& what) {
  for (std::size_t i = 0; i < samples.size();) {
    const std::size_t first = i;
    while (i < samples.size() && samples.texels[i] == samples.texels[first]) ++i;
    what(first, i);
  }
}

}  // namespace

int Lighter::pointsOf(const PlacedLight& light) const {
  if (!hasSize(light)) return 1;
  return isOfSky(light) ? settings_.skyPoints : settings_.lightSamples;
}

void Lighter::addMeans(const Samples& samples, std::vector<vec3>& texels) const {
  forTexels(samples, [&](std::size_t first, std::size_t end) {
    vec3 sum(0.f);
    for (std::size_t i = first; i < end; ++i) sum += sums_[i];
    texels[samples.texels[first]] += sum / static_cast<float>(end - first);
  });
}

void Lighter::findUneven(const Samples& samples, std::uint32_t light,
                         std::vector<UnevenTexel>& uneven, std::vector<vec3>& texels) {
  forTexels(samples, [&](std::size_t first, std::size_t end) {
    const auto count = static_cast<float>(end - first);
    vec3 mean(0.f);
    for (std::size_t i = first; i < end; ++i) mean += sums_[i] / count;
    const std::uint16_t texel = samples.texels[first];
    texels[texel] += mean;
    float squares = 0.f;
    for (std::size_t i = first; i < end; ++i) {
      const float off = brightness(sums_[i]) - brightness(mean);
      squares += off * off / count;
    }
    const float deviation = std::sqrt(squares);
    if (deviation > settings_.uneven * brightness(mean))
      uneven.push_back(
          {.light = light, .texel = texel, .irradiance = mean, .deviation = deviation});
  });
  sums_.assign(samples.size(), vec3(0.f));
}

void Lighter::dropEven(std::span<const vec3> texels, std::vector<UnevenTexel>& uneven) const {
  constexpr float kFaint = 0.01f;  // of the brightest: no texel counts as less
  float most = 0.f;
  for (const vec3 texel : texels) most = std::max(most, brightness(texel));
  std::erase_if(uneven, [&](const UnevenTexel& u) {
    return u.deviation <= settings_.uneven * std::max(brightness(texels[u.texel]), kFaint * most);
  });
}

void Lighter::relight(const Samples& samples, std::span<const PlacedLight> lights,
                      std::span<const UnevenTexel> uneven, std::vector<vec3>& texels) {
  for (std::size_t i = 0; i < uneven.size();) {
    const std::uint32_t light = uneven[i].light;
    const std::size_t first = i;
    relit_.assign(samples.texelCount, false);
    for (; i < uneven.size() && uneven[i].light == light; ++i) relit_[uneven[i].texel] = true;
    choose(samples, relit_, part_);
    if (part_.size() == 0) continue;
    sums_.assign(part_.size(), vec3(0.f));
    lightAgain(part_, lights, light);
    // A texel of which no finer sample is left keeps what it has.
    for (const std::uint16_t texel : part_.texels) relit_[texel] = false;
    for (const UnevenTexel& u : uneven.subspan(first, i - first))
      if (!relit_[u.texel]) texels[u.texel] -= u.irradiance;
    addMeans(part_, texels);
  }
}

}  // namespace lucerna::bake

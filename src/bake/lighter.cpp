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
  const int points = isOfSky(light) ? settings_.skyPoints : settings_.lightSamples;
  return again_ ? std::max(points / settings_.shared, 1) : points;
}

void Lighter::addMeans(const Samples& samples, std::vector<vec3>& texels) const {
  forTexels(samples, [&](std::size_t first, std::size_t end) {
    vec3 sum(0.f);
    for (std::size_t i = first; i < end; ++i) sum += sums_[i];
    texels[samples.texels[first]] += sum / static_cast<float>(end - first);
  });
}

void Lighter::findUneven(const Samples& samples, std::span<const PlacedLight> lights,
                         std::uint32_t light, Uneven& uneven, std::vector<vec3>& texels) {
  addMeans(samples, texels);
  if (!uneven.around)
    findUnevenPlaces(samples, light, uneven.texels);
  else if (light != UnevenTexel::kEmitters && !isOfSky(lights[light]))
    findEdges(samples, lights, light, uneven);
  sums_.assign(samples.size(), vec3(0.f));
}

// By how much the places of a texel differ.
void Lighter::findUnevenPlaces(const Samples& samples, std::uint32_t light,
                               std::vector<UnevenTexel>& uneven) {
  forTexels(samples, [&](std::size_t first, std::size_t end) {
    const auto count = static_cast<float>(end - first);
    vec3 mean(0.f);
    for (std::size_t i = first; i < end; ++i) mean += sums_[i];
    mean /= count;  // what addMeans() adds
    float squares = 0.f;
    for (std::size_t i = first; i < end; ++i) {
      const float off = brightness(sums_[i]) - brightness(mean);
      squares += off * off / count;
    }
    const float deviation = std::sqrt(squares);
    if (deviation > settings_.uneven * brightness(mean))
      uneven.push_back({.light = light,
                        .texel = samples.texels[first],
                        .irradiance = mean,
                        .deviation = deviation});
  });
}

// By how much a texel's only place differs from the mean of its neighbours, along either side:
// nothing where light changes evenly. Each straight edge through a texel lies between its middle
// and that of one of these four.
void Lighter::findEdges(const Samples& samples, std::span<const PlacedLight> lights,
                        std::uint32_t light, Uneven& uneven) {
  const auto across = static_cast<std::size_t>(samples.across), stride = across + 2;
  const auto placeOf = [&](std::uint16_t texel) {
    return (texel / across + 1) * stride + texel % across + 1;
  };
  grid_.assign((samples.texelCount / across + 2) * stride, -1.f);
  for (std::size_t i = 0; i < samples.size(); ++i)
    grid_[placeOf(samples.texels[i])] = brightness(sums_[i]);
  if (const Samples& around = *uneven.around; around.size() > 0) {
    own_.swap(sums_);
    sums_.assign(around.size(), vec3(0.f));
    lightAgain(around, lights, light);
    for (std::size_t i = 0; i < around.size(); ++i) grid_[around.texels[i]] = brightness(sums_[i]);
    own_.swap(sums_);
  }
  const auto bend = [&](std::size_t at, std::size_t step) {
    const float here = grid_[at], before = grid_[at - step], after = grid_[at + step];
    const float mean = 0.5f * ((before < 0.f ? here : before) + (after < 0.f ? here : after));
    return std::abs(here - mean);
  };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t at = placeOf(samples.texels[i]);
    const float deviation = std::max(bend(at, 1), bend(at, stride));
    if (deviation > settings_.uneven * grid_[at])
      uneven.texels.push_back({.light = light,
                               .texel = samples.texels[i],
                               .irradiance = sums_[i],
                               .deviation = deviation});
  }
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
  again_ = true;
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
  again_ = false;
}

}  // namespace lucerna::bake

#include "bake/lighter.hpp"

#include <algorithm>
#include <limits>

namespace lucerna::bake {

void Lighter::meansOf(const Samples& samples, std::vector<vec3>& texels) const {
  texels.assign(samples.texelCount, vec3(0.f));
  for (std::size_t i = 0; i < samples.size();) {
    const std::size_t begin = i;
    vec3 sum(0.f);
    for (; i < samples.size() && samples.texels[i] == samples.texels[begin]; ++i) sum += sums_[i];
    texels[samples.texels[begin]] = sum / static_cast<float>(i - begin);
  }
}

std::vector<bool> Lighter::unevenTexels(const Samples& samples, float share,
                                        std::size_t texels) const {
  std::vector<bool> uneven(texels, false);
  const auto brightness = [&](std::size_t i) { return sums_[i].x + sums_[i].y + sums_[i].z; };
  float most = 0.f;
  for (std::size_t i = 0; i < samples.size(); ++i) most = std::max(most, brightness(i));
  constexpr float kFaint = 0.01f;  // of the brightest: no texel's mean counts as less
  for (std::size_t i = 0; i < samples.size();) {
    const std::size_t first = i;
    float low = std::numeric_limits<float>::infinity(), high = 0.f, sum = 0.f;
    for (; i < samples.size() && samples.texels[i] == samples.texels[first]; ++i) {
      const float b = brightness(i);
      low = std::min(low, b);
      high = std::max(high, b);
      sum += b;
    }
    const float mean = sum / static_cast<float>(i - first);
    uneven[samples.texels[first]] = high - low > share * std::max(mean, kFaint * most);
  }
  return uneven;
}

}  // namespace lucerna::bake

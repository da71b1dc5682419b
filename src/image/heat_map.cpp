#include <algorithm>
#include <array>
#include <cmath>

#include "image/metrics.hpp"

namespace lucerna {
namespace {

// Stops at even steps of the error. CIE lightness grows by 12 from each to the next; the hue turns
// from blue (298 degrees in CIELab) over red to yellow (102) at nearly the greatest chroma there
// is.
constexpr std::array<std::array<float, 3>, 9> kStops = {{{0, 0, 0},
                                                         {10, 24, 86},
                                                         {66, 32, 141},
                                                         {134, 42, 154},
                                                         {196, 54, 155},
                                                         {247, 85, 137},
                                                         {249, 150, 133},
                                                         {252, 201, 118},
                                                         {255, 246, 173}}};

std::array<std::uint8_t, 3> colourOf(float error) {
  const float at = (error > 0 ? std::min(error, 1.f) : 0.f) * (kStops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const float share = at - static_cast<float>(stop);
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] =
        static_cast<std::uint8_t>(std::lerp(kStops[stop][c], kStops[stop + 1][c], share) + 0.5f);
  return colour;
}

}  // namespace

Image heatMap(const Image& error, const Image* mask) {
  CHECK(error.channels() == 1 && error.type() == ComponentType::F32);
  CHECK(!mask || (mask->width() == error.width() && mask->height() == error.height() &&
                  mask->channels() == 1 && mask->type() == ComponentType::U8));
  Image colours(error.width(), error.height(), 3, ComponentType::U8);
  const auto from = error.as<float>();
  std::uint8_t* to = colours.as<std::uint8_t>().data();
  for (std::size_t i = 0; i < from.size(); ++i) {
    const bool counts = !mask || mask->as<std::uint8_t>()[i] != 0;
    const auto colour =
        counts ? colourOf(from[i]) : std::array{kMaskedGrey, kMaskedGrey, kMaskedGrey};
    to = std::ranges::copy(colour, to).out;
  }
  return colours;
}

}  // namespace lucerna

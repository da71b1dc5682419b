// Powers in single precision written so that compilers turn loops over them into vector code: no
// branches, tables or calls. Relative error below 2e-6 over the ranges of colour metrics (the test
// measures it). The same bits on every machine, as only IEEE operations are used.
#pragma once

#include <bit>
#include <cstdint>

// Compiles a function twice and picks the wider vectors where the machine has them. Both give the
// same bits, because the build keeps products and sums apart. (The sanitizers are not up yet when
// the choice is made.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LUCERNA_WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define LUCERNA_WIDE_VECTORS
#endif

namespace lucerna {

// x > 0 and normal. log2(m 2^e) = e + log2(m) with m in [sqrt(1/2), sqrt(2)), by the series of
// artanh: log(m) = 2 (s + s^3/3 + s^5/5 + ...), s = (m - 1) / (m + 1), |s| <= 0.172.
inline float vectorLog2(float x) {
  constexpr std::int32_t kSqrtHalf = 0x3f3504f3;
  const auto bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - kSqrtHalf) >> 23;
  const float m = std::bit_cast<float>(bits - (exponent << 23));
  const float s = (m - 1) / (m + 1), s2 = s * s;
  const float series = 1 + s2 * (1 / 3.f + s2 * (1 / 5.f + s2 * (1 / 7.f + s2 * (1 / 9.f))));
  return static_cast<float>(exponent) + 2.8853900817779268f * s * series;  // 2 / ln 2
}

// -126 <= x < 127. 2^x = 2^round(x) e^(f ln 2), |f| <= 1/2, by Taylor's series.
inline float vectorExp2(float x) {
  constexpr float kRound = 12582912.f;  // 1.5 * 2^23: adding it leaves no bits after the point
  const float whole = (x + kRound) - kRound;
  const float t = (x - whole) * 0.69314718055994531f;
  const float e =
      1 + t * (1 + t * (1 / 2.f +
                        t * (1 / 6.f + t * (1 / 24.f + t * (1 / 120.f +
                                                            t * (1 / 720.f + t * (1 / 5040.f)))))));
  return e * std::bit_cast<float>((static_cast<std::int32_t>(whole) + 127) << 23);
}

// x >= 0 (below 1e-30 the result is 0), y > 0, y |log2 x| < 126.
inline float vectorPow(float x, float y) {
  const float positive = x > 1e-30f ? x : 1e-30f;
  const float result = vectorExp2(y * vectorLog2(positive));
  return x > 1e-30f ? result : 0.f;
}

}  // namespace lucerna

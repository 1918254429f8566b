#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace keyline::numeric {

/// Seeded random numbers, the same on every platform (xoshiro256++ of
/// [Blackman 2021], state filled by splitmix64). Streams of one seed are independent of one
/// another: give each trial or worker its own and the results do not depend on who runs first.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) {
    std::uint64_t s = mix(seed) ^ mix(stream + 0x632be59bd9b4e019U);
    for (std::uint64_t& word : state_) word = mix(s += 0x9e3779b97f4a7c15U);
  }

  /// 64 uniform bits.
  std::uint64_t bits() {
    const std::uint64_t result = rotate_left(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotate_left(state_[3], 45);
    return result;
  }

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform in {0, …, count - 1}; count >= 1.
  std::size_t index(std::size_t count) {
    const std::uint64_t n = count;
    const std::uint64_t limit = UINT64_MAX - UINT64_MAX % n;
    std::uint64_t x = bits();
    while (x >= limit) x = bits();
    return static_cast<std::size_t>(x % n);
  }

  /// True with the given probability.
  bool chance(double probability) { return uniform() < probability; }

  /// Standard normal (Marsaglia's polar method; equal across platforms up to rounding of log).
  double normal();

 private:
  static std::uint64_t rotate_left(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace keyline::numeric

#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace coop {

/// A named stream of random numbers: the same seed and name give the same numbers on every machine,
/// and one stream's use cannot shift another's. Generator: xoshiro256++ (Blackman, Vigna 2019),
/// seeded by SplitMix64 over seed and a hash of the name. Meets UniformRandomBitGenerator, but the
/// standard library's distributions differ between implementations: use the members.
class RandomStream {
 public:
  using result_type = std::uint64_t;

  RandomStream(std::uint64_t seed, std::string_view name);

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }
  result_type operator()() { return next(); }

  /// In [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In [0, bound), without bias. bound > 0.
  std::uint64_t below(std::uint64_t bound);
  /// Normal deviate of mean 0 and deviation 1 (Marsaglia's polar method).
  double normal();
  double normal(double mean, double stddev) { return mean + stddev * normal(); }

 private:
  result_type next() {
    const result_type result = rotate(state_[0] + state_[3], 23) + state_[0];
    const result_type t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotate(state_[3], 45);
    return result;
  }
  static constexpr result_type rotate(result_type value, int bits) {
    return (value << bits) | (value >> (64 - bits));
  }

  std::array<result_type, 4> state_{};
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace coop

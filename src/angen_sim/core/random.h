#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace angen {

/// 64-bit FNV-1a, the key of a name; also used to hash snapshots.
constexpr std::uint64_t hash_bytes(std::string_view bytes,
                                   std::uint64_t hash = 0xcbf29ce484222325ULL) {
  for (const char c : bytes) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  return hash;
}

/// Random numbers keyed by (seed, name, tick): one sensor's draws do not depend on any other's.
/// SplitMix64 (Steele, Lea and Flood 2014) on a mixed key.
class Rng {
 public:
  Rng(std::uint64_t seed, std::uint64_t name_hash, std::int64_t tick)
      : state_(mix(seed + kGolden) ^ mix(name_hash) ^
               mix(static_cast<std::uint64_t>(tick) * 0xd1342543de82ef95ULL + 1)) {}

  std::uint64_t next() { return mix(state_ += kGolden); }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }  // [0, 1)
  double gaussian();  // mean 0, standard deviation 1

  /// `count` numbers like those of gaussian(). The first uniform() that this takes says how far out
  /// the farthest is: where it is below chance_within(count, limit), all are within ±limit.
  void gaussians(double* numbers, std::size_t count);

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

/// The chance that as many numbers of mean 0 and standard deviation 1 as gaussians() makes are all
/// within ±limit; a hair less, for its rounding.
double chance_within(std::size_t count, double limit);

}  // namespace angen

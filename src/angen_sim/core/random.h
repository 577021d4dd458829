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
  Rng(std::uint64_t seed, std::uint64_t name_hash, std::int64_t tick);

  std::uint64_t next();
  double uniform();   // [0, 1)
  double gaussian();  // mean 0, standard deviation 1

  /// Whether the first `count` gaussian() of a new generator are surely within ±limit; costs less
  /// than drawing them, and leaves no generator to draw from.
  bool gaussians_within(std::size_t count, double limit);

 private:
  std::uint64_t state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace angen

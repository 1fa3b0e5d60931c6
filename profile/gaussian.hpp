// Random numbers by their place in a stream, for noise that does not depend on the number of threads.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace lobelia {

/// Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators": splitmix64's output function.
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Number `index` of a stream, of mean 0 and variance 1 (Box and Muller 1958). Without state, so that the number of
/// threads does not matter.
inline double gaussian(std::uint64_t stream, std::uint64_t index) {
  const std::uint64_t bits = mix(mix(stream) ^ index);
  const double u = (double(bits >> 32) + 0.5) * 0x1p-32, v = double(bits & 0xffffffffu) * 0x1p-32;
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

}  // namespace lobelia

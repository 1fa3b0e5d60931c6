// The samples of a pixel: Sobol's sequence, Owen-scrambled by hashing.
//
// Each pair of dimensions is Sobol's first two, with its own order and scrambling (Burley 2020, "Practical
// hash-based Owen scrambling"; the hash is Laine and Karras' with Vegdahl's constants). So any power of two of a
// pixel's samples is a (0, m, 2)-net in every pair, and pairs and pixels are independent. Sample k of pixel p is a
// function of (seed, p, k), without state: it does not depend on threads or on other samples.
#pragma once

#include <cstdint>

namespace lobelia::sobol {

/// Every bit of the result depends on every bit of x (Wellons 2018, "lowbias32").
constexpr std::uint32_t hash(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

/// Owen's scrambling of a bit-reversed number: a hash of the lower bits flips each bit.
constexpr std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Sobol's second dimension of the index, bit-reversed. Its matrix is Pascal's triangle modulo 2, a product of five
/// steps.
constexpr std::uint32_t second_reversed(std::uint32_t i) {
  i ^= (i & 0xaaaaaaaau) >> 1;
  i ^= (i & 0xccccccccu) >> 2;
  i ^= (i & 0xf0f0f0f0u) >> 4;
  i ^= (i & 0xff00ff00u) >> 8;
  return i ^ (i >> 16);
}

struct Pair {
  double u, v;  ///< each in [0, 1)
};

/// Sample `index` of the pixel whose hash is `pixel`, in the given pair of dimensions.
constexpr Pair pair(std::uint32_t pixel, std::uint32_t index, std::uint32_t dimension) {
  const std::uint32_t seed = hash(pixel ^ hash(dimension + 0x9e3779b9u));
  const std::uint32_t order = reverse_bits(scramble_reversed(reverse_bits(index), seed));
  // The first dimension is the bit-reversed index, so its reversal is the index itself.
  const std::uint32_t x = scramble_reversed(order, hash(seed + 1));
  const std::uint32_t y = scramble_reversed(second_reversed(order), hash(seed + 2));
  return {reverse_bits(x) * 0x1p-32, reverse_bits(y) * 0x1p-32};
}

/// A pixel's hash, from its place in the picture and the scene's seed.
constexpr std::uint32_t pixel_hash(std::uint64_t pixel, std::uint64_t seed) {
  const std::uint32_t high = hash(std::uint32_t(pixel >> 32) ^ hash(std::uint32_t(seed >> 32)));
  return hash(std::uint32_t(pixel) ^ hash(std::uint32_t(seed) ^ high));
}

}  // namespace lobelia::sobol

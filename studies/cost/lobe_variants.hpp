// Every way of computing every lobe, as a function of an array.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/highlight.hpp"
#include "renderer/operation_count.hpp"

namespace lobelia::cost {

/// How many numbers a way takes at a time: its arrays' lengths are multiples of it.
inline constexpr std::size_t kLobeBlock = 16;

struct LobeVariant {
  LobeId lobe;
  std::string method;  ///< "stable", "textbook", "std::pow", "squaring"
  bool wide;           ///< in float64, else in float32
  bool simd;           ///< by registers, else one number after another
  OperationCount operations;
  /// A bound, relative to the peak, of how far it may be from its own lobe: its rounding.
  double allowed;
  bool of_cosine;  ///< sees of s no more than 1 - s rounded to float32
  /// One of the two, by `wide`: values of `count` numbers s in [0, 1].
  std::function<void(std::size_t count, const double* s, double* value)> over64;
  std::function<void(std::size_t count, const float* s, float* value)> over32;

  std::string name() const;  ///< "cs16, stable, float32 SIMD"
};

/// Of all lobes of the catalogue, cosine first; by squaring only where the exponent is a whole number.
std::vector<LobeVariant> lobe_variants(double exponent);

}  // namespace lobelia::cost

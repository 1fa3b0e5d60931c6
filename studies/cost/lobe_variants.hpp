// Every variant of computing every lobe, as a function of an array of s = 1 - cos.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "base/system/timing.hpp"
#include "renderer/highlight.hpp"
#include "renderer/operation_count.hpp"

namespace lobelia::cost {

/// The arrays of all functions here have a multiple of so many numbers.
inline constexpr std::size_t kLobeBlock = 16;

struct LobeVariant {
  LobeId lobe;
  std::string method;  ///< "stable", "textbook", "std::pow", "squaring"
  bool wide;           ///< in float64, else in float32
  bool simd;           ///< by registers, else one number after another
  OperationCount operations;
  /// A bound of its rounding: of the difference from its own lobe, relative to the peak.
  double allowed;
  bool of_cosine;  ///< computes from 1 - s rounded to float32
  /// One of the two, by `wide`: values of `count` numbers s in [0, 1].
  std::function<void(std::size_t count, const double* s, double* value)> over64;
  std::function<void(std::size_t count, const float* s, float* value)> over32;

  std::string name() const;  ///< "cs16, stable, float32 SIMD"
  std::vector<double> values(const std::vector<float>& s) const;
};

/// All lobes of the catalogue, cosine first; squaring only if the exponent is a whole number.
std::vector<LobeVariant> lobe_variants(double exponent);

/// The catalogue's lobe by SIMD registers.
void lobe_lanes(LobeId lobe, double exponent, std::size_t count, const float* s, float* value);
void lobe_lanes(LobeId lobe, double exponent, std::size_t count, const double* s, double* value);

struct TimedLobe {
  LobeId lobe;
  double exponent;
  bool wide;  ///< in float64, else in float32
};
/// Seconds for one value of each lobe by SIMD registers, on one thread, in interleaved rounds, for numbers that the cache
/// holds.
std::vector<Times> value_times(const std::vector<TimedLobe>& lobes);

/// cos^n by binary powering of 1 - s, n a whole number from 1 to 2^31.
void squaring_lanes(unsigned n, std::size_t count, const float* s, float* value);
void squaring_lanes(unsigned n, std::size_t count, const double* s, double* value);

}  // namespace lobelia::cost

// How far a variant of a lobe is from cos^n itself: docs/cost.md, "Lobe", has the definitions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/records/cost.hpp"
#include "studies/cost/lobe_variants.hpp"

namespace lobelia::cost {

/// Beyond this s cos^n is less than e^-16 of its peak, and the paper's lobe, cs16, is 0.
inline double highlight_end(double exponent) { return exponent > 16 ? 16 / exponent : 1; }

/// Errors of one lobe against another over all s: the largest absolute difference and the RMS over s from 0 to
/// highlight_end, each direction alike, relative to the peak 1; and the integral over the hemisphere, 2 pi times that
/// over s, relative to the energy of cos^n.
using LobeErrors = records::LobeErrors;
/// "max", "rms" and "energy", for tables.
std::vector<records::CostError> lobe_error_kinds();

struct LobeVariantErrors {
  LobeErrors all;       ///< of the variant's numbers against cos^n in 113 bits
  LobeErrors shape;     ///< of its lobe in 113 bits against cos^n in 113 bits
  LobeErrors rounding;  ///< of its numbers against its lobe in 113 bits
};

/// The true values of every lobe at one exponent, computed once.
class LobeTruth {
 public:
  explicit LobeTruth(double exponent);
  /// Throws Error(kInternal) if the variant's numbers are farther from its lobe than variant.allowed.
  LobeVariantErrors errors(const LobeVariant& variant) const;
  /// The samples, from 0 to 1.
  const std::vector<float>& s() const { return s_; }

 private:
  void add_samples(double exponent);

  std::vector<float> s_;
  std::vector<double> weight_;  ///< of the integral over s, by midpoints; 0 at single points
  std::size_t core_ = 0;        ///< how many of the first are evenly spaced over the highlight
  double cosine_energy_;        ///< 1 / (n + 1)
  /// Values in two doubles each: their sum has more digits than either.
  struct Value {
    double high, low;
  };
  std::vector<std::vector<Value>> values_;  ///< by place in all_lobes()
  std::vector<double> shape_energy_;        ///< the same: excess over that of cos^n, relative
  std::size_t cosine_;                      ///< its place in all_lobes()
};

struct LargestError {
  double found = 0;  ///< at a number that was evaluated
  double at_most =
      0;  ///< bound for any float32 number s; `found` if all relevant ones were evaluated
  std::uint64_t numbers = 0;  ///< evaluated
};

/// The largest |variant - cos^n| over the float32 numbers s, n at least 2 or 1: searched, not sampled. Evaluates every
/// number at which more than the known `at_least` is possible, by the distance of the lobes and the variant's allowed
/// rounding, but at most about `most_numbers`, spread over all places.
///
/// A variant in float32 gives 1 where n s < 2^-26, or 1 with its allowed rounding, and loses no more than 2^-26 there.
LargestError largest_error(const LobeVariant& variant, double exponent, double at_least,
                           std::uint64_t most_numbers);

/// |d2/ds2 (lobe - cos^n)| of a lobe of the catalogue is at most this, times n^2. GGX falls twice as fast as the others.
double most_bend(const LobeId& lobe);

}  // namespace lobelia::cost

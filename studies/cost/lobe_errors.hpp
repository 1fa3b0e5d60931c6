// How far a variant of a lobe is from cos^n itself: docs/cost.md, "Lobe", has the definitions.
#pragma once

#include <cstddef>
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

}  // namespace lobelia::cost

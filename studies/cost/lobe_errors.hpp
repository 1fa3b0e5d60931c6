// How far a way of computing a lobe is from cos^n itself: docs/cost.md, "Lobe", has the definitions.
#pragma once

#include <cstddef>
#include <vector>

#include "records/cost.hpp"
#include "studies/cost/lobe_variants.hpp"

namespace lobelia::cost {

/// Beyond this s cos^n is less than e^-16 of its peak, and the paper's lobe, cs16, is 0.
inline double highlight_end(double exponent) { return exponent > 16 ? 16 / exponent : 1; }

/// Of one lobe value against another, over all s; relative to the peak 1, or to the energy of cos^n: the largest
/// absolute difference; RMS over s from 0 to highlight_end, each direction alike; the integral over the hemisphere,
/// 2 pi times that over s.
using LobeErrors = records::LobeErrors;
/// "max", "rms" and "energy", of tables.
std::vector<records::CostError> lobe_error_kinds();

struct LobeVariantErrors {
  LobeErrors all;       ///< of the way's numbers against cos^n in 113 bits
  LobeErrors shape;     ///< of its lobe in 113 bits against cos^n in 113 bits
  LobeErrors rounding;  ///< of its numbers against its lobe in 113 bits
};

/// By the truth of every lobe at one exponent, computed once.
class LobeTruth {
 public:
  explicit LobeTruth(double exponent);
  /// Throws Error(kInternal) where the way's numbers are not its lobe's within way.allowed.
  LobeVariantErrors errors(const LobeVariant& way) const;
  /// Where it looks: numbers of float32, from 0 to 1.
  const std::vector<double>& s() const { return s_; }

 private:
  void add_samples(double exponent);

  std::vector<double> s_;
  std::vector<double> weight_;  ///< of the integral over s, by midpoints; 0 at single points
  std::size_t core_ = 0;        ///< how many of the first are evenly spaced over the highlight
  double cosine_energy_;        ///< 1 / (n + 1)
  /// Values in two doubles each, whose sum has more digits than either.
  struct Value {
    double high, low;
  };
  std::vector<std::vector<Value>> values_;  ///< by place in all_lobes()
  std::vector<double> shape_energy_;        ///< the same: excess over that of cos^n, relative
  std::size_t cosine_;                      ///< its place in all_lobes()
};

}  // namespace lobelia::cost

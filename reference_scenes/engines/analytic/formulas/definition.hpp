// The textbook definition of a lobe by its id, for any number type: 50 digits for the truth, long double for a quick
// search, float32 for the naive formula.
#pragma once

#include "renderer/lobes/catalogue.hpp"

namespace lobelia {

/// The lobe at the angle with this cosine, in (0, 1].
template <class Number>
Number lobe_definition(const LobeId& lobe, const Number& cosine, double exponent) {
  using Definition = Number (*)(LobeParameters, const Number&);
  static constexpr auto kDefinitions =
      map_types<Definition>(HWY_NAMESPACE::LobesById{}, []<class L>() -> Definition {
        return [](LobeParameters p, const Number& c) { return L(p).definition(c); };
      });
  return kDefinitions.at(lobe.index)({exponent, lobe}, cosine);
}

/// A lobe is sampled over s with the density lobe times this, over its integral: 1 where the samples follow the lobe
/// itself. Gauss draws its angle as if it were a radius in the plane; Schlick draws from its lobe without the numerator, or
/// below n = 1 every s alike, and GGX from (1 + n s / 2)^-2.
template <class Number>
Number draw_factor(LobeId lobe, const Number& cosine, double exponent) {
  using std::acos, std::sin;
  if (info(lobe).name == "gauss") {
    const Number x = acos(cosine);
    return x > Number(0) ? Number(x / sin(x)) : Number(1);
  }
  if (info(lobe).name == "ggx") {
    const Number s = Number(1) - cosine, n = Number(exponent);
    const Number drawn = Number(1) + n * s / Number(2), own = drawn + n * s * cosine / Number(2);
    return own * own / (drawn * drawn);
  }
  if (info(lobe).name != "schlick") return Number(1);
  return exponent > 1 ? Number(Number(1) / cosine)
                      : Number(Number(1) + Number(exponent) * (Number(1) - cosine) / cosine);
}

}  // namespace lobelia

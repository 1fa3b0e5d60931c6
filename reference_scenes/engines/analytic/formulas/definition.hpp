// The textbook definition of a lobe by its id, for any type of number: the truth in 50 digits, a quick
// search in long double, the naive formula in float32.
#pragma once

#include "renderer/lobes/catalogue.hpp"

namespace lobelia {

/// The lobe by its textbook definition. `cosine` of its angle is in (0, 1].
template <class Number>
Number lobe_definition(LobeId lobe, const Number& cosine, double exponent) {
  using Definition = Number (*)(LobeParameters, const Number&);
  static constexpr auto kDefinitions =
      map_types<Definition>(HWY_NAMESPACE::Lobes{}, []<class L>() -> Definition {
        return [](LobeParameters p, const Number& c) { return L(p).definition(c); };
      });
  return kDefinitions.at(lobe.index)({exponent, lobe.order}, cosine);
}

/// The density of a lobe's draws over s is lobe times this over its integral: 1 where they follow the lobe itself.
/// Gauss's are of x as if it were a plane's radius, Schlick's of a lobe without its numerator.
template <class Number>
Number draw_factor(LobeId lobe, const Number& cosine) {
  using std::acos, std::sin;
  if (info(lobe).name == "gauss") {
    const Number x = acos(cosine);
    return x > Number(0) ? Number(x / sin(x)) : Number(1);
  }
  return info(lobe).name == "schlick" ? Number(Number(1) / cosine) : Number(1);
}

}  // namespace lobelia

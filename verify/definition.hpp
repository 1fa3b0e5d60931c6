// The textbook definition of a lobe by its id, for any type of number: the truth in 50 digits, a quick
// search in long double, the naive formula in float32.
#pragma once

#include "renderer/lobes/catalogue.hpp"

namespace lobelia {

/// Of the cosine of the lobe's angle, in (0, 1].
template <class Number>
Number lobe_definition(LobeId lobe, const Number& cosine, double exponent) {
  using Definition = Number (*)(LobeParameters, const Number&);
  static constexpr auto kDefinitions =
      map_types<Definition>(HWY_NAMESPACE::Lobes{}, []<class L>() -> Definition {
        return [](LobeParameters p, const Number& c) { return L(p).definition(c); };
      });
  return kDefinitions.at(lobe.index)({exponent, lobe.order}, cosine);
}

}  // namespace lobelia

#include "renderer/lobes/catalogue.hpp"
#include "verify/truth/big_lobe.hpp"
#include "verify/truth/truth.hpp"

namespace lobelia::truth {
namespace {

using Definition = Big (*)(LobeParameters, const Big& cosine);
constexpr auto kDefinitions = map_types<Definition>(HWY_NAMESPACE::Lobes{}, []<class L>() {
  return [](LobeParameters p, const Big& cosine) { return L(p).definition(cosine); };
});

}  // namespace

Big lobe_of_cosine(LobeId lobe, const Big& cosine, double exponent) {
  if (cosine <= 0) return 0;
  // The cosine of two equal directions may come out a last digit above 1.
  return kDefinitions.at(lobe.index)({exponent, lobe.order}, cosine < 1 ? cosine : Big(1));
}

double lobe(LobeId lobe, double s, double exponent) {
  return double(lobe_of_cosine(lobe, 1 - Big(s), exponent));
}

double one_minus_cos(double angle) {
  const Big sine = sin(Big(angle) / 2);
  return double(2 * sine * sine);
}

}  // namespace lobelia::truth

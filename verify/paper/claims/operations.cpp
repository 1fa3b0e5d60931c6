// What a lobe costs: each formula is computed once with a number that counts its operations.
#include <fmt/format.h>

#include "verify/paper/catalogue.hpp"
#include "verify/paper/search.hpp"

namespace lobelia::paper {
namespace {

struct Counts {
  int products = 0, multiply_adds = 0, comparisons = 0, divisions = 0, inverse_cosines = 0,
      exponentials = 0;
};

/// A number that knows what was done to it. Constants of (n) alone are made beforehand, so they cost
/// nothing here.
struct Counted {
  Real value;
  Counts* counts;

  Counted with(Real result) const { return {result, counts}; }
};
Counted operator*(Counted a, Counted b) {
  ++a.counts->products;
  return a.with(a.value * b.value);
}
Counted operator/(Counted a, Counted b) {
  ++a.counts->divisions;
  return a.with(a.value / b.value);
}
Counted multiply_add(Real factor, Counted a, Real addend) {
  ++a.counts->multiply_adds;
  return a.with(std::fma(factor, a.value, addend));
}
Counted positive_or_zero(Counted a) {
  ++a.counts->comparisons;
  return a.with(std::max<Real>(0, a.value));
}
Counted inverse_cosine(Counted a) {
  ++a.counts->inverse_cosines;
  return a.with(std::acos(a.value));
}
Counted exponential(Counted a) {
  ++a.counts->exponentials;
  return a.with(std::exp(a.value));
}

Counted cs16(Counted cosine, Real n) {
  Counted base = positive_or_zero(multiply_add(n / 16, cosine, 1 - n / 16));
  for (int squaring = 0; squaring < 4; ++squaring) base = base * base;
  return base;
}
Counted schlick(Counted cosine, Real n) { return cosine / multiply_add(1 - n, cosine, n); }
Counted gauss(Counted cosine, Real n) {
  const Counted x = inverse_cosine(cosine);
  return exponential(x * x * cosine.with(-n / 2));
}

/// Largest difference between the counted form and the formula as printed.
template <class Form, class Formula>
Real disagreement(Form form, Formula formula, Counts& counts) {
  Real worst = 0;
  for (const Real n : {16.0L, 100.0L, 1024.0L})
    for (Real x = 0.001L; x < kRightAngle; x += 0.01L) {
      counts = {};
      const Counted value = form(Counted{std::cos(x), &counts}, n);
      worst = std::max(worst, std::abs(value.value - formula(x, n)));
    }
  return worst;
}

constexpr char kDefinition[] =
    "the formula computed with numbers that count what is done to them, from a given cos x and "
    "constants of n made beforehand";

}  // namespace

Claim cs16_operations() {
  Counts counts;
  const Real worst = disagreement(cs16, cs16_lobe, counts);
  Claim claim{"cs16-operations", "eq. (1)",
              "cs16 takes four squarings and one multiply-add: simple in hardware",
              "4 squarings, 1 multiply-add"};
  claim.measured = {figure("products", counts.products, 1),
                    figure("multiply-adds", counts.multiply_adds, 1),
                    figure("comparisons, for the cut", counts.comparisons, 1),
                    vanishing("largest difference from eq. (1)", worst, 1e-14)};
  claim.definition = kDefinition;
  claim.verdict = confirmed_if(counts.products == 4 && counts.multiply_adds == 1 &&
                               counts.divisions == 0 && worst < 1e-14L);
  claim.reason = "the cut at theta_cr is a comparison more, which the paper does not count";
  return claim;
}

Claim schlick_division() {
  Counts counts;
  const Real worst = disagreement(schlick, schlick_lobe, counts);
  Claim claim{"schlick-division", "text on Schlick's lobe", "Schlick's lobe needs a division", ""};
  claim.measured = {figure("divisions", counts.divisions, 1),
                    figure("multiply-adds", counts.multiply_adds, 1),
                    vanishing("largest difference from the formula", worst, 1e-14)};
  claim.definition = kDefinition;
  claim.verdict = confirmed_if(counts.divisions == 1 && worst < 1e-14L);
  return claim;
}

Claim gauss_inverse_cosine() {
  Counts counts;
  const Real worst = disagreement(gauss, gauss_lobe, counts);
  const auto spherical = [](Real n) {
    return largest([n](Real x) { return std::exp(-n * versine(x)) - cosine_lobe(x, n); }, 0,
                   kRightAngle, 100);
  };
  Claim claim{"gauss-inverse-cosine", "text on the Gaussian lobe",
              "the Gaussian lobe needs an inverse cosine", ""};
  claim.measured = {figure("inverse cosines", counts.inverse_cosines, 1),
                    figure("exponentials", counts.exponentials, 1),
                    vanishing("largest difference from the formula", worst, 1e-14),
                    figure("largest exp(-n (1 - cos x)) - cos^n", spherical(16).value, 3,
                           "n = 16; it falls with n")};
  claim.definition = kDefinition;
  claim.verdict = confirmed_if(counts.inverse_cosines == 1 && worst < 1e-14L);
  claim.reason =
      "true of exp(-n x^2/2); exp(-n (1 - cos x)), the limit of the paper's own family, needs none";
  return claim;
}

}  // namespace lobelia::paper

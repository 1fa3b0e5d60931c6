// The operations of each lobe, counted by computing the formula with a counting number.
#include <bit>

#include "studies/paper/search.hpp"

namespace lobelia::paper {
namespace {

struct Counts {
  int products = 0, multiply_adds = 0, comparisons = 0, divisions = 0, inverse_cosines = 0,
      exponentials = 0, logarithms = 0;

  int functions() const { return inverse_cosines + exponentials + logarithms; }
  int all() const { return products + multiply_adds + divisions + functions(); }
};

/// A number that counts the operations on it. Constants of n alone are made beforehand and cost nothing here.
struct Counted {
  Real value;
  Counts* counts;

  Counted with(Real result) const { return {result, counts}; }
  Counted after(int Counts::*operation, Real result) const {
    ++(counts->*operation);
    return with(result);
  }
};
Counted operator*(Counted a, Counted b) { return a.after(&Counts::products, a.value * b.value); }
Counted operator/(Counted a, Counted b) { return a.after(&Counts::divisions, a.value / b.value); }
Counted multiply_add(Real factor, Counted a, Real addend) {
  return a.after(&Counts::multiply_adds, std::fma(factor, a.value, addend));
}
Counted positive_or_zero(Counted a) {
  return a.after(&Counts::comparisons, std::max<Real>(0, a.value));
}
Counted inverse_cosine(Counted a) { return a.after(&Counts::inverse_cosines, std::acos(a.value)); }
Counted exponential(Counted a) { return a.after(&Counts::exponentials, std::exp(a.value)); }
Counted logarithm(Counted a) { return a.after(&Counts::logarithms, std::log(a.value)); }

Counted cosine_by_functions(Counted cosine, Real n) {
  return exponential(cosine.with(n) * logarithm(cosine));
}
/// For a whole n: a squaring for each of its bits, and a product for each that is set.
Counted cosine_by_squarings(Counted cosine, Real n) {
  Counted power = cosine;
  const auto whole = static_cast<unsigned>(n);
  for (int bit = std::bit_width(whole) - 2; bit >= 0; --bit) {
    power = power * power;
    if (whole >> bit & 1) power = power * cosine;
  }
  return power;
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

constexpr char kOperationDefinition[] =
    "operations are counted as the formula runs, from a given cos x and precomputed constants of n";

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
  claim.definition = kOperationDefinition;
  claim.verdict = confirmed_if(counts.products == 4 && counts.multiply_adds == 1 &&
                               counts.divisions == 0 && worst < 1e-14L);
  claim.reason = "the cut at theta_cr needs one more comparison, which the paper does not count";
  return claim;
}

Claim schlick_division() {
  Counts counts;
  const Real worst = disagreement(schlick, schlick_lobe, counts);
  Claim claim{"schlick-division", "text on Schlick's lobe", "Schlick's lobe needs a division", ""};
  claim.measured = {figure("divisions", counts.divisions, 1),
                    figure("multiply-adds", counts.multiply_adds, 1),
                    vanishing("largest difference from the formula", worst, 1e-14)};
  claim.definition = kOperationDefinition;
  claim.verdict = confirmed_if(counts.divisions == 1 && worst < 1e-14L);
  return claim;
}

Claim schlick_cost() {
  Counts schlick_counts, function_counts, counts;
  disagreement(schlick, schlick_lobe, schlick_counts);
  Real worst = disagreement(cosine_by_functions, cosine_lobe, function_counts);
  worst = std::max(worst, disagreement(cosine_by_squarings, cosine_lobe, counts));
  const auto squarings = [](Real n) {
    Counts of_n;
    cosine_by_squarings({0.5L, &of_n}, n);
    return of_n.all();
  };
  int least = squarings(kFirstExponent), most = least, dearest = kFirstExponent;
  for (int n = kFirstExponent; n <= kLastExponent; ++n) {
    least = std::min(least, squarings(n));
    if (squarings(n) > most) most = squarings(n), dearest = n;
  }
  Claim claim{"schlick-cost", "text on Schlick's lobe",
              "Schlick's lobe is considerably cheaper than those of Phong and Blinn", ""};
  claim.measured = {
      figure("operations of Schlick's lobe", schlick_counts.all(), 1),
      figure("logarithms and exponentials among them", schlick_counts.functions(), 1),
      figure("operations of cos^n by logarithm and exponential", function_counts.all(), 1),
      figure("logarithms and exponentials among them", function_counts.functions(), 1),
      figure("operations of cos^n by squarings, fewest", least, 1, at_exponent(kFirstExponent)),
      figure("the same, most", most, 2, at_exponent(dearest)),
      vanishing("largest difference of both from cos^n", worst, 1e-14)};
  claim.definition =
      std::string(kOperationDefinition) +
      ". Phong's and Blinn's lobes are both cos^n; vectors are not counted. Confirmed if Schlick's needs "
      "neither logarithm nor exponential, and at every whole n = 16..1024 at most half of the operations of"
      " squarings, with a division as one; no figure is printed";
  claim.verdict = confirmed_if(schlick_counts.functions() == 0 && function_counts.functions() > 0 &&
                               2 * schlick_counts.all() <= least && worst < 1e-14L);
  claim.reason =
      "one of the two operations is a division, several times as slow as a product. At n = 16, with few "
      "squarings, little of the gain is left. docs/cost.md has times";
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
  claim.definition = kOperationDefinition;
  claim.verdict = confirmed_if(counts.inverse_cosines == 1 && worst < 1e-14L);
  claim.reason =
      "true of exp(-n x^2/2). exp(-n (1 - cos x)), the limit of the paper's own family, needs none";
  return claim;
}

}  // namespace lobelia::paper

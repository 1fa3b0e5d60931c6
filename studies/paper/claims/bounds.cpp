// The bounds that the paper prints for the two coefficients of the Blinn-Phong family.
//
// For row 3, 8 pi C - (n + 2) is (n + 2) q / (1 - q) with q = 2^(-n/2 - 1): above 0 even if it is so small that the
// difference rounds to 0.
#include "studies/paper/search.hpp"

namespace lobelia::paper {
namespace {

constexpr char kBounds[] = "bounds below the table of coefficients";

/// The least f(n) from n = 0.01 to 1e6, a hundred steps a decade.
template <class F>
Real least_over_all_n(F f) {
  return -largest([&](Real decade) { return -f(std::pow(Real(10), decade)); }, -2, 6, 800).value;
}

Real above_n_plus_2(Real n) {
  if (n < 64) return 8 * kPi * column::blinn_phong_rdf(n) - (n + 2);
  const Real q = std::exp2(-n / 2 - 1);
  return (n + 2) * q / (1 - q);
}
Real above_n_plus_6(Real n) {
  return 8 * kPi * column::modified_blinn_phong_corrected(n) - (n + 6);
}

constexpr char kDefinition[] =
    "8 pi C - the bound, n real from 0.01 to 1e6 (a hundred steps a decade, then refined)";

}  // namespace

Claim bounds_blinn_phong_rdf() {
  const Extreme nearest = largest_over_n([](Real n) { return -above_n_plus_2(n); });
  const bool holds = nearest.value < 0 &&
                     least_over_all_n([](Real n) { return n < 64 ? above_n_plus_2(n) : 1; }) > 0 &&
                     least_over_all_n([](Real n) { return 2 - above_n_plus_2(n); }) > 0;
  Claim claim{"bounds-blinn-phong-rdf", kBounds, "(n+2)/(8 pi) < Blinn-Phong (RDF) < (n+4)/(8 pi)",
              "n + 2 .. n + 4"};
  claim.measured = {{"exponents at which both hold", double(holds), holds ? "all" : "not all", ""},
                    figure("8 pi C, where the bounds are 18 and 20",
                           8 * kPi * column::blinn_phong_rdf(16), 4, at_exponent(16))};
  claim.definition = kDefinition;
  claim.verdict = confirmed_if(holds);
  claim.reason =
      "8 pi C = (n + 2)/(1 - 2^(-n/2 - 1)). It is above n + 2, equals n + 4 at n = 0 only, and tends to n +"
      " 2";
  return claim;
}

Claim bounds_modified_blinn_phong() {
  const bool never = least_over_all_n([](Real n) {
                       return 8 * kPi * column::modified_blinn_phong(n) - (n + 8);
                     }) > 0;
  const bool corrected = least_over_all_n(above_n_plus_6) > 0 &&
                         least_over_all_n([](Real n) { return 2 - above_n_plus_6(n); }) > 0;
  Claim claim{"bounds-modified-blinn-phong", kBounds,
              "(n+6)/(8 pi) < modified Blinn-Phong < (n+8)/(8 pi)", "n + 6 .. n + 8"};
  const auto at_16 = [](const char* what, Coefficient coefficient) {
    return figure(what, 8 * kPi * coefficient(16), 4, at_exponent(16));
  };
  claim.measured = {
      {"exponents at which both hold, as printed", double(!never), never ? "none" : "some", ""},
      at_16("8 pi C as printed, where the bounds are 22 and 24", column::modified_blinn_phong),
      {"exponents at which both hold, with 8 pi for 4 pi", double(corrected),
       corrected ? "all" : "not all", ""},
      at_16("8 pi C with 8 pi for 4 pi", column::modified_blinn_phong_corrected)};
  claim.definition = kDefinition;
  claim.verdict = confirmed_if(!never);
  claim.reason =
      "the misprint of cosine-modified-blinn-phong; the bounds are those of the true constant";
  return claim;
}

Claim bounds_of_cs16() {
  // Straight lines in n: 1.068 n + 0.96 = n + 4, and 1.027 n + 4.8 = n + 6 and n + 8.
  const Real leaves_3 = (4 - 0.96L) / 0.068L, enters_4 = (6 - 4.8L) / 0.027L,
             leaves_4 = (8 - 4.8L) / 0.027L;
  Claim claim{"bounds-of-cs16", kBounds,
              "the bounds are those of the cos^n column: the cs16 column leaves them", ""};
  claim.measured = {figure("Blinn-Phong (RDF) within them up to n", leaves_3, 3),
                    figure("modified Blinn-Phong within them from n", enters_4, 3),
                    figure("to n", leaves_4, 3)};
  claim.definition = "where 1.068 n + 0.96 and 1.027 n + 4.8 cross the bounds times 8 pi";
  claim.reason = "a cs16 coefficient grows as 17/16 n, the bounds as n";
  return claim;
}

}  // namespace lobelia::paper

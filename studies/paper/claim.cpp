#include "studies/paper/claim.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/system/for_each_whole.hpp"

namespace lobelia::paper {

#define LOBELIA_PAPER_CLAIMS(CLAIM)    \
  CLAIM(cs16_largest_error)            \
  CLAIM(cs16_smallest_error)           \
  CLAIM(cs16_without_power)            \
  CLAIM(cs16_operations)               \
  CLAIM(cs16_normalised)               \
  CLAIM(cs16_tail)                     \
  CLAIM(theta_cr_approximation)        \
  CLAIM(theta_cr_beyond)               \
  CLAIM(theta_cr_growth)               \
  CLAIM(residual_phong_rdf)            \
  CLAIM(residual_modified_phong)       \
  CLAIM(residual_blinn_phong_rdf_cut)  \
  CLAIM(residual_blinn_phong_rdf)      \
  CLAIM(residual_modified_blinn_phong) \
  CLAIM(residual_distributions)        \
  CLAIM(cosine_column)                 \
  CLAIM(cosine_modified_blinn_phong)   \
  CLAIM(factor_1063)                   \
  CLAIM(best_digits)                   \
  CLAIM(bounds_blinn_phong_rdf)        \
  CLAIM(bounds_modified_blinn_phong)   \
  CLAIM(bounds_of_cs16)                \
  CLAIM(outside_the_range)             \
  CLAIM(schlick_epicentre)             \
  CLAIM(schlick_epicentre_inflection)  \
  CLAIM(schlick_tail)                  \
  CLAIM(schlick_division)              \
  CLAIM(schlick_cost)                  \
  CLAIM(gauss_accuracy)                \
  CLAIM(gauss_inverse_cosine)          \
  CLAIM(gauss_angle)                   \
  CLAIM(more_accurate_lobe)            \
  CLAIM(cosine_of_reflection)          \
  CLAIM(reciprocity_of_brdfs)          \
  CLAIM(reciprocity_of_rdfs)           \
  CLAIM(energy_of_cs16)                \
  CLAIM(more_accurate_energy)          \
  CLAIM(more_accurate_normalised)      \
  CLAIM(energy_of_brdfs)               \
  CLAIM(energy_of_rdfs_seen)           \
  CLAIM(energy_of_rdfs_lit)            \
  CLAIM(distribution_as_rdf)           \
  CLAIM(distribution_as_brdf)          \
  CLAIM(renderer_constants)

#define LOBELIA_DECLARE(claim) Claim claim();
LOBELIA_PAPER_CLAIMS(LOBELIA_DECLARE)

std::vector<Claim> measure_all() {
#define LOBELIA_LIST(claim) claim,
  static constexpr Claim (*kMeasure[])() = {LOBELIA_PAPER_CLAIMS(LOBELIA_LIST)};
  std::vector<Claim> claims(std::size(kMeasure));
  for_each_whole(claims.size(), [&](std::size_t i) { claims[i] = kMeasure[i](); });
  return claims;
}

std::string figure_text(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return fmt::format("{}", value);
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const auto e = scientific.find('e');
  const int power = std::stoi(scientific.substr(e + 1));  // after rounding: 0.9996 is 1.00
  if (power < -1 || power >= 6) return scientific.substr(0, e) + fmt::format("e{}", power);
  return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - power));
}

Figure figure(std::string what, long double value, int digits, std::string at) {
  const auto number = static_cast<double>(value);
  return {std::move(what), number, figure_text(number, digits), std::move(at)};
}

Figure fixed(std::string what, long double value, int decimals, std::string at) {
  const auto number = static_cast<double>(value);
  return {std::move(what), number, fmt::format("{:.{}f}", number, decimals), std::move(at)};
}

Figure vanishing(std::string what, long double value, double bound, std::string at) {
  const auto number = static_cast<double>(value);
  if (!(std::abs(number) < bound)) return figure(std::move(what), value, 3, std::move(at));
  return {std::move(what), number, "below " + figure_text(bound, 1), std::move(at)};
}

std::string at_exponent(long double n) { return fmt::format("n = {:.0f}", double(n)); }

bool rounds_to(long double measured, double printed, double unit) {
  return std::abs(measured - static_cast<long double>(printed)) <=
         static_cast<long double>(unit) / 2;
}

std::string confirmed_if(bool holds) { return holds ? kConfirmed : kNotReproduced; }

}  // namespace lobelia::paper

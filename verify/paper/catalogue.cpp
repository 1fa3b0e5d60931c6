#include "verify/paper/catalogue.hpp"

#include <oneapi/tbb/parallel_for.h>

namespace lobelia::paper {
namespace {

constexpr MakeClaim kCatalogue[] = {
    cs16_largest_error,
    cs16_smallest_error,
    cs16_without_power,
    cs16_operations,
    cs16_normalised,
    cs16_tail,
    theta_cr_approximation,
    theta_cr_beyond,
    theta_cr_growth,
    residual_phong_rdf,
    residual_modified_phong,
    residual_blinn_phong_rdf_cut,
    residual_blinn_phong_rdf,
    residual_modified_blinn_phong,
    residual_distributions,
    cosine_column,
    cosine_modified_blinn_phong,
    factor_1063,
    best_digits,
    bounds_blinn_phong_rdf,
    bounds_modified_blinn_phong,
    bounds_of_cs16,
    outside_the_range,
    schlick_epicentre,
    schlick_epicentre_inflection,
    schlick_tail,
    schlick_division,
    schlick_cost,
    gauss_accuracy,
    gauss_inverse_cosine,
    gauss_angle,
    more_accurate_lobe,
    reciprocity_of_brdfs,
    reciprocity_of_rdfs,
    energy_of_cs16,
    more_accurate_energy,
    more_accurate_normalised,
    energy_of_brdfs,
    energy_of_rdfs_seen,
    energy_of_rdfs_lit,
    distribution_as_rdf,
    distribution_as_brdf,
    renderer_constants,
};

}  // namespace

std::span<const MakeClaim> catalogue() { return kCatalogue; }

std::vector<Claim> measure_all() {
  std::vector<Claim> claims(catalogue().size());
  oneapi::tbb::parallel_for(std::size_t{0}, claims.size(),
                            [&](std::size_t i) { claims[i] = catalogue()[i](); });
  return claims;
}

}  // namespace lobelia::paper

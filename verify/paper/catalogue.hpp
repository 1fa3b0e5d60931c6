// The catalogue of claims. To add one: write its function in a file of claims/, declare it here, add
// it to the list in catalogue.cpp. Table, record, docs/errata.md and tests find it there.
#pragma once

#include <span>
#include <vector>

#include "verify/paper/claim.hpp"

namespace lobelia::paper {

// ---- the cheap lobe
Claim cs16_largest_error();
Claim cs16_smallest_error();
Claim cs16_without_power();
Claim cs16_operations();
Claim cs16_normalised();
Claim cs16_tail();
Claim theta_cr_approximation();
Claim theta_cr_beyond();
Claim theta_cr_growth();

// ---- the table of coefficients
Claim residual_phong_rdf();
Claim residual_modified_phong();
Claim residual_blinn_phong_rdf_cut();
Claim residual_blinn_phong_rdf();
Claim residual_modified_blinn_phong();
Claim residual_distributions();
Claim cosine_column();
Claim cosine_modified_blinn_phong();
Claim factor_1063();
Claim best_digits();
Claim bounds_blinn_phong_rdf();
Claim bounds_modified_blinn_phong();
Claim bounds_of_cs16();
Claim outside_the_range();

// ---- the other lobes
Claim schlick_epicentre();
Claim schlick_epicentre_inflection();
Claim schlick_tail();
Claim schlick_division();
Claim schlick_cost();
Claim gauss_accuracy();
Claim gauss_inverse_cosine();
Claim gauss_angle();
Claim more_accurate_lobe();

// ---- physics
Claim reciprocity_of_brdfs();
Claim reciprocity_of_rdfs();
Claim energy_of_cs16();
Claim more_accurate_energy();
Claim more_accurate_normalised();
Claim energy_of_brdfs();
Claim energy_of_rdfs_seen();
Claim energy_of_rdfs_lit();
Claim distribution_as_rdf();
Claim distribution_as_brdf();

// ---- this program
Claim renderer_constants();

using MakeClaim = Claim (*)();
/// In the order of this header.
std::span<const MakeClaim> catalogue();
/// All of them, measured: takes about a second.
std::vector<Claim> measure_all();

}  // namespace lobelia::paper

// Chances of what random tests see, if what they test is right.
#pragma once

namespace lobelia::shader_check::bsdf {

/// The chance of a larger chi square with `freedom` degrees of freedom.
double chance_of_chi_square(double chi_square, double freedom);

/// An upper bound of the chance that the mean of `count` independent numbers is as far from their expectation, by
/// Bernstein's inequality. `variance` is that of one, `most` the largest distance of one.
double chance_of_mean(double distance, double count, double variance, double most);

}  // namespace lobelia::shader_check::bsdf

// Models of the catalogue fitted to a measured material.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/records/measured.hpp"
#include "renderer/highlight.hpp"
#include "renderer/scene/scene.hpp"
#include "studies/measured/measured.hpp"

namespace lobelia::measured {

/// The exponents among which the best is searched.
inline constexpr double kFitMinExponent = 1, kFitMaxExponent = 1e6;

/// Fits a diffuse base, a specular reflectance and an exponent by least squares. The metric is that of Ngan et al. 2005,
/// "Experimental Analysis of BRDF Models": the difference of f_r N.L, weighted by solid angle, without angles beyond 80
/// degrees. The exponents of `kinds` are not used. `command` and `file` are left empty. Throws Error(kInput) if nothing was
/// measured.
records::MeasuredFits fit(const MeasuredBrdf& brdf, std::span<const Highlight> kinds);

/// Every model of the catalogue with every lobe.
std::vector<Highlight> all_kinds();

/// The best fit of each model, best first.
std::vector<records::MeasuredFit> best_by_model(const records::MeasuredFits& fits);

std::string fits_text(const records::MeasuredFits& fits);

struct NamedScene {
  std::string name;
  Scene scene;
};
/// The spheres of reference_scenes/scenes/head_on.xml and oblique_45.xml, without a file: these are found in a copy of the
/// repository or an installation only.
std::vector<NamedScene> canonical_scenes();
/// The scene with the fit as the material of everything.
Scene with_fit(Scene scene, const records::MeasuredFit& fit);
/// Ground truth: each pixel by the measured BRDF itself; black where nothing was measured.
Image measured_picture(const Scene& scene, const MeasuredBrdf& brdf);

}  // namespace lobelia::measured

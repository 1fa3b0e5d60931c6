// The textbook's formulas in float32, without care, for comparison with ours.
#pragma once

#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia::stability::naive {

/// The lobe of a cosine that has been rounded to float32.
float lobe(LobeId lobe, float cosine, double exponent);

/// Lobe times N.L, if the model has it, from vectors of any length: normalised, reflected or halved,
/// multiplied with each other.
float shape(const Highlight& highlight, Vec3 normal, Vec3 to_eye, Vec3 to_light);

/// The same of unit vectors, with every operation in half floats.
double shape_in_half_floats(const Highlight& highlight, Vec3 normal, Vec3 to_eye, Vec3 to_light);

/// The paper's closed form for cos^n; for other lobes, and models that are not in the paper, the integral by the midpoint
/// rule with 1024 steps. Throws Error(kInternal) for a model that the formulas do not know.
float coefficient(const Highlight& highlight);

struct Pixel {
  int sphere = -1;
  Rgb radiance;
};
/// Every pixel in reading order: b^2 - c of the quadratic formula, shadow rays that start 1e-4 away.
std::vector<Pixel> picture(const Scene& scene);

}  // namespace lobelia::stability::naive

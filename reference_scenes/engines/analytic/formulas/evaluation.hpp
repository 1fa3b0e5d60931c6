// A whole scene under lights without size, evaluated pixel by pixel from the formulas of docs/conventions.md: one ray
// through each pixel's centre, in double or in 50 digits. It shares with the renderer the scene and each lobe's textbook
// definition, which no kernel uses.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/pictures/pixel_flags.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::truth {

/// Double is within 3e-9 of the peak for exponents up to 1e6.
enum class Digits { kDouble, kFifty };

/// Why evaluate() and edge_ring() do not apply to a scene, as a sentence; empty if they do.
std::string why_not_evaluated(const Scene& scene);

/// Radiance of every pixel in reading order. Rows not begun when `stop` returns true stay black. Throws Error(kInput)
/// with the sentence of why_not_evaluated().
std::vector<Rgb> evaluate(const Scene& scene, Digits digits,
                          const std::function<bool()>& stop = {});

/// Radiance per unit irradiance normal to the beam, for unit vectors away from the surface; N.L is above 0.
using Reflectance = std::function<Rgb(Vec3 normal, Vec3 to_eye, Vec3 to_light)>;
/// The pixels of evaluate() in double, with `reflectance` in place of every material's highlight and diffuse base. Calls it
/// from several threads. Throws as evaluate() does.
std::vector<Rgb> shade(const Scene& scene, const Reflectance& reflectance);

/// The radiance of evaluate() as a picture, rounded to float32.
Image as_picture(const std::vector<Rgb>& radiance, const Film& film);

/// By pixel in reading order, 1 where the rays through its centre and through its eight neighbours' do not all see the
/// same surfaces and checker squares, lit by the same lamps, along the whole chain of mirrors. Only there may two correct
/// programs differ by the whole value of a pixel. Throws as evaluate() does.
PixelFlags edge_ring(const Scene& scene);

/// Sets `ring` to 1 in the pixels whose centre sees a surface that a lamp lights with 0 < N.L < least_cosine. Returns how
/// many these are. Throws as evaluate() does.
std::int64_t mark_grazing(const Scene& scene, double least_cosine, PixelFlags& ring);

/// By pixel in reading order, 1 where the ray through its centre meets a sphere or a plane, whatever the lights, the lens
/// and the samples. Throws Error(kInput) for more than kMaxSpheresByRay spheres.
PixelFlags surface_mask(const Scene& scene);

}  // namespace lobelia::truth

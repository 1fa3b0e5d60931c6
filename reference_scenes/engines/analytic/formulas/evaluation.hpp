// A whole scene under lights without size, evaluated pixel by pixel from the formulas of docs/conventions.md:
// one ray through each pixel's centre, in double or in 50 digits. It has none of the renderer's
// kernels: of the renderer it takes the scene, and of each lobe the textbook definition that no kernel uses.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia::truth {

/// In what numbers: double is within 3e-9 of the peak for exponents up to 1e6.
enum class Digits { kDouble, kFifty };

/// Why evaluate() and edge_ring() cannot tell of a scene, as a sentence; empty if they can.
std::string why_not_evaluated(const Scene& scene);

/// Radiance of every pixel in reading order. Rows that have not begun when `stop` says true stay black.
/// Throws Error(kInput) with the sentence of why_not_evaluated().
std::vector<Rgb> evaluate(const Scene& scene, Digits digits,
                          const std::function<bool()>& stop = {});

/// By pixel in reading order, 1 where the ray through its centre and those a pixel to each of the eight sides do
/// not all see the same: the same surfaces and squares of checkers, lit by the same lamps, along the whole chain
/// of mirrors. There two programs that are both right may differ by the whole value of a pixel, and nowhere
/// else. Throws as evaluate() does.
std::vector<std::uint8_t> edge_ring(const Scene& scene);

/// By pixel in reading order, 1 where the ray through its centre meets a sphere or a plane. Lights, a lens and
/// samples make no difference; throws Error(kInput) for more than kMaxSpheresByRay spheres.
std::vector<std::uint8_t> surface_mask(const Scene& scene);

}  // namespace lobelia::truth

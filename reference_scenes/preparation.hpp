// Preparation of a scene for any engine.
#pragma once

#include <string>
#include <vector>

#include "core/image.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Whether a mirror is to be followed.
bool has_mirror(const Scene& scene);

/// Why no engine can be asked for this scene, as a sentence; empty if some can. Those that cannot have
/// reasons of their own (Engine::why_not).
std::string why_not_comparable(const Scene& scene);

/// Why none of the engines that are programs can, though formulas may.
std::string why_not_for_programs(const Scene& scene);

/// The first pair of a lamp and a sphere that it lies on, in words ("light 0 lies on sphere 2"); empty if there
/// is none. Or of one that does not face away from the sphere, and shines below its own horizon.
std::string lamp_on_sphere(const Scene& scene);
std::string lamp_below_horizon(const Scene& scene);
/// The same of a lamp that lies on no surface but is nearer to one than `distance`, in the engines' units,
/// and does not face away from it.
std::string lamp_close_to_surface(const Scene& scene, double distance);

/// The same picture in the engines' units: the first sphere's centre is the origin and the smallest
/// radius lies in [1, 2); a scene without lights has a black one. The factor is a power of two, so
/// a scene that is there already keeps its numbers, bit for bit. Lamps that lie on a surface still do.
Scene in_engine_units(Scene scene);

/// The greatest distance from the origin of anything in the scene, and at least 1.
double extent(const Scene& scene);

/// Pixel by pixel in double precision, in the order given. All sizes are equal.
Image sum_of(const std::vector<Image>& passes);

/// Text of a number that reads back to the same number. Throws Error(kInternal) if not finite: it
/// would be code, not a number, in an engine's input.
std::string exact_text(double value);

}  // namespace lobelia

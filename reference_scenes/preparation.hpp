// Prepares a scene for any engine.
#pragma once

#include <string>
#include <vector>

#include "base/pictures/image.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Whether rays follow mirrors.
bool has_mirror(const Scene& scene);

/// Why no engine can show this scene, as a sentence; empty if some can. Engine::why_not adds an engine's own reasons.
std::string why_not_comparable(const Scene& scene);

/// Why no engine that is a program can show it, though the formulas may.
std::string why_not_for_programs(const Scene& scene);

/// The first pair of a lamp and a sphere that it lies on: "light 0 lies on sphere 2"; empty if there is none.
std::string lamp_on_sphere(const Scene& scene);
/// The first such lamp that does not face away from the sphere, and so shines below its own horizon.
std::string lamp_below_horizon(const Scene& scene);
/// The first lamp that is nearer than `distance` (in engine units) to a surface but does not lie on it or face away from it.
std::string lamp_close_to_surface(const Scene& scene, double distance);

/// The same picture in engine units: the first sphere's centre is the origin, and the smallest radius is in [1, 2). The
/// scale is a power of two, so that a scene in these units keeps its numbers bit for bit. Lamps on surfaces stay there. A
/// scene without lights gets a black one.
Scene in_engine_units(Scene scene);

/// The greatest distance of anything in the scene from the origin, at least 1.
double extent(const Scene& scene);

/// Pixel by pixel in double precision, in the given order. All sizes are equal.
Image sum_of(const std::vector<Image>& passes);

/// Reads back to the same number. Throws Error(kInternal) if it is not finite, because an engine would read that as code.
std::string exact_text(double value);

}  // namespace lobelia

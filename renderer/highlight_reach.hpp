// Where on a sphere a highlight is not exactly 0. Beyond it nothing is computed, and the picture is the same.
#pragma once

#include <optional>

#include "renderer/highlight.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// The normals within `angle` of `axis`, a unit vector; radians, below pi/2.
struct NormalCap {
  Vec3 axis;
  double angle;
};

/// A cap that holds every normal at which a light's highlight, seen from `eye`, is more than 0 in a float32 picture.
/// `brightest` is the most that the lobe's value is multiplied with, without the falloff of a near light, times the
/// number of lights.
///
/// Empty if it is not known to be smaller than half of the sphere: of wide lobes, of lobes by a formula, which may rise
/// again, of an eye or a light near the surface, and of a light behind the sphere.
///
/// The bounds, with L and V to light and eye and 2g between them: N lies within acos(1 - s) of H for a lobe of the
/// half-vector angle. For one of the mirror angle 1 - s = 2 (N.L) (N.V) - L.V <= 2 cos^2(N, H) cos^2 g - cos 2g, thus
/// sin^2(N, H) <= s / (2 cos^2 g).
///
/// V = a e - b N and L = c l - d N, with e and l the directions from the centre, so the normal is even nearer to
/// a e + c l = (V + L) + (b + d) N than to H: b + d counts where it is least, at the farthest normal. That sum is as far
/// from the axis, the middle of e and l, as a and c differ, which is most if one is nearest and the other farthest.
std::optional<NormalCap> highlight_reach(const Highlight& highlight, const Sphere& sphere, Vec3 eye,
                                         const Lamp& lamp, double brightest);

/// The smallest ball around a sphere's surface in the cap.
Sphere ball_around(const NormalCap& cap, const Sphere& sphere);

}  // namespace lobelia

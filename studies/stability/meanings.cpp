#include "studies/stability/meanings.hpp"

namespace lobelia::stability {
namespace {

struct Meaning {
  std::string_view group;
  std::string_view begins;  ///< what a case's name begins with; empty: the group itself
  std::string_view words;
};

/// The first that fits is taken.
constexpr Meaning kMeanings[] = {
    {"lobe", "", "The lobe alone in float32, at a given 1 - cos of its angle."},
    {"lobe", "angle 1e-8", "A cosine in float32 cannot tell this angle from 0."},
    {"lobe", "angle 1e-4", "A cosine in float32 knows this angle to one digit."},
    {"lobe", "half of the peak", "The flank, where an error of the angle counts most."},
    {"lobe", "just inside theta_cr", "The last number before a lobe of finite reach ends."},
    {"lobe", "inside theta_cr", "Close to where a lobe of finite reach ends."},
    {"lobe", "just outside theta_cr",
     "A negative base, raised to an even power, must give nothing."},
    {"lobe", "angle pi/2", "The horizon: the base of cos^n is 0."},
    {"lobe", "angle 2", "Beyond the horizon there is nothing, whatever the power says."},
    {"coefficient", "", "The number before the lobe, by closed form or by moments of the lobe."},
    {"coefficient", "smallest n", "A difference of two numbers that are nearly the same."},
    {"coefficient", "(n+2)(n+4)", "A product that float32 cannot hold, in a quotient that it can."},
    {"vectors", "", "Normal, eye and light as vectors, to the value of the highlight."},
    {"vectors", "mirror direction", "The peak itself, with vectors that are not along an axis."},
    {"vectors", "flank", "One width of the highlight away from its middle."},
    {"vectors", "dot product",
     "A dot product of unit vectors that rounds past 1: a power of it grows."},
    {"vectors", "L = -V", "The half vector of opposite directions: 0 divided by 0, or nearly."},
    {"vectors", "N.L", "The light at the horizon, and the next numbers above and below."},
    {"vectors", "N.V", "The eye at the horizon, and the next numbers above and below."},
    {"vectors", "R.L", "The light behind the lobe's hemisphere: nothing is to be seen."},
    {"vectors", "lengths", "The squared length underflows or overflows float32."},
    {"vectors", "denormal", "Components below the smallest normal number of their format."},
    {"density", "",
     "The density of samples, down to where it underflows: never denormal, never below 0."},
    {"spheres", "",
     "Whole pictures of spheres: the right sphere in every pixel, and the right radiance."},
    {"spheres", "radius 1e6, from", "An eye so close that the sphere is all but a plane."},
    {"spheres", "radius", "The quadratic formula must not care in which unit the scene is."},
    {"spheres", "1e7 radii", "b^2 - c cancels to nothing: float32 misses the sphere."},
    {"spheres", "two concentric", "Which sphere is seen, and whether it shades the other."},
    {"spheres", "the same sphere", "Two surfaces in one place must not shade each other."},
    {"spheres", "two spheres that touch", "A shadow ray that begins on both surfaces."},
    {"spheres", "light inside", "Nothing is lit from within."},
    {"spheres", "light just above", "Irradiance is largest where digits are fewest."},
    {"spheres", "light at a right angle", "The highlight is at the terminator."},
    {"spheres", "light behind", "The light grazes the silhouette."},
    {"spheres", "camera inside", "Spheres are seen from outside only."},
    {"spheres", "tangent ray", "Rays that touch a sphere, and the next numbers on either side."},
    {"precision", "",
     "1e5 random vectors and the worst of them made worse, against the stated bound."},
};

}  // namespace

std::string_view meaning_of_group(std::string_view group) {
  for (const Meaning& m : kMeanings)
    if (m.group == group && m.begins.empty()) return m.words;
  return "";
}

std::string_view meaning_of_case(std::string_view group, std::string_view name) {
  for (const Meaning& m : kMeanings)
    if (m.group == group && !m.begins.empty() && name.starts_with(m.begins)) return m.words;
  if (group == "lobe" && name.ends_with("times the smallest float32"))
    return "A result that is about to be no normal number any more.";
  return "";
}

}  // namespace lobelia::stability

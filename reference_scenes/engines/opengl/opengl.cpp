// OpenGL's lighting before shaders (OpenGL 1.0 to 2.1, "fixed function") as a reference engine: Blinn-Phong as it was in
// every graphics card for twenty years.
#include "reference_scenes/engines/programs/native_engine.hpp"

namespace lobelia {
namespace {

constexpr EngineVariant kOpenglVariants[] = {
    {"opengl", "OpenGL native", false, Shading::kNative, kFloat32PointFloor}};

constexpr double kMostOpenglExponent = 128;   // GL_SHININESS
constexpr std::size_t kMostOpenglLights = 8;  // that every driver has

/// (N.H)^n, without a coefficient, where N.L > 0.
std::optional<OwnHighlight> opengl_highlight(const Highlight& highlight) {
  if (info(highlight.model).name != "blinn_phong_rdf" || info(highlight.lobe).name != "cosine" ||
      highlight.exponent > kMostOpenglExponent)
    return {};
  return OwnHighlight{"blinn", radiance_coefficient(highlight)};
}

std::string why_not_in_opengl(const Scene& scene) {
  if (std::string why = why_not_one_sphere(scene); !why.empty()) return why;
  if (scene.lights.size() > kMostOpenglLights) return "it has 8 lights";
  return "";
}

}  // namespace

constinit const NativeEngine kOpengl{
    {
        .name = "opengl",
        .title = "OpenGL fixed function",
        .install_hint =
            "sudo apt-get install libegl-dev libgl-dev libgl1-mesa-dri, and build Lobelia again",
        .supported_versions = "1.5 to 4.6, with the compatibility profile",
        .shading = "native: Blinn-Phong (RDF) with cos^n, n at most 128, grey",
        .precision = "float32 throughout",
        .effects = "one sphere, up to 8 directional and point lights; as averages: depth of field, "
                   "antialiasing",
        .plain = "float",
        .floor = kFloat32PointFloor,
        .seconds = {0.3, 1e-6},
        .variants = kOpenglVariants,
    },
    {"engine_opengl", "OpenGL ", [](int major, int) { return major >= 1 && major <= 4; }, nullptr,
     true},
    "OpenGL's own lighting, one point with the sphere's normal for each "
    "pixel",
    opengl_highlight,
    why_not_in_opengl};

}  // namespace lobelia

#include "reference_scenes/engines/opengl/opengl.hpp"

#include "reference_scenes/engines/programs/native_engine.hpp"

namespace lobelia {
namespace {

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

constexpr NativeEngine kOpengl{
    kOpenglInfo,
    {"engine_opengl", "OpenGL ", [](int major, int) { return major >= 1 && major <= 4; }, nullptr,
     true},
    "OpenGL's own lighting, one point with the sphere's normal for each "
    "pixel",
    opengl_highlight,
    why_not_in_opengl};

}  // namespace

std::unique_ptr<Engine> make_opengl(const std::filesystem::path& program) {
  return make_native_engine(kOpengl, program);
}

void keep_opengl_input(const Scene& scene, const ReferenceOptions& options,
                       const std::filesystem::path& directory) {
  keep_native_input(kOpengl, scene, options, directory);
}

}  // namespace lobelia

// The formats of the catalogue, each in a file of its own, and what several of them need.
#pragma once

#include "records/scene.hpp"
#include "reference_scenes/formats/catalogue.hpp"

namespace lobelia {

extern const SceneFormat kJsonFormat, kMitsubaFormat, kPovrayFormat, kGltfFormat,
    kBlenderPythonFormat;

/// The most spheres that are written out one by one. Our own reader takes at most kMaxSceneBytes.
inline constexpr std::size_t kMaxWrittenSpheres = 200'000;
/// Why a scene with so many spheres is not written; empty if it is.
std::string why_not_so_many_spheres(const Scene& scene);
/// The same, or why a format that spells out each type of light does not know one of the scene's.
std::string why_not_spelled_out(const Scene& scene);

/// The scene and its parts as numbers.
records::Scene scene_record(const Scene& scene);
records::SceneMaterial material_record(const Material& material);
records::Triple triple(Vec3 v);
records::Triple triple(Rgb c);

/// The exponent of the half vector's cosine with a highlight of about the same width: n, or 4 n for the models of the mirror
/// direction, where the angle is twice as large.
double half_vector_exponent(const Highlight& highlight);
/// The roughness of glossy shaders, the root of the width alpha of a distribution of normals cos^n: alpha^2 = 2/(n + 2)
/// (Walter et al. 2007).
double roughness_of(const Highlight& highlight);

}  // namespace lobelia

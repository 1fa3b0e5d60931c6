// Reads the materials of glTF 2.0.
//
// Source: Khronos, glTF 2.0 specification, appendix B, GGX with alpha = roughness^2 and Schlick's factor; F0 of a dielectric is
//         0.04 (KHR_materials_ior: ((ior - 1) / (ior + 1))^2), of a metal its base colour. KHR_materials_specular:
//         min(F0 specularColor, 1) and F90 = 1, both times specular. KHR_materials_pbrSpecularGlossiness: roughness =
//         1 - glossiness, F0 = specular.
#include <fmt/format.h>

#include <algorithm>

#include "base/records/gltf.hpp"
#include "base/words/text.hpp"
#include "studies/convert/assets/assets.hpp"

namespace lobelia::conversion {
namespace {

constexpr std::string_view kGltfMeaning =
    "glTF: GGX, alpha is the square of the roughness, which is 1 - glossiness (glTF 2.0, appendix B)";
constexpr double kLeastF0 = 1e-3;

double mean_of(std::span<const double> colour) { return (colour[0] + colour[1] + colour[2]) / 3; }

/// The factor, or glTF's default 1 with a remark.
double factor_of(std::optional<double> factor, std::string_view key, FileMaterial& to) {
  if (!factor) to.remark(fmt::format("{} is missing: glTF's default 1 is used", key));
  return factor.value_or(1);
}

void set_reflectance(double head_on, double grazing, FileMaterial& to) {
  if (grazing == 0) {
    to.model.reset();
    return to.remark("its specularFactor is 0: there is no highlight");
  }
  // Schlick's factor over its value head on depends on the ratio alone.
  to.f0 = std::clamp(head_on / grazing, kLeastF0, 1.0);
  to.remark(fmt::format("F0 is {:.4g}, the mean of its channels{}", head_on,
                        head_on / grazing < kLeastF0
                            ? fmt::format("; the highlight has {:g} of F90", kLeastF0)
                            : ""));
}

void read_glossiness(const records::GltfMaterial& from, FileMaterial& to) {
  const double roughness = 1 - factor_of(from.glossiness, "glossinessFactor", to);
  to.set("ggx", roughness * roughness);
  if (to.model) set_reflectance(mean_of(from.specular_color), 1, to);
}

void read_roughness(const records::GltfMaterial& from, FileMaterial& to) {
  const double roughness = factor_of(from.roughness, "roughnessFactor", to);
  const double metallic = factor_of(from.metallic, "metallicFactor", to);
  to.set("ggx", roughness * roughness);
  if (!to.model) return;
  // With ior 0 the extension means a reflectance of 1.
  const double of_ior = reflectance_of_ior(from.ior.value_or(1.5));
  std::array<double, 3> dielectric = from.specular_color;
  for (double& channel : dielectric) channel = std::min(of_ior * channel, 1.0);
  const double weight = (1 - metallic) * from.specular.value_or(1);
  set_reflectance(weight * mean_of(dielectric) + metallic * mean_of(from.base_color),
                  weight + metallic, to);
}

}  // namespace

Assets read_gltf(std::string_view json, const std::string& file_name) {
  Assets assets{kGltfMeaning};
  for (const records::GltfMaterial& from :
       records::parse_gltf_materials(json, file_name, kMostMaterials)) {
    FileMaterial& to = assets.add(from.name);
    if (from.is_unlit)
      to.remark("KHR_materials_unlit: there is no highlight");
    else if (from.has_specular_glossiness)
      read_glossiness(from, to);
    else
      read_roughness(from, to);
    for (const std::string& key : from.textures)
      to.remark(fmt::format("{} is a picture, which is not read", key));
    for (const std::string& name : from.other_extensions)
      to.remark(fmt::format("{} is not read", printable(name)));
  }
  return assets;
}

}  // namespace lobelia::conversion

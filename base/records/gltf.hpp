// The materials of a glTF file, as far as they shape a highlight.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia::records {

/// Factors are missing where the file has none; glTF's default then counts. All are 0 to 1, but `ior` is 0 or at least 1.
struct GltfMaterial {
  std::string name;
  bool is_unlit = false;
  bool has_specular_glossiness = false;  ///< KHR_materials_pbrSpecularGlossiness
  std::optional<double> roughness, metallic, glossiness, specular, ior;
  std::array<double, 4> base_color{1, 1, 1, 1};
  std::array<double, 3> specular_color{1, 1, 1};  ///< also specularFactor beside a glossiness
  std::vector<std::string> textures;              ///< keys of pictures that change the highlight
  std::vector<std::string> other_extensions;      ///< names that are not read here
};

/// The materials of a glTF 2.0 file's JSON, at most `most`. Other parts of the file are not kept in memory. Throws
/// Error(kInput), such as "a.gltf: materials[3].pbrMetallicRoughness.roughnessFactor: 7; allowed: 0 to 1".
std::vector<GltfMaterial> parse_gltf_materials(std::string_view text, const std::string& where,
                                               std::size_t most);

}  // namespace lobelia::records

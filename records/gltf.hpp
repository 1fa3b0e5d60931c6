// The part of glTF 2.0 (Khronos 2021) that a scene is written in. It is no record of ours, but its keys are described in the same
// way.
#pragma once

#include <array>

#include "records/scene.hpp"

namespace lobelia::records {

struct GltfAsset {
  std::string version, generator;
};
struct GltfPerspective {
  double aspect_ratio = 0, yfov = 0, znear = 0;
};
struct GltfCameraExtras {
  SceneFilm film;
  SceneDepth depth;
  double aperture_radius = 0, focus_distance = 0;
};
struct GltfCamera {
  std::string type;
  GltfPerspective perspective;
  GltfCameraExtras extras;
};
struct GltfAttributes {
  int position = 0, normal = 0;
};
struct GltfPrimitive {
  GltfAttributes attributes;
  int indices = 0, material = 0;
};
struct GltfMesh {
  std::vector<GltfPrimitive> primitives;
};
struct GltfMetallicRoughness {
  std::array<double, 4> base_color_factor{};
  double metallic_factor = 0, roughness_factor = 0;
};
struct GltfSpecular {
  Triple specular_color_factor{};
};
struct GltfMaterialExtensions {
  GltfSpecular specular;
};
struct GltfMaterial {
  GltfMetallicRoughness pbr_metallic_roughness;
  bool double_sided = false;
  GltfMaterialExtensions extensions;
  SceneMaterial extras;
};
struct GltfAccessor {
  int buffer_view = 0, component_type = 0;
  std::size_t count = 0;
  std::string type;
  std::vector<double> min, max;
};
struct GltfBufferView {
  int buffer = 0;
  std::size_t byte_offset = 0, byte_length = 0;
  int target = 0;
};
struct GltfBuffer {
  std::size_t byte_length = 0;
  std::string uri;
};
struct GltfLight {
  std::string type;
  Triple color{};
  double intensity = 0;
};
struct GltfLights {
  std::vector<GltfLight> lights;
};
struct GltfExtensions {
  GltfLights lights;
};
struct GltfNodeLight {
  int light = 0;
};
struct GltfNodeExtensions {
  GltfNodeLight lights;
};
struct GltfNode {
  std::string name;
  std::optional<int> mesh, camera;
  std::optional<std::array<double, 16>> matrix;
  std::optional<Triple> translation, scale;
  std::optional<GltfNodeExtensions> extensions;
};
struct GltfScene {
  std::vector<int> nodes;
};
struct Gltf {
  GltfAsset asset;
  std::vector<std::string> extensions_used;
  int scene = 0;
  std::vector<GltfScene> scenes;
  std::vector<GltfNode> nodes;
  std::vector<GltfCamera> cameras;
  std::vector<GltfMesh> meshes;
  std::vector<GltfMaterial> materials;
  std::vector<GltfAccessor> accessors;
  std::vector<GltfBufferView> buffer_views;
  std::vector<GltfBuffer> buffers;
  std::optional<GltfExtensions> extensions;
};

void define_gltf_tables(Tables& tables);

}  // namespace lobelia::records

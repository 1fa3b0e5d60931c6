// Source: Khronos, glTF 2.0 specification, 3.9; extensions KHR_materials_specular, KHR_materials_ior and
//         KHR_materials_pbrSpecularGlossiness.
#include "base/records/gltf.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/records/type.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia::records {
namespace {

constexpr Bounds kFactor{.least = 0, .most = 1};

template <class T>
void read_key(const Json& object, const char* key, const Place& place, const Bounds& bounds,
              T& value) {
  if (const auto found = object.find(key); found != object.end())
    type_of<T>().read(*found, bounds, Place(place, key), &value);
}

/// The object of that key; null if there is none.
const Json* object_of(const Json& object, const char* key, const Place& place) {
  const auto found = object.find(key);
  if (found == object.end()) return nullptr;
  if (!found->is_object()) Place(place, key).fail("not an object");
  return &*found;
}

void note_textures(const Json& object, std::initializer_list<const char*> keys,
                   GltfMaterial& material) {
  for (const char* key : keys)
    if (object.contains(key)) material.textures.emplace_back(key);
}

void read_extension(const std::string& name, const Json& extension, const Place& place,
                    GltfMaterial& material) {
  if (name == "KHR_materials_unlit") {
    material.is_unlit = true;
  } else if (name == "KHR_materials_ior") {
    read_key(extension, "ior", place, {.least = 0, .most = 1e3}, material.ior);
    if (material.ior && *material.ior > 0 && *material.ior < 1)
      Place(place, "ior").fail(fmt::format("{:g}; allowed: 0, or 1 to 1000", *material.ior));
  } else if (name == "KHR_materials_specular") {
    read_key(extension, "specularFactor", place, kFactor, material.specular);
    // The extension allows colours above 1, and clamps the reflectance.
    read_key(extension, "specularColorFactor", place, {.least = 0, .most = 1e6},
             material.specular_color);
    note_textures(extension, {"specularTexture", "specularColorTexture"}, material);
  } else if (name == "KHR_materials_pbrSpecularGlossiness") {
    material.has_specular_glossiness = true;
    read_key(extension, "glossinessFactor", place, kFactor, material.glossiness);
    read_key(extension, "specularFactor", place, kFactor, material.specular_color);
    note_textures(extension, {"specularGlossinessTexture"}, material);
  } else {
    material.other_extensions.push_back(name);
  }
}

GltfMaterial read_material(const Json& json, const Place& place) {
  if (!json.is_object()) place.fail("not an object");
  GltfMaterial material;
  read_key(json, "name", place, {}, material.name);
  if (const Json* pbr = object_of(json, "pbrMetallicRoughness", place)) {
    const Place here(place, "pbrMetallicRoughness");
    read_key(*pbr, "roughnessFactor", here, kFactor, material.roughness);
    read_key(*pbr, "metallicFactor", here, kFactor, material.metallic);
    read_key(*pbr, "baseColorFactor", here, kFactor, material.base_color);
    note_textures(*pbr, {"metallicRoughnessTexture"}, material);
  }
  const Json* extensions = object_of(json, "extensions", place);
  if (!extensions) return material;
  const Place here(place, "extensions");
  for (const auto& [name, extension] : extensions->items()) {
    const Place there(here, name);
    if (!extension.is_object()) there.fail("not an object");
    read_extension(name, extension, there, material);
  }
  return material;
}

/// Keeps only the materials of the file, whose buffers may be large.
Json materials_alone(std::string_view text, const Place& top) {
  constexpr int kMostDepth = 64;
  using Event = Json::parse_event_t;
  return Json::parse(text, [&](int depth, Event event, Json& json) {
    if (depth > kMostDepth) top.fail(fmt::format("nested deeper than {} levels", kMostDepth));
    return event != Event::key || depth != 1 || json == "materials";
  });
}

}  // namespace

std::vector<GltfMaterial> parse_gltf_materials(std::string_view text, const std::string& where,
                                               std::size_t most) try {
  const Place top;
  const Json json = materials_alone(text, top);
  if (!json.is_object()) top.fail("not a glTF: its JSON is no object");
  std::vector<GltfMaterial> materials;
  const auto list = json.find("materials");
  if (list == json.end()) return materials;
  const Place place(top, "materials");
  if (!list->is_array()) place.fail("not a list");
  if (list->size() > most)
    place.fail(fmt::format("{} items; allowed: at most {}", list->size(), most));
  for (std::size_t i = 0; i < list->size(); ++i)
    materials.push_back(read_material((*list)[i], Place(place, i)));
  return materials;
} catch (const Json::exception& error) {
  throw Error(ExitCode::kInput, "{}: not a glTF: {}", where, printable(error.what(), 200));
} catch (const Error& error) {
  throw Error(error.code(), where + ": " + error.what());
}

}  // namespace lobelia::records

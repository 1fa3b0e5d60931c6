// glTF 2.0 with KHR_lights_punctual and KHR_materials_specular. Its materials are microfacet models, so a highlight is only near to
// ours; the exact one is in the material's extras.
#include "records/gltf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base64.hpp"
#include "core/version.hpp"
#include "records/record.hpp"
#include "reference_scenes/formats/formats.hpp"
#include "renderer/frame.hpp"

namespace lobelia {
namespace {

constexpr int kFloats = 5126, kShorts = 5123;               ///< component types
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;  ///< of buffer views
constexpr int kAround = 64, kDown = 32;                     ///< faces of a sphere
/// KHR_materials_specular scales the reflectance of a refractive index of 1.5.
constexpr double kSpecularOfGlass = 0.04;
/// Half the side of the square that stands for a plane, in extents of the scene.
constexpr double kPlaneSize = 100;

struct Geometry {
  std::vector<float> positions, normals;
  std::vector<std::uint16_t> indices;
};

/// A unit sphere with its poles on the y axis, so that its positions are also its normals.
Geometry unit_sphere() {
  Geometry g;
  for (int row = 0; row <= kDown; ++row)
    for (int column = 0; column <= kAround; ++column) {
      const double down = kPi * row / kDown, turn = 2 * kPi * column / kAround;
      for (const double v :
           {std::sin(down) * std::sin(turn), std::cos(down), std::sin(down) * std::cos(turn)})
        g.positions.push_back(float(v));
    }
  g.normals = g.positions;
  const auto corner = [](int row, int column) {
    return std::uint16_t(row * (kAround + 1) + column);
  };
  for (int row = 0; row < kDown; ++row)
    for (int column = 0; column < kAround; ++column) {
      const auto a = corner(row, column), b = corner(row + 1, column),
                 c = corner(row + 1, column + 1), d = corner(row, column + 1);
      // At the poles one of the two has no area.
      if (row < kDown - 1) g.indices.insert(g.indices.end(), {a, b, c});
      if (row > 0) g.indices.insert(g.indices.end(), {a, c, d});
    }
  return g;
}

/// From -1 to 1 along x and y, facing z.
Geometry unit_square() {
  return {{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0},
          {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1},
          {0, 1, 2, 0, 2, 3}};
}

class GltfWriter {
 public:
  explicit GltfWriter(const Scene& scene) : scene_(scene) {}

  std::string write() {
    out_.asset = {"2.0", std::string(kNameAndVersion)};
    if (!scene_.materials.empty()) out_.extensions_used = {"KHR_materials_specular"};
    out_.scenes.emplace_back();
    add_camera();
    for (const Material& material : scene_.materials) add_material(material);
    if (!scene_.spheres.empty()) add_spheres();
    if (!scene_.planes.empty()) add_planes();
    for (const Light& light : scene_.lights) add_light(lamp_of(light));
    if (!bytes_.empty())
      out_.buffers.push_back(
          {bytes_.size(), "data:application/octet-stream;base64," + base64(bytes_)});
    return record_text(out_);
  }

 private:
  records::GltfNode& add_node(std::string name) {
    out_.scenes.front().nodes.push_back(int(out_.nodes.size()));
    out_.nodes.emplace_back().name = std::move(name);
    return out_.nodes.back();
  }
  static std::array<double, 16> columns(Vec3 x, Vec3 y, Vec3 z, Vec3 origin) {
    return {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, origin.x, origin.y, origin.z, 1};
  }

  void add_camera() {
    const CameraFrame frame = camera_frame(scene_.camera, scene_.film);
    records::GltfCamera camera;
    camera.type = "perspective";
    camera.perspective = {double(frame.width) / frame.height, 2 * std::atan(frame.half_height),
                          1e-3 * length(scene_.camera.target - scene_.camera.origin)};
    const records::Scene all =
        scene_record({scene_.camera, scene_.film, scene_.sampler, {}, {}, {}, {}, scene_.depth});
    camera.extras = {all.film, all.depth, all.camera.aperture_radius, all.camera.focus_distance};
    out_.cameras.push_back(std::move(camera));
    records::GltfNode& node = add_node("camera");
    node.camera = 0;
    node.matrix = columns(frame.right, frame.up, -frame.forward, frame.origin);
  }

  void add_material(const Material& material) {
    const Rgb diffuse = material.diffuse_reflectance, specular = material.specular_reflectance;
    records::GltfMaterial m;
    m.pbr_metallic_roughness = {
        {diffuse.r, diffuse.g, diffuse.b, 1}, 0, roughness_of(material.highlight)};
    m.extensions.specular.specular_color_factor = triple(1 / kSpecularOfGlass * specular);
    m.extras = material_record(material);
    out_.materials.push_back(std::move(m));
  }

  /// The accessor of new numbers in the buffer.
  template <class T>
  int add_accessor(const std::vector<T>& numbers, std::size_t each, int component, int target,
                   const char* type) {
    out_.buffer_views.push_back({0, bytes_.size(), numbers.size() * sizeof(T), target});
    records::GltfAccessor accessor{
        int(out_.buffer_views.size()) - 1, component, numbers.size() / each, type, {}, {}};
    for (std::size_t axis = 0; target == kVertexTarget && axis < each; ++axis) {
      T least = numbers[axis], most = numbers[axis];
      for (std::size_t i = axis; i < numbers.size(); i += each)
        least = std::min(least, numbers[i]), most = std::max(most, numbers[i]);
      accessor.min.push_back(double(least));
      accessor.max.push_back(double(most));
    }
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    out_.accessors.push_back(std::move(accessor));
    return int(out_.accessors.size()) - 1;
  }

  records::GltfPrimitive add_geometry(const Geometry& geometry) {
    records::GltfPrimitive primitive;
    primitive.attributes = {add_accessor(geometry.positions, 3, kFloats, kVertexTarget, "VEC3"),
                            add_accessor(geometry.normals, 3, kFloats, kVertexTarget, "VEC3")};
    primitive.indices = add_accessor(geometry.indices, 1, kShorts, kIndexTarget, "SCALAR");
    return primitive;
  }

  /// The mesh of this geometry with that material.
  int mesh_of(records::GltfPrimitive geometry, int material) {
    const auto [mesh, is_new] =
        meshes_.try_emplace({geometry.indices, material}, int(out_.meshes.size()));
    geometry.material = material;
    if (is_new) out_.meshes.push_back({{geometry}});
    return mesh->second;
  }

  void add_spheres() {
    const records::GltfPrimitive geometry = add_geometry(unit_sphere());
    for (std::size_t i = 0; i < scene_.spheres.size(); ++i) {
      const Sphere& sphere = scene_.spheres[i];
      records::GltfNode& node = add_node(fmt::format("sphere {}", i));
      node.mesh = mesh_of(geometry, sphere.material);
      node.translation = triple(sphere.center);
      node.scale = records::Triple{sphere.radius, sphere.radius, sphere.radius};
    }
  }

  void add_planes() {
    const records::GltfPrimitive geometry = add_geometry(unit_square());
    double size = length(scene_.camera.target - scene_.camera.origin);
    for (const Sphere& sphere : scene_.spheres)
      size = std::max(size, length(sphere.center - scene_.camera.origin) + sphere.radius);
    size *= kPlaneSize;
    for (std::size_t i = 0; i < scene_.planes.size(); ++i) {
      const Plane& plane = scene_.planes[i];
      out_.materials[std::size_t(plane.material)].double_sided = true;
      const Tangents t = tangents(plane.normal);
      // Below the camera, because a plane's point may be far off.
      const Vec3 away = scene_.camera.origin - plane.point;
      records::GltfNode& node = add_node(fmt::format("plane {}", i));
      node.mesh = mesh_of(geometry, plane.material);
      node.matrix = columns(size * t.first, size * t.second, plane.normal,
                            scene_.camera.origin - dot(away, plane.normal) * plane.normal);
    }
  }

  void add_light(const Lamp& lamp) {
    const Rgb s = lamp.strength;
    const double most = std::max({s.r, s.g, s.b});
    const records::Triple colour = most > 0 ? triple(1 / most * s) : records::Triple{1, 1, 1};
    if (!out_.extensions) {
      out_.extensions.emplace();
      out_.extensions_used.push_back("KHR_lights_punctual");
    }
    auto& lights = out_.extensions->lights.lights;
    records::GltfNode& node = add_node(fmt::format("light {}", lights.size()));
    node.extensions.emplace().lights.light = int(lights.size());
    lights.push_back({lamp.is_distant ? "directional" : "point", colour, most});
    if (lamp.is_distant) {
      // It shines along its -z.
      const Tangents t = tangents(-lamp.direction);
      node.matrix = columns(t.first, t.second, -lamp.direction, {});
    } else {
      node.translation = triple(lamp.position);
    }
  }

  const Scene& scene_;
  records::Gltf out_;
  std::string bytes_;
  std::map<std::pair<int, int>, int> meshes_;  ///< by the accessor of the indices and the material
};

std::string why_not_gltf(const Scene& scene) {
  if (std::string why = why_not_so_many_spheres(scene); !why.empty()) return why;
  for (const Light& light : scene.lights) {
    if (!is_delta(light)) return "it has a light with a size, and KHR_lights_punctual has none";
    if (lamp_of(light).has_normal())
      return "a point light falls with the cosine to its normal, and KHR_lights_punctual has no such light";
  }
  for (const Plane& plane : scene.planes)
    if (plane.checker_material != plane.material) return "it has a checker, which takes a texture";
  if (std::ranges::any_of(scene.materials, is_mirror))
    return "it has a mirror on top of a highlight, and a material of glTF has one roughness";
  if (scene.camera.principal_point_offset_x != 0 || scene.camera.principal_point_offset_y != 0)
    return "its principal point is off centre, and glTF's cameras have no such offset";
  return {};
}

}  // namespace

constinit const SceneFormat kGltfFormat{
    "gltf-lights",
    "glTF 2.0",
    "scene.gltf",
    "meshes, camera and KHR_lights_punctual; highlights become the nearest roughness, with the exact model in extras",
    why_not_gltf,
    [](const Scene& scene) {
      return std::map<std::string, std::string>{{"scene.gltf", GltfWriter(scene).write()}};
    },
};

}  // namespace lobelia

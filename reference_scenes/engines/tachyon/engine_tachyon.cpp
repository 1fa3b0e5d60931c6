// engine_tachyon: renders by Tachyon's library.
#include <tachyon.h>

#include <stdexcept>

#include "reference_scenes/engines/programs/scene_program.hpp"

namespace lobelia {
namespace {

apivector vector_of(const Three& v) { return {v[0], v[1], v[2]}; }
apicolor colour_of(const Three& c) { return {float(c[0]), float(c[1]), float(c[2])}; }

/// Tachyon has one highlight for all of a scene.
int phong_shader(const CameraScene& scene) {
  std::string kind = "none";
  for (const auto& material : scene.materials) {
    if (material.kind == "none") continue;
    if (kind != "none" && kind != material.kind)
      throw std::runtime_error("two kinds of highlights");
    kind = material.kind;
  }
  return kind == "phong"     ? RT_SHADER_PHONG
         : kind == "blinn"   ? RT_SHADER_BLINN
         : kind == "schlick" ? RT_SHADER_BLINN_FAST
                             : RT_SHADER_NULL_PHONG;
}

/// Looks along +z with x to the right, as the scene does.
void set_camera(SceneHandle tachyon, const CameraScene& scene) {
  rt_camera_setup(tachyon, 1, 1, 0, 4, {0, 0, 0}, {0, 0, 1}, {0, 1, 0});
  rt_camera_projection(tachyon, RT_PROJECTION_PERSPECTIVE);
  // The rays of a pixel start at its upper right corner.
  const double x = 0.5 * (scene.right - scene.left) / scene.width,
               y = 0.5 * (scene.top - scene.bottom) / scene.height;
  rt_camera_frustum(tachyon, scene.left - x, scene.right - x, scene.bottom - y, scene.top - y);
}

void add_lights(SceneHandle tachyon, const CameraScene& scene) {
  for (const auto& light : scene.lights) {
    apitexture texture{};
    texture.col = colour_of(light.strength);
    texture.opacity = 1;
    void* const colour = rt_texture(tachyon, &texture);
    if (light.is_distant) {
      const Three& to = light.place;
      rt_directional_light(tachyon, colour, {-to[0], -to[1], -to[2]});
    } else {
      constexpr double kUnseen = 1e-6;
      rt_light_attenuation(rt_light(tachyon, colour, vector_of(light.place), kUnseen), 0, 0, 1);
    }
  }
}

void add_surfaces(SceneHandle tachyon, const CameraScene& scene) {
  std::vector<void*> textures;
  for (const auto& material : scene.materials) {
    apitexture texture{};
    texture.col = colour_of(material.diffuse);
    texture.diffuse = 1;
    texture.opacity = 1;
    texture.shadowcast = 1;
    textures.push_back(rt_texture(tachyon, &texture));
    rt_tex_phong(textures.back(), material.strength, material.exponent, RT_PHONG_PLASTIC);
  }
  for (const auto& sphere : scene.spheres)
    rt_sphere(tachyon, textures.at(sphere.material), vector_of(sphere.centre), sphere.radius);
  for (const auto& plane : scene.planes)
    rt_plane(tachyon, textures.at(plane.material), vector_of(plane.point), vector_of(plane.normal));
}

std::vector<float> render(const CameraScene& scene) {
  std::vector<float> rgb(3 * std::size_t(scene.width) * std::size_t(scene.height));
  SceneHandle tachyon = rt_newscene();
  rt_resolution(tachyon, scene.width, scene.height);
  rt_verbose(tachyon, 0);
  rt_rawimage_rgb96f(tachyon, rgb.data());
  rt_set_numthreads(tachyon, 1);
  rt_shadermode(tachyon, RT_SHADER_FULL);
  rt_phong_shader(tachyon, phong_shader(scene));
  rt_background(tachyon, {0, 0, 0});
  set_camera(tachyon, scene);
  add_lights(tachyon, scene);
  add_surfaces(tachyon, scene);
  rt_renderscene(tachyon);
  rt_deletescene(tachyon);
  return rgb;
}

/// The version in its headers: the library does not tell.
std::string version() { return "Tachyon " TACHYON_VERSION_STRING; }

}  // namespace
}  // namespace lobelia

int main(int argc, char** argv) {
  int none = 1;
  char** const first = argv;
  rt_initialize(&none, const_cast<char***>(&first));
  return lobelia::run_scene_program(argc, argv, lobelia::version, lobelia::render);
}

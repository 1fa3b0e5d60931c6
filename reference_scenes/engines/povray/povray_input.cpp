#include "reference_scenes/engines/povray/povray_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "base/system/files.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/formats/catalogue.hpp"
#include "reference_scenes/preparation.hpp"
#include "reference_scenes/replicates.hpp"
#include "renderer/export/povray.hpp"
#include "renderer/frame.hpp"
#include "renderer/peak_bound.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/scene/contact.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view lobelia_scene_inc;
}
namespace {

/// Half of the largest half float (65504), to leave room for the rounding of the bound.
constexpr double kHighestHalf = 3e4;
/// POV-Ray's shadows have tolerances up to 1e-3, and the brightest point near a lamp sets the gain. At 1e-2 every pixel was
/// right, at 1e-3 one in ten was off, and at 1e-4 light came through planes.
constexpr double kNearestLamp = 5e-3;
/// Keeps lamp colours within the range of float32, which POV-Ray stores them in.
constexpr int kMaxGainStops = 60;

std::string sdl(double value) { return exact_text(value); }
std::string sdl(Vec3 v) { return fmt::format("<{}, {}, {}>", sdl(v.x), sdl(v.y), sdl(v.z)); }
std::string sdl(Rgb c) { return fmt::format("<{}, {}, {}>", sdl(c.r), sdl(c.g), sdl(c.b)); }

bool is_grey(Rgb c) { return c.r == c.g && c.g == c.b; }

/// POV-Ray has two models itself, with the lobe cos^n, in the lamp's colour and without a Fresnel factor. Their coefficients
/// are exact in the paper, too.
bool has_native_highlight(const Material& material) {
  const std::string_view model = info(material.highlight.model).name;
  return (model == "phong_rdf" || model == "blinn_phong_rdf") &&
         info(material.highlight.lobe).name == "cosine" && material.fresnel == Fresnel::kNone &&
         is_grey(material.specular_reflectance);
}

/// Whether POV-Ray's own shading is used. With `expressed`, only for materials without a highlight.
bool is_native(const Material& material, bool expressed) {
  return !has_highlight(material) || (!expressed && has_native_highlight(material));
}

std::string lamp_text(const Lamp& lamp, const Scene& scene, double closeness) {
  if (lamp.is_distant) {
    // Beyond all that is visible of an infinite plane, but within POV-Ray's farthest ray, 1e7.
    const double far = scene.planes.empty() ? 1000 * extent(scene) : 1e6;
    return fmt::format("Lobelia_Directional_Light({}, {}, {})\n", sdl(lamp.direction),
                       sdl(lamp.strength), sdl(far));
  }
  const double nearest = nearest_surface(lamp, scene, closeness);
  if (lamp.spot)
    return fmt::format("Lobelia_Spot_Light({}, {}, {}, {}, {}, {})\n", sdl(lamp.position),
                       sdl(lamp.normal), sdl(lamp.strength), sdl(nearest), sdl(lamp.spot->beam),
                       sdl(lamp.spot->cutoff));
  if (lamp.has_normal())
    return fmt::format("Lobelia_Surface_Light({}, {}, {}, {})\n", sdl(lamp.position),
                       sdl(lamp.normal), sdl(lamp.strength), sdl(nearest));
  return fmt::format("Lobelia_Point_Light({}, {}, {})\n", sdl(lamp.position), sdl(lamp.strength),
                     sdl(nearest));
}

std::string native_texture(const Material& material) {
  const char* which = !has_highlight(material) ? "Lobelia_Native_None"
                      : info(material.highlight.model).angle == LobeAngle::kReflection
                          ? "Lobelia_Native_Phong"
                          : "Lobelia_Native_Specular";
  return fmt::format("Lobelia_Native_Texture({}, {}, {}, {}, {})", which,
                     sdl(material.highlight.exponent), sdl(material.specular_reflectance.r),
                     sdl(material.diffuse_reflectance), sdl(material.mirror_reflectance));
}

std::string expressed_texture(const Material& material) {
  const PovrayNames names = povray_names(material.highlight);
  const std::string exponent = sdl(material.highlight.exponent);
  return fmt::format("Lobelia_Texture({}, {}({}), {}, {}, {}, {}, {})", names.pattern,
                     names.coefficient, exponent, exponent, names.brilliance,
                     material.fresnel == Fresnel::kSchlick ? 1 : 0,
                     sdl(material.specular_reflectance), sdl(material.diffuse_reflectance));
}

/// Declares a texture for the surface with the last declared normal, and returns its name.
std::string declare_texture(std::string& scene, const Material& material, bool expressed,
                            int& count) {
  const std::string name = fmt::format("Lobelia_Texture_{}", count++);
  scene += fmt::format(
      "#declare {} = {}\n", name,
      is_native(material, expressed) ? native_texture(material) : expressed_texture(material));
  return name;
}

std::string surfaces_text(const Scene& scene, bool expressed) {
  std::string text;
  int textures = 0;
  const auto texture = [&](int material) {
    return declare_texture(text, scene.materials.at(std::size_t(material)), expressed, textures);
  };
  for (const Sphere& sphere : scene.spheres) {
    const std::string place = fmt::format("{}, {}", sdl(sphere.center), sdl(sphere.radius));
    text += fmt::format("Lobelia_Sphere_Normal({})\n", place);
    text += fmt::format("Lobelia_Sphere({}, {})\n", place, texture(sphere.material));
  }
  for (const Plane& plane : scene.planes) {
    const std::string place = fmt::format("{}, {}", sdl(plane.point), sdl(plane.normal));
    text += fmt::format("Lobelia_Plane_Normal({})\n", place);
    const std::string first = texture(plane.material);
    if (plane.checker_material == plane.material) {
      text += fmt::format("Lobelia_Plane({}, {})\n", place, first);
      continue;
    }
    const std::string second = texture(plane.checker_material);
    const Tangents along = tangents(plane.normal);
    text += fmt::format("Lobelia_Checker({}, {}, {}, {}, {}, {})\n", place, sdl(along.first),
                        sdl(along.second), sdl(plane.checker_size), first, second);
  }
  return text;
}

/// The materials of all surfaces.
std::vector<const Material*> materials_in_use(const Scene& scene) {
  std::vector<const Material*> used;
  const auto add = [&](int material) {
    used.push_back(&scene.materials.at(std::size_t(material)));
  };
  for (const Sphere& sphere : scene.spheres) add(sphere.material);
  for (const Plane& plane : scene.planes) {
    add(plane.material);
    add(plane.checker_material);
  }
  return used;
}

/// The largest factor of a model's shadowing at the pixels' centres. Half floats have no room for the largest there is: the
/// tail of a sharp highlight would lose digits.
std::optional<double> shadowing_in(const Scene& scene, const std::vector<Light>& lights) {
  const bool any = std::ranges::any_of(materials_in_use(scene), [](const Material* m) {
    return info(m->highlight.model).has_shadowing;
  });
  if (!any || !beyond_single_rays(scene).empty()) return std::nullopt;
  double largest = 1;
  for (int k = 0; k < int(scene.spheres.size()); ++k) {
    const Sphere& sphere = scene.spheres[std::size_t(k)];
    const Highlight& h = scene.materials.at(std::size_t(sphere.material)).highlight;
    if (!info(h.model).has_shadowing) continue;
    for_each_pixel_of(scene, k, [&](std::size_t, const Hit& hit, Vec3 to_eye) {
      for (const Light& light : lights)
        if (const double n_dot_l = dot(hit.normal, illuminate(light, hit.point).to_light);
            n_dot_l > 0)
          largest = std::max(largest, geometry_factor(h.model, h.exponent, n_dot_l,
                                                      std::max(0.0, dot(hit.normal, to_eye))));
    });
  }
  return largest;
}

PovrayPass pass_of(const Scene& scene, const std::vector<Light>& lights, const PovrayInput& input,
                   bool expressed) {
  PovrayPass pass;
  const double bound = peak_bound(scene, lights, shadowing_in(scene, lights));
  if (bound > 0)
    pass.gain = std::exp2(std::clamp(std::floor(std::log2(kHighestHalf / bound)),
                                     -double(kMaxGainStops), double(kMaxGainStops)));
  // Set in the scene, because the command line rounds to six digits.
  pass.view = "#version 3.7;\n";
  for (const auto& include : input.includes)
    pass.view += fmt::format("#include \"{}\"\n", include.first);
  pass.view += fmt::format("Lobelia_Begin({}, {})\n", sdl(pass.gain),
                           has_mirror(scene) ? scene.depth.mirror : 0);
  const Camera& camera = scene.camera;
  pass.view += fmt::format(
      "Lobelia_Camera({}, {}, {}, {}, {}/{}, {}, {})\n", sdl(camera.origin), sdl(camera.target),
      sdl(camera.up), sdl(camera.fov_degrees), scene.film.width, scene.film.height,
      sdl(camera.principal_point_offset_x), sdl(camera.principal_point_offset_y));
  const double close = closeness(scene);
  for (const Light& light : lights) pass.surfaces += lamp_text(lamp_of(light), scene, close);
  pass.surfaces += surfaces_text(scene, expressed);
  return pass;
}

bool all_native(const Scene& scene, bool expressed) {
  return std::ranges::all_of(materials_in_use(scene),
                             [&](const Material* m) { return is_native(*m, expressed); });
}

std::string ini_text(const std::string& stem, double gain,
                     const std::vector<std::string>& options) {
  return fmt::format(
      "; {0} times too bright, for half floats. The passes, divided by theirs, add up.\n"
      "Input_File_Name={1}.pov\nOutput_File_Name={1}.exr\n{2}\n",
      exact_text(gain), stem, fmt::join(options, "\n"));
}

}  // namespace

std::string povray_pass_stem(std::size_t pass) { return fmt::format("pass{}", pass); }

std::string PovrayPass::rest(const std::string& coarse) const {
  return fmt::format("{}Lobelia_Take_Away(\"{}\")\n{}", view, coarse, surfaces);
}

std::string why_not_in_povray(const Scene& scene, const ReferenceOptions& options) {
  if (std::string why = why_not_for_programs(scene); !why.empty()) return why;
  if (const std::string lamp = lamp_on_sphere(scene); !lamp.empty())
    return lamp + ", and in POV-Ray a rounding decides whether the sphere hides it";
  if (const std::string lamp = lamp_close_to_surface(scene, kNearestLamp); !lamp.empty())
    return lamp + ", and POV-Ray's shadows do not tell the two apart";
  if (options.shading == Shading::kNative && !all_native(scene, false))
    return "POV-Ray has itself only the highlights of Phong (RDF) and Blinn-Phong (RDF) with cos^n, grey "
           "and without Fresnel";
  if (!has_mirror(scene)) return {};
  if (options.fine)
    return "what POV-Ray's half floats round off in a mirror it cannot take away again";
  if (!all_native(scene, options.shading == Shading::kReimplemented))
    return "a highlight that POV-Ray does not have itself is a function of the camera's place there, "
           "and a mirror shows it from another";
  return {};
}

PovrayInput povray_input(const Scene& scene, const ReferenceOptions& options) {
  const bool expressed = options.shading == Shading::kReimplemented;
  PovrayInput input;
  input.native = all_native(scene, expressed);
  input.includes["lobelia_scene.inc"] = embedded::lobelia_scene_inc;
  for (const Material* material : materials_in_use(scene))
    if (!is_native(*material, expressed))
      input.includes[povray_names(material->highlight).file] =
          povray_text(std::span(&material->highlight, 1));
  if (input.native)
    input.passes.push_back(pass_of(scene, scene.lights, input, expressed));
  else
    for (const Light& light : scene.lights)
      input.passes.push_back(pass_of(scene, {light}, input, expressed));
  return input;
}

std::vector<std::string> povray_options(const Film& film, int threads) {
  return {"Output_to_File=on",
          "Output_File_Type=E",  // OpenEXR: always half float
          fmt::format("Width={}", film.width), fmt::format("Height={}", film.height),
          "Antialias=off",  // one ray through the middle of the pixel
          "Jitter=off", "Quality=9", "Output_Alpha=off",
          "Display=off",  // no window
          "Pause_When_Done=off",
          "Continue_Trace=off",  // never resume an older picture
          // Not All_Console, which would hide errors too.
          "Debug_Console=off", "Render_Console=off", "Statistic_Console=off", "Verbose=off",
          fmt::format("Work_Threads={}", threads)};
}

std::map<std::string, std::string> povray_files(const Scene& scene,
                                                const ReferenceOptions& options) {
  const PovrayInput input = povray_input(in_engine_units(scene), options);
  std::map<std::string, std::string> files = input.includes;
  std::string& commands = files["povray.sh"];
  for (std::size_t p = 0; p < input.passes.size(); ++p) {
    const std::string stem = povray_pass_stem(p);
    const auto add = [&](const std::string& name, const std::string& text) {
      files[name + ".pov"] = text;
      files[name + ".ini"] = ini_text(name, input.passes[p].gain, povray_options(scene.film, 1));
      commands += fmt::format("povray {}.ini\n", name);
    };
    add(stem, input.passes[p].scene());
    if (options.fine) {
      commands += fmt::format("# Twice this one's picture is to be added to {}.exr.\n", stem);
      add(stem + "-rest", input.passes[p].rest(stem + ".exr"));
    }
  }
  return files;
}

void write_povray_ini(const std::filesystem::path& directory, const std::string& stem, double gain,
                      const std::vector<std::string>& options) {
  write_file(directory / (stem + ".ini"), ini_text(stem, gain, options));
}

std::vector<std::string> povray_home(const std::filesystem::path& home,
                                     const std::string& version) {
  const auto minor = version.find('.') + 1;
  const std::filesystem::path settings =
      home / ".povray" / version.substr(0, version.find('.', minor));
  make_directories(settings);
  write_file(settings / "povray.conf",
             "[File I/O Security]\nrestricted\n"
             "[Shellout Security]\nforbidden\n"
             "[Permitted Paths]\nread* = %INSTALLDIR%/include\nread+write = .\n");
  write_file(home / "povray.ini", "; In place of the system's and the user's.\n");
  std::vector<std::string> environment = engine_environment(home);
  environment.push_back(fmt::format("POVINI={}", (home / "povray.ini").string()));
  return environment;
}

namespace {

std::string why_not_povray_scene(const Scene& scene) {
  if (std::string why = why_not_so_many_spheres(scene); !why.empty()) return why;
  if (std::string why = why_not_comparable(scene); !why.empty()) return why;
  if (needs_replicates(scene))
    return "its picture is the average of many of POV-Ray's: it has a light with a size, a lens or several samples "
           "per pixel ('lobelia reference --engine povray --keep-input DIR' writes them)";
  return why_not_in_povray(scene, {});
}

}  // namespace

constinit const SceneFormat kPovrayFormat{
    "povray",
    "POV-Ray",
    "pass0.pov",
    "a directory of .pov, .ini and .inc files; 'sh povray.sh' renders them. Models that POV-Ray lacks take a pass "
    "for each light",
    why_not_povray_scene,
    [](const Scene& scene) { return povray_files(scene); },
};

}  // namespace lobelia

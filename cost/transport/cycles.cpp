#include "cost/transport/cycles.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>
#include <thread>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/process.hpp"
#include "core/text.hpp"
#include "reference_scenes/engine_program.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view cycles_jobs_py;
}
namespace cost {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(Rgb c) { return Json::array({c.r, c.g, c.b}); }
/// From our axes to Blender's, so that its pole, +z, is our +y, and its middle column of a sky, +x, is our
/// -z: then images by latitude and longitude are the same.
Json in_blender(Vec3 v) { return Json::array({-v.z, -v.x, v.y}); }

Json light_json(const Light& light, const std::filesystem::path& directory) {
  if (is_environment(light))
    return {{"kind", "environment"}, {"file", (directory / picture_file(light)).string()}};
  const auto vector = [&](const char* name) {
    return in_blender(std::get<Vec3>(value_of(light, name)));
  };
  return {{"kind", "rectangle"},
          {"center", vector("center")},
          {"halfU", vector("half_u")},
          {"halfV", vector("half_v")},
          {"radiance", strength(light).r}};
}

Json job_json(const Scene& scene, const std::filesystem::path& directory,
              const std::vector<CyclesPicture>& pictures) {
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const Sphere& sphere = scene.spheres.front();
  const Plane& floor = scene.planes.front();
  const auto colour = [&](int material) {
    return to_json(scene.materials[std::size_t(material)].diffuse_reflectance);
  };
  Json job = {
      {"threads", std::max(1u, std::thread::hardware_concurrency())},
      {"bounces", scene.depth.glossy},
      {"camera",
       {{"origin", in_blender(frame.origin)},
        {"right", in_blender(frame.right)},
        {"up", in_blender(frame.up)},
        {"forward", in_blender(frame.forward)},
        {"halfWidth", frame.half_width}}},
      {"sphere",
       {{"center", in_blender(sphere.center)},
        {"radius", sphere.radius},
        {"colour", colour(sphere.material)}}},
      {"floor", {{"halfSize", 300}, {"height", floor.point.y}, {"colour", colour(floor.material)}}},
      {"light", light_json(scene.lights.front(), directory)},
      {"renders", Json::array()}};
  for (std::size_t i = 0; i < pictures.size(); ++i)
    job["renders"].push_back({{"name", fmt::format("picture{}", i)},
                              {"width", pictures[i].width},
                              {"height", pictures[i].height},
                              {"samples", pictures[i].samples},
                              {"seed", pictures[i].seed}});
  return job;
}

}  // namespace

double run_cycles(const std::filesystem::path& program, const Scene& scene,
                  const std::filesystem::path& directory, std::vector<CyclesPicture>& pictures) {
  write_file(directory / "cycles_jobs.py", embedded::cycles_jobs_py);
  write_file(directory / "job.json", job_json(scene, directory, pictures).dump());
  ProcessOptions options;
  options.working_directory = options.writable = options.progress_directory = directory;
  options.environment = engine_environment(directory);
  options.only_environment = true;
  options.timeout = std::chrono::minutes(10);
  options.no_progress_limit = std::chrono::minutes(5);
  std::size_t done = 0;
  options.on_line = [&](std::string_view line) {
    const auto words = split(line, " ");
    if (words.size() == 4 && words[0] == "lobelia:" && words[1] == "done")
      parse_number(words[3], pictures.at(done++).seconds);
  };
  const ProcessResult ended =
      run_process({program.string(), "-b", "--factory-startup", "-noaudio", "--python-exit-code",
                   "9", "--python", (directory / "cycles_jobs.py").string(), "--",
                   (directory / "job.json").string()},
                  options);
  if (ended.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  if (ended.exit_code != 0 || done != pictures.size())
    throw Error(ExitCode::kEngine, fmt::format("Blender stopped with exit code {}: {}",
                                               ended.exit_code, last_words(ended.output_tail)));
  for (std::size_t i = 0; i < pictures.size(); ++i)
    pictures[i].image = read_image(directory / fmt::format("picture{}.exr", i));
  return ended.seconds;
}

}  // namespace cost
}  // namespace lobelia

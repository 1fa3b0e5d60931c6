#include <fmt/format.h>

#include "bench/sections.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::bench {

void sizes(const std::string& program) {
  const TemporaryDirectory directory;
  const std::string output = (directory.path() / "a.exr").string();
  fmt::print(
      "\nWhole commands, from start to file: lobelia render head_on.xml, all processors; median of 5\n");
  fmt::print("{:>8}{:>10}{:>12}{:>14}{:>12}{:>12}{:>10}\n", "side", "s", "Mpixel/s", "processor s",
             "peak MiB", "picture MiB", "file MiB");
  double start_up = 0, last = 0;
  for (const int side : {16, 256, 512, 1024, 2048, 4096, 8192}) {
    std::vector<double> seconds;
    ProcessResult command;
    const int rounds = side > 2048 ? 3 : 5;
    for (int round = 0; round < rounds; ++round) {
      command = render_file(program, "head_on", side, side, output);
      seconds.push_back(command.seconds);
    }
    const Times t = summary(seconds);
    if (side == 16) start_up = t.median;
    last = t.median;
    fmt::print("{:>8}{:>10.3f}{:>12.1f}{:>14.3f}{:>12.0f}{:>12.1f}{:>10.2f}\n", side, t.median,
               1e-6 * side * side / t.median, command.cpu_seconds,
               double(command.peak_memory_bytes) / (1 << 20), 12.0 * side * side / (1 << 20),
               double(std::filesystem::file_size(output)) / (1 << 20));
  }
  Scene scene = read_scene(scene_file("head_on"));
  scene.film.width = scene.film.height = 8192;
  const RenderResult result = render(scene, {});
  const double render_seconds = result.render_seconds;
  const double write_seconds = seconds_of([&] { write_exr(output, result.image, {}); });
  fmt::print(
      "Limit: start-up for small pictures ({:.0f} ms at 16 x 16); at 8192 x 8192 {} ({:.2f} s of {:.2f} s; rendering "
      "takes {:.2f} s).\n",
      1e3 * start_up, write_seconds > render_seconds ? "packing and writing the file" : "rendering",
      std::max(write_seconds, render_seconds), last, render_seconds);
}

void exr() {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory.path() / "a.exr";
  fmt::print(
      "\nWriting an EXR, flushed to the disk, all processors; median of 5 interleaved rounds\n");
  fmt::print("{:<14}{:>6}  {:<16}{:>9}{:>9}{:>10}{:>10}\n", "picture", "side", "compression", "ms",
             "spread", "MiB", "of raw");
  double none = 0, chosen = 0;
  for (const char* name : {"head_on", "two_spheres"})
    for (const int side : {1024, 4096}) {
      Scene scene = read_scene(scene_file(name));
      scene.film.width = scene.film.height = side;
      const Image image = render(scene, {}).image;
      const auto pixels = std::as_bytes(image.values());
      const std::vector<std::function<void()>> cases{
          [&] {
            write_file(path, {reinterpret_cast<const std::uint8_t*>(pixels.data()), pixels.size()});
          },
          [&] { write_exr(path, image, {}); }};
      const auto times = interleaved(cases, side > 1024 ? 3 : 5);
      for (std::size_t i = 0; i < cases.size(); ++i) {
        cases[i]();
        const double bytes = double(std::filesystem::file_size(path));
        fmt::print("{:<14}{:>6}  {:<16}{:>9.1f}{:>8.0f}%{:>10.2f}{:>9.1f}%\n", name, side,
                   i == 0 ? "none" : "zip", 1e3 * times[i].median, 100 * times[i].spread,
                   bytes / (1 << 20), 100 * bytes / (12.0 * side * side));
      }
      none = times[0].median;
      chosen = times[1].median;
    }
  fmt::print(
      "Limit: {}. The last picture unpacked takes {:.0f} ms, packed {:.0f} ms.\n",
      chosen < none ? "the disk where pictures are not packed, packing where they are" : "packing",
      1e3 * none, 1e3 * chosen);
}

}  // namespace lobelia::bench

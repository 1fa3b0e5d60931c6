#include <fmt/format.h>

#include <atomic>

#include "core/colour.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/numbers.hpp"
#include "farm/make_result.hpp"
#include "records/record.hpp"
#include "reference_scenes/replicates.hpp"
#include "renderer/render.hpp"
#include "renderer/render_record.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

using Clock = std::chrono::steady_clock;

/// One thread: a cell is too small to be divided, and there are as many at work as there are processors.
RenderOptions options_until(Clock::time_point end, double seconds) {
  RenderOptions options;
  options.threads = 1;
  options.on_progress = [end, seconds](double) {
    if (Clock::now() > end)
      throw ResultFailure(
          FailureClass::kTimedOut,
          fmt::format("stopped after {:.6g} s, the time limit of a picture", seconds));
  };
  return options;
}

/// The picture, once more as it is read again, and an average's error with the sums for it.
std::uint64_t memory_to_make(const Scene& scene) {
  constexpr std::uint64_t kOfPicture = 3 * sizeof(float), kOfSums = 2 * 3 * sizeof(double);
  return std::uint64_t(scene.film.width) * std::uint64_t(scene.film.height) *
         (2 * kOfPicture + (needs_replicates(scene) ? kOfPicture + kOfSums : 0));
}

}  // namespace

void make_render(const Scene& scene, ResultDraft& draft, std::chrono::duration<double> time_limit,
                 std::uint64_t memory_limit, records::Result& made) {
  if (const std::uint64_t needed = memory_to_make(scene); memory_limit > 0 && needed > memory_limit)
    throw ResultFailure(
        FailureClass::kOutOfMemory,
        fmt::format("its picture of {} x {} needs {} of memory; allowed: {}", scene.film.width,
                    scene.film.height, size_text(needed), size_text(memory_limit)));
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(time_limit);
  const RenderOptions options = options_until(end, time_limit.count());
  const std::string file = picture_file(kOurs);
  const ImageMetadata metadata = render_metadata(scene);
  const RenderResult result = render(scene, options);
  records::Render record =
      render_record(scene, result, {"lobelia", "render", "scene.xml", "-o", file}, file);
  write_exr(draft.file(file), result.image, metadata);
  // An engine's average is compared with it, by the noise of both.
  if (needs_replicates(scene)) {
    record.standard_error = error_file(kOurs);
    write_exr(draft.file(error_file(kOurs)), standard_error_of_render(scene, options), metadata);
  }
  const Image image = read_whole_picture(draft.file(file), scene);
  const double exposure = cell_exposure(image);
  write_png(draft.file(std::string(kOurs) + ".png"), to_display(image, exposure));
  records::write_record(draft.file(std::string(kOurs) + ".json"), record);
  write_file(draft.file("scene.xml"), scene_to_xml(scene));

  made.command = record.command;
  made.exposure_stops = exposure;
  if (!scene.spheres.empty())
    made.highlight =
        highlight_record(scene.materials.at(std::size_t(scene.spheres.front().material)).highlight);
  auto& warnings = made.warnings.emplace();
  for (const Material& material : scene.materials)
    if (std::string text = warning(material.highlight); !text.empty())
      warnings.push_back(std::move(text));
}

}  // namespace lobelia

#include "program/command/convert_measured.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "base/words/constants.hpp"
#include "base/words/text.hpp"
#include "program/command/commands.hpp"
#include "program/command/messages.hpp"
#include "program/command/output_files.hpp"
#include "renderer/render.hpp"
#include "renderer/render_record.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/measured/fit.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

/// DIR/NAME/SCENE.exr, and DIR/png/NAME_SCENE.png for the eye: apart, so that `lobelia compare` of two folders finds
/// pictures of linear light only.
void write_pictures(const fs::path& directory, const std::string& name, const std::string& scene,
                    const Image& picture, const ImageMetadata& metadata) {
  make_directories(directory / name);
  make_directories(directory / "png");
  write_exr(directory / name / (scene + ".exr"), picture, metadata);
  // White is a white diffuse surface that faces the light.
  write_png(directory / "png" / fmt::format("{}_{}.png", name, scene),
            to_display(picture, std::log2(kPi)));
}

void write_truth_and_fits(const fs::path& directory, const measured::MeasuredBrdf& brdf,
                          const records::MeasuredFits& fits) {
  constexpr std::size_t kFits = 3;
  std::vector<records::MeasuredFit> best = measured::best_by_model(fits);
  best.resize(std::min(best.size(), kFits));
  for (const measured::NamedScene& one : measured::canonical_scenes()) {
    write_pictures(directory, "measured", one.name, measured::measured_picture(one.scene, brdf),
                   {{"lobelia:measured", fits.file}});
    for (std::size_t i = 0; i < best.size(); ++i) {
      const Scene scene = measured::with_fit(one.scene, best[i]);
      const std::string name = fmt::format("fit_{}", i + 1);
      write_pictures(directory, name, one.name, render(scene, {}).image, render_metadata(scene));
      write_file(directory / name / (one.name + ".xml"), scene_to_xml(scene));
    }
  }
}

}  // namespace

void convert_measured(const std::string& file, const std::string& directory,
                      const std::string& json) {
  OutputFiles outputs;
  outputs.reads(file);
  outputs.writes_report(json);
  const measured::MeasuredBrdf brdf = measured::read_measured(file);
  records::MeasuredFits fits = measured::fit(brdf, measured::all_kinds());
  fits.file = printable_path(fs::path(file).filename().string());
  fits.command = command_line();
  FilesTogether files;
  if (!directory.empty()) write_truth_and_fits(directory, brdf, fits);
  write_reports(measured::fits_text(fits), {{json, record_text(fits)}}, files);
}

}  // namespace lobelia::cli

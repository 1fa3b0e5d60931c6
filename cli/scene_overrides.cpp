#include "cli/scene_overrides.hpp"

#include <fmt/format.h>

#include "cli/options.hpp"
#include "core/error.hpp"
#include "core/image.hpp"
#include "core/text.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia::cli {
namespace {

template <class Number, class Target>
void replace(const std::optional<Number>& value, std::string_view option, double min, double max,
             Target& target) {
  if (!value) return;
  // Written so that a NaN is refused too.
  if (!(double(*value) >= min && double(*value) <= max))
    throw Error(ExitCode::kUsage, fmt::format("{} {} is out of range; allowed: {:g} to {:g}",
                                              option, *value, min, max));
  target = Target(*value);
}

}  // namespace

void SceneOverrides::add_to(CLI::App& command) {
  OptionGroup group(command, "In place of what the scene says");
  group.add("--model", model_, "", fmt::format("Model: {}", join(model_names())));
  group.add("--lobe", lobe_, "", fmt::format("Lobe: {}", allowed_lobes()));
  group.add("--normalisation", normalisation_, "",
            fmt::format("Coefficient: {}", join(normalisation_names())));
  group.add("--exponent", exponent_, "",
            fmt::format("Sharpness n, {} to {:g}", kMinExponent, kMaxExponent));
  group.add("--width", width_, "", "Width of the picture in pixels");
  group.add("--height", height_, "", "Height of the picture in pixels");
  group.add("--samples", samples_, "", "Rays a pixel; 1 is the pixel's centre");
  group.add("--seed", seed_, "", "Chooses the positions of more than one sample");
}

void SceneOverrides::apply(Scene& scene) const {
  Highlight unused;  // wrong values are refused for a scene without materials too
  std::vector<Highlight*> highlights{&unused};
  for (auto& material : scene.materials) highlights.push_back(&material.highlight);
  for (Highlight* const each : highlights) {
    Highlight& highlight = *each;
    if (model_)
      highlight.model = chosen(*model_, "--model", model_names(), join(model_names()), find_model);
    if (lobe_) highlight.lobe = chosen(*lobe_, "--lobe", lobe_names(), allowed_lobes(), find_lobe);
    if (normalisation_)
      highlight.normalisation = chosen(*normalisation_, "--normalisation", normalisation_names(),
                                       join(normalisation_names()), find_normalisation);
    replace(exponent_, "--exponent", kMinExponent, kMaxExponent, highlight.exponent);
  }
  replace(width_, "--width", 1, kMaxImageSide, scene.film.width);
  replace(height_, "--height", 1, kMaxImageSide, scene.film.height);
  if (std::int64_t{scene.film.width} * scene.film.height > kMaxImagePixels)
    throw Error(ExitCode::kUsage,
                fmt::format("{} x {} pixels are too many; allowed: {} in all", scene.film.width,
                            scene.film.height, kMaxImagePixels));
  replace(samples_, "--samples", 1, 65536, scene.sampler.sample_count);
  replace(seed_, "--seed", 0, 0x1p53, scene.sampler.seed);  // what a scene file can hold
}

}  // namespace lobelia::cli

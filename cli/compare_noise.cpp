#include <tuple>

#include "cli/compare_pictures.hpp"
#include "cli/options.hpp"
#include "compare/require_same_size.hpp"
#include "compare/uncertainty/z_test.hpp"
#include "core/image_io.hpp"

namespace lobelia::cli {
void NoiseFlags::add_to(CLI::App& command) {
  OptionGroup group(command, "Noise of Monte-Carlo pictures");
  for (const auto& [letter, picture, side] :
       {std::tuple{'a', 'A', &a_}, std::tuple{'b', 'B', &b_}}) {
    auto* replicate = group.add(
        fmt::format("--{}-replicate", letter), side->replicates, "FILE|DIR",
        fmt::format(
            "Another, independent picture of what {0} is, from as many samples: {0} is their "
            "mean, and its noise what they scatter; may be given again. With one, the two "
            "are half-sample pictures",
            picture));
    replicate->expected(1)->take_all();
    group
        .add(fmt::format("--{}-error", letter), side->error, "FILE|DIR",
             fmt::format("Picture of the standard errors of {}, as render and reference "
                         "--standard-error write",
                         picture))
        ->excludes(replicate);
  }
  group
      .add_number("--freedom", freedom_, 1, 1e9,
                  "Degrees of freedom of those errors: independent estimates less one")
      ->type_name("NUMBER");
  group.add_choice(
      "--shared-noise", shared_, {"a", "b", "both", "none"},
      "Whose pixels err together, as they share their points or were filtered: a, b, both "
      "or none; default: what has a picture of errors");
  group.add_number("--significance", judged_.significance, kLeastSignificance, kMostSignificance,
                   "Chance of finding a difference beyond the noise where there is none");
  group.add_number(
      "--bootstrap", judged_.bootstraps, kFewestBootstraps, kMostBootstraps,
      "Pairs with noise that error bars are made of; each figure is measured twice as often");
  group.add_number("--noise-seed", judged_.seed, 0, 1 << 30, "Chooses that noise");
}

void NoiseFlags::apply(ComparisonOptions& options) const {
  if (a_.given() || b_.given()) options.noise = judged_;
}

std::vector<std::filesystem::path> NoiseFlags::files(const std::string& name) const {
  std::vector<std::filesystem::path> result;
  for (const Side* side : {&a_, &b_}) {
    if (!side->error.empty()) result.push_back(file_of(side->error, name));
    for (const std::string& replicate : side->replicates)
      result.push_back(file_of(replicate, name));
  }
  return result;
}

std::optional<PictureNoise> NoiseFlags::read_side(const Side& side, const std::string& letter,
                                                  const std::string& name, Image& image) const {
  const auto read = [&](const std::string& given) {
    const auto file = file_of(given, name);
    Image picture = read_image(file);
    require_same_size(image, picture, "the picture", file.string());
    return picture;
  };
  const bool shared =
      shared_.empty() ? !side.error.empty() : shared_ == letter || shared_ == "both";
  try {
    if (!side.error.empty()) return noise_of_standard_errors(read(side.error), freedom_, shared);
    if (side.replicates.empty()) return std::nullopt;
    std::vector<Image> pictures;
    for (const std::string& replicate : side.replicates) pictures.push_back(read(replicate));
    pictures.insert(pictures.begin(), std::move(image));
    NoisyPicture mean = mean_of_replicates(pictures, shared);
    image = std::move(mean.image);
    return std::move(mean.noise);
  } catch (const Error& error) {
    throw Error(error.code(),
                fmt::format("--{}-{}: {}", letter, side.error.empty() ? "replicate" : "error",
                            error.what()));
  }
}

void NoiseFlags::read(const std::string& name, Image& a, Image& b,
                      ComparisonOptions& options) const {
  if (!options.noise) return;
  options.noise->a = read_side(a_, "a", name, a);
  options.noise->b = read_side(b_, "b", name, b);
}

}  // namespace lobelia::cli

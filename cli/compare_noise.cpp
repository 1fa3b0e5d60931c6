#include <tuple>

#include "cli/common_options.hpp"
#include "cli/compare_pictures.hpp"
#include "cli/options.hpp"
#include "compare/require_same_size.hpp"
#include "compare/uncertainty/noise_layers.hpp"
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
  group.add_choice(
      "--noise-from-layers", from_layers_, {"a", "b", "both"},
      "Whose own file has its noise as layers, of Mitsuba, pbrt, old Cycles, or called "
      "StandardError (docs/pictures.md)");
  for (const auto& [letter, side] : {std::pair{'a', &a_}, {'b', &b_}})
    group
        .add(fmt::format("--{}-samples", letter), side->samples, "NUMBER",
             "Samples per pixel of that file, if it does not say them")
        ->check(between(2, 1e12));
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
  add_common(group, "--seed", judged_.seed, " of that noise")
      ->check(between(0, 1 << 30))
      ->capture_default_str();
}

void NoiseFlags::apply(ComparisonOptions& options) const {
  for (const auto& [letter, side] : {std::pair{"a", &a_}, {"b", &b_}}) {
    if (side->given() && is_from_layers(letter))
      throw Error(ExitCode::kUsage,
                  fmt::format("--noise-from-layers {0}: the noise of {0} is given twice", letter));
    if (side->samples > 0 && !is_from_layers(letter))
      throw Error(ExitCode::kUsage, fmt::format("--{}-samples is for --noise-from-layers", letter));
  }
  if (a_.given() || b_.given() || !from_layers_.empty()) options.noise = judged_;
}

bool NoiseFlags::is_from_layers(const std::string& letter) const {
  return from_layers_ == letter || from_layers_ == "both";
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
                                                  const std::string& name, const std::string& file,
                                                  Picture& picture) const {
  const auto read = [&](const std::string& given) {
    const auto other = file_of(given, name);
    Image image = read_image(other);
    require_same_size(picture.image, image, "the picture", other.string());
    return image;
  };
  const bool shared =
      shared_.empty() ? !side.error.empty() : shared_ == letter || shared_ == "both";
  const auto option = is_from_layers(letter) ? std::string("--noise-from-layers")
                      : side.error.empty()   ? fmt::format("--{}-replicate", letter)
                                             : fmt::format("--{}-error", letter);
  try {
    if (is_from_layers(letter))
      return noise_of_layers(file, picture, {side.samples, freedom_, shared});
    if (!side.error.empty()) return noise_of_standard_errors(read(side.error), freedom_, shared);
    if (side.replicates.empty()) return std::nullopt;
    std::vector<Image> pictures;
    for (const std::string& replicate : side.replicates) pictures.push_back(read(replicate));
    pictures.insert(pictures.begin(), std::move(picture.image));
    NoisyPicture mean = mean_of_replicates(pictures, shared);
    picture.image = std::move(mean.image);
    return std::move(mean.noise);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", option, error.what()));
  }
}

void NoiseFlags::read(const std::string& name, const PairReport& files, PicturePair& pair,
                      ComparisonOptions& options) const {
  if (!options.noise) return;
  options.noise->a = read_side(a_, "a", name, files.a, pair.a);
  options.noise->b = read_side(b_, "b", name, files.b, pair.b);
}

}  // namespace lobelia::cli

#include "compare/set/noise_files.hpp"

#include <fmt/format.h>

#include "base/pictures/image_io.hpp"
#include "base/words/text.hpp"
#include "compare/uncertainty/noise_layers.hpp"
#include "profile/require_same_size.hpp"

namespace lobelia {

namespace {

/// Whether the text is no file but the ending of one beside the picture.
bool is_ending(const std::string& given) { return given.starts_with('*'); }

}  // namespace

std::filesystem::path with_ending(const std::filesystem::path& picture, const std::string& ending) {
  std::filesystem::path stem = picture;
  return stem.replace_extension() += ending;
}

NoiseFiles::NoiseFiles(const CompareChoice& choice, ComparisonOptions& options)
    : a_{choice.a_error, choice.a_variance, choice.a_replicate, choice.a_samples},
      b_{choice.b_error, choice.b_variance, choice.b_replicate, choice.b_samples},
      shared_(choice.shared_noise),
      from_layers_(choice.noise_from_layers),
      freedom_(choice.freedom) {
  for (const auto& [letter, side] : {std::pair{"a", &a_}, {"b", &b_}}) {
    if (side->given() && is_from_layers(letter))
      throw Error(ExitCode::kUsage, "--noise-from-layers {0}: the noise of {0} is given twice",
                  letter);
    if (side->samples > 0 && !is_from_layers(letter) && side->variance.empty())
      throw Error(ExitCode::kUsage, "--{0}-samples is for --noise-from-layers and --{0}-variance",
                  letter);
    for (const std::string& given : {side->error, side->variance})
      if (given == "*" || given.rfind('*') + 1 > 1)
        throw Error(ExitCode::kUsage,
                    "{}: a * stands for the picture's path without its ending and comes "
                    "first, as in '*_variance.exr'",
                    printable(given));
  }
  if (a_.given() || b_.given() || !from_layers_.empty())
    options.noise = NoiseOptions{
        .significance = choice.significance, .bootstraps = choice.bootstrap, .seed = choice.seed};
}

bool NoiseFiles::is_from_layers(const std::string& letter) const {
  return from_layers_ == letter || from_layers_ == "both";
}

std::vector<std::filesystem::path> NoiseFiles::files(const std::string& name) const {
  std::vector<std::filesystem::path> result;
  for (const Side* side : {&a_, &b_}) {
    for (const std::string& given : {side->error, side->variance})
      if (!given.empty() && !is_ending(given)) result.push_back(file_of(given, name));
    for (const std::string& replicate : side->replicates)
      result.push_back(file_of(replicate, name));
  }
  return result;
}

std::vector<std::string> NoiseFiles::endings() const {
  std::vector<std::string> result;
  for (const Side* side : {&a_, &b_})
    for (const std::string& given : {side->error, side->variance})
      if (is_ending(given)) result.push_back(given.substr(1));
  return result;
}

std::optional<PictureNoise> NoiseFiles::read_side(const Side& side, const std::string& letter,
                                                  const std::string& name, const std::string& file,
                                                  Picture& picture) const {
  const auto read = [&](const std::string& given) {
    const auto other = is_ending(given) ? with_ending(file, given.substr(1)) : file_of(given, name);
    Image image = read_image(other);
    require_same_size(picture.image, image, "the picture", other.string());
    return image;
  };
  const bool shared =
      shared_.empty() ? !side.error.empty() : shared_ == letter || shared_ == "both";
  const auto option = is_from_layers(letter)  ? std::string("--noise-from-layers")
                      : !side.error.empty()   ? fmt::format("--{}-error", letter)
                      : side.variance.empty() ? fmt::format("--{}-replicate", letter)
                                              : fmt::format("--{}-variance", letter);
  try {
    if (is_from_layers(letter))
      return noise_of_layers(file, picture, {side.samples, freedom_, shared});
    if (!side.error.empty()) return noise_of_standard_errors(read(side.error), freedom_, shared);
    if (!side.variance.empty()) {
      const double samples = side.samples > 0 ? side.samples : picture.source.samples;
      if (samples == 0)
        throw Error(ExitCode::kUsage,
                    "{} does not say how many samples a pixel has; give them with "
                    "--{}-samples, or 1 if the variance is that of the mean",
                    printable_path(file), letter);
      return noise_of_variances(read(side.variance), samples, freedom_, shared);
    }
    if (side.replicates.empty()) return std::nullopt;
    std::vector<Image> pictures;
    for (const std::string& replicate : side.replicates) pictures.push_back(read(replicate));
    pictures.insert(pictures.begin(), std::move(picture.image));
    NoisyPicture mean = mean_of_replicates(pictures, shared);
    picture.image = std::move(mean.image);
    return std::move(mean.noise);
  } catch (const Error& error) {
    throw Error(error.code(), "{}: {}", option, error.what());
  }
}

void NoiseFiles::read(const PairReport& files, PicturePair& pair,
                      ComparisonOptions& options) const {
  const std::string& name = files.name_in_folders;
  if (!options.noise) return;
  options.noise->a = read_side(a_, "a", name, files.a, pair.a);
  options.noise->b = read_side(b_, "b", name, files.b, pair.b);
}

}  // namespace lobelia

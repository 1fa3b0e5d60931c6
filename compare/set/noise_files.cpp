#include "compare/set/noise_files.hpp"

#include <fmt/format.h>

#include "compare/require_same_size.hpp"
#include "compare/uncertainty/noise_layers.hpp"
#include "core/image_io.hpp"

namespace lobelia {

NoiseFiles::NoiseFiles(const CompareChoice& choice, ComparisonOptions& options)
    : a_{choice.a_error, choice.a_replicate, choice.a_samples},
      b_{choice.b_error, choice.b_replicate, choice.b_samples},
      shared_(choice.shared_noise),
      from_layers_(choice.noise_from_layers),
      freedom_(choice.freedom) {
  for (const auto& [letter, side] : {std::pair{"a", &a_}, {"b", &b_}}) {
    if (side->given() && is_from_layers(letter))
      throw Error(ExitCode::kUsage,
                  fmt::format("--noise-from-layers {0}: the noise of {0} is given twice", letter));
    if (side->samples > 0 && !is_from_layers(letter))
      throw Error(ExitCode::kUsage, fmt::format("--{}-samples is for --noise-from-layers", letter));
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
    if (!side->error.empty()) result.push_back(file_of(side->error, name));
    for (const std::string& replicate : side->replicates)
      result.push_back(file_of(replicate, name));
  }
  return result;
}

std::optional<PictureNoise> NoiseFiles::read_side(const Side& side, const std::string& letter,
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

void NoiseFiles::read(const std::string& name, const PairReport& files, PicturePair& pair,
                      ComparisonOptions& options) const {
  if (!options.noise) return;
  options.noise->a = read_side(a_, "a", name, files.a, pair.a);
  options.noise->b = read_side(b_, "b", name, files.b, pair.b);
}

}  // namespace lobelia

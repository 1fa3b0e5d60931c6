#include "compare/set/noise_files.hpp"

#include <fmt/format.h>

#include "base/pictures/image_io.hpp"
#include "base/words/text.hpp"
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
      freedom_(choice.freedom) {
  for (const auto& [letter, side] : {std::pair{"a", &a_}, {"b", &b_}}) {
    if (side->samples > 0 && side->variance.empty())
      throw Error(ExitCode::kUsage, "--{0}-samples is for --{0}-variance", letter);
    if (side->samples == 0 && !side->variance.empty())
      throw Error(
          ExitCode::kUsage,
          "--{0}-variance needs the samples of a pixel: give them with --{0}-samples, or 1 if the "
          "variance is that of the mean",
          letter);
    for (const std::string& given : {side->error, side->variance})
      if (given == "*" || given.rfind('*') + 1 > 1)
        throw Error(ExitCode::kUsage,
                    "{}: a * stands for the picture's path without its ending and comes "
                    "first, as in '*_variance.exr'",
                    printable(given));
  }
  if (a_.given() || b_.given())
    options.noise = NoiseOptions{
        .significance = choice.significance, .bootstraps = choice.bootstrap, .seed = choice.seed};
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
  const char* const kind = !side.error.empty()     ? "error"
                           : side.variance.empty() ? "replicate"
                                                   : "variance";
  try {
    if (!side.error.empty()) return noise_of_standard_errors(read(side.error), freedom_, shared);
    if (!side.variance.empty())
      return noise_of_variances(read(side.variance), side.samples, freedom_, shared);
    if (side.replicates.empty()) return std::nullopt;
    std::vector<Image> pictures;
    for (const std::string& replicate : side.replicates) pictures.push_back(read(replicate));
    pictures.insert(pictures.begin(), std::move(picture.image));
    NoisyPicture mean = mean_of_replicates(pictures, shared);
    picture.image = std::move(mean.image);
    return std::move(mean.noise);
  } catch (const Error& error) {
    throw Error(error.code(), "--{}-{}: {}", letter, kind, error.what());
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

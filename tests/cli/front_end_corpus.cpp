#include "tests/cli/front_end_corpus.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_io.hpp"
#include "tests/base/picture_files.hpp"

namespace lobelia::fixtures {
namespace {

using Random = std::mt19937;

double between(Random& random, double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(random);
}
int one_of(Random& random, int count) {
  return std::uniform_int_distribution<int>(0, count - 1)(random);
}

/// A Gaussian highlight on a slope.
struct Spot {
  int width = 32, height = 24;
  double peak = 1, sigma = 4, x = 16, y = 12, background = 0.1;

  Image image() const {
    Image image(width, height);
    for (int y_of = 0; y_of < height; ++y_of)
      for (int x_of = 0; x_of < width; ++x_of) {
        const double u = (x_of + 0.5 - x) / sigma, v = (y_of + 0.5 - y) / sigma;
        const double light = peak * std::exp(-0.5 * (u * u + v * v));
        float* const pixel = image.values().data() +
                             3 * (std::size_t(y_of) * std::size_t(width) + std::size_t(x_of));
        for (int c = 0; c < 3; ++c)
          pixel[c] = float(light + background * (0.5 + 0.3 * c + 0.2 * x_of / width));
      }
    return image;
  }
};

Spot any_spot(Random& random, double least_peak, double most_peak) {
  Spot spot;
  spot.width = 16 + 8 * one_of(random, 7);
  spot.height = 16 + 8 * one_of(random, 5);
  spot.peak = std::exp(between(random, std::log(least_peak), std::log(most_peak)));
  spot.sigma = between(random, 1.2, 6);
  spot.x = between(random, 0.3, 0.7) * spot.width;
  spot.y = between(random, 0.3, 0.7) * spot.height;
  spot.background = one_of(random, 3) == 0 ? 0 : between(random, 0.01, 0.3);
  return spot;
}

/// Nothing, or what a renderer may do wrongly, from far too little to be seen to far too much.
Spot changed(Spot spot, Random& random) {
  const double much = std::exp(between(random, std::log(1e-4), std::log(0.5)));
  switch (one_of(random, 6)) {
    case 0:
      break;
    case 1:
      spot.peak *= 1 - much;
      break;
    case 2:
      spot.sigma *= 1 + much;
      break;
    case 3:
      spot.x += 8 * much;
      break;
    case 4:
      spot.background *= 1 + much;
      break;
    default:
      spot.peak = 0;
  }
  return spot;
}

std::vector<float> channel_of(const Image& image, std::size_t channel) {
  std::vector<float> values;
  for (std::size_t i = channel; i < image.values().size(); i += 3)
    values.push_back(image.values()[i]);
  return values;
}

std::vector<ExrChannel> colours(const Image& image, const std::string& layer = "") {
  return {{layer + "R", channel_of(image, 0)},
          {layer + "G", channel_of(image, 1)},
          {layer + "B", channel_of(image, 2)}};
}

void write_channels(const std::filesystem::path& file, const Spot& spot,
                    const std::vector<ExrChannel>& channels) {
  write_exr_channels(file, spot.width, spot.height, channels);
}

std::vector<float> shares(const Spot& spot, double of_left) {
  std::vector<float> values;
  for (int i = 0; i < spot.width * spot.height; ++i)
    values.push_back(float(i % spot.width < spot.width / 2 ? of_left : 1));
  return values;
}

Image noisy(Image image, Random& random, double share) {
  std::normal_distribution<double> normal;
  for (float& value : image.values()) value = float(value * (1 + share * normal(random)));
  return image;
}

std::string png_of_codes(const Spot& spot, bool with_alpha, Random& random) {
  const DisplayImage shown = to_display(spot.image(), 0);
  const int alpha = with_alpha ? 128 + one_of(random, 128) : 255;
  Png png{std::uint32_t(spot.width), std::uint32_t(spot.height), 8, with_alpha ? 6 : 2, {}, {}};
  for (std::size_t i = 0; i < shown.rgb.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) png.samples += char(shown.rgb[i + c]);
    if (with_alpha) png.samples += char(i / 3 % 2 == 0 ? alpha : 255);
  }
  return png_file(png);
}

/// Writes the two files, and sets what belongs to them.
class PairWriter {
 public:
  PairWriter(MadePair& pair, const std::filesystem::path& directory)
      : pair_(pair), directory_(directory), random_(std::uint32_t(pair.number)) {}

  void write_peaks() {
    pair_.kind = "peaks";
    pair_.is_plain = true;
    const Spot spot = any_spot(random_, 0.5, 50'000);
    write_exr_files(changed(spot, random_).image(), spot.image());
  }

  void write_codes() {
    pair_.kind = "codes";
    const Spot spot = any_spot(random_, 0.2, 1.2);
    const bool with_alpha = one_of(random_, 2) == 0;
    pair_.a = file("a.png");
    pair_.b = file("b.png");
    Random same = random_;
    write_file(pair_.b, png_of_codes(spot, with_alpha, same));
    write_file(pair_.a, png_of_codes(changed(spot, random_), with_alpha, random_));
  }

  void write_alpha() {
    pair_.kind = "alpha";
    const Spot spot = any_spot(random_, 0.5, 500);
    write_with({{"A", shares(spot, one_of(random_, 2) == 0 ? 0.5 : 0.9)}}, spot,
               {{"A", shares(spot, 0.5)}});
    if (one_of(random_, 3) == 0) add("ignore-alpha", "true");
  }

  void write_layers() {
    pair_.kind = "layers";
    const Spot spot = any_spot(random_, 0.5, 500), other = any_spot(random_, 0.5, 5);
    Spot sized = other;
    sized.width = spot.width;
    sized.height = spot.height;
    std::vector<ExrChannel> in_a = colours(changed(sized, random_).image(), "diffuse."),
                            in_b = colours(sized.image(), "diffuse.");
    std::vector<float> depth = shares(spot, 7);
    depth[0] = std::numeric_limits<float>::infinity();
    in_a.push_back({"Z", depth});
    in_b.push_back({"Z", depth});
    write_with(in_a, spot, in_b);
    if (one_of(random_, 2) == 0)
      add("all-layers", "true");
    else
      add("layer", one_of(random_, 2) == 0 ? "diffuse" : "Z");
  }

  void write_noise() {
    pair_.kind = "noise";
    const Spot spot = any_spot(random_, 0.5, 500);
    const double share = one_of(random_, 2) == 0 ? 0.02 : 0.0005;
    pair_.is_plain = true;
    write_exr_files(noisy(changed(spot, random_).image(), random_, share),
                    noisy(spot.image(), random_, share));
    add("bootstrap", "4");
    add("seed", "3");
    if (one_of(random_, 2) == 0) {
      for (const char* option : {"a-replicate", "b-replicate"}) {
        add(option, file(std::string(option) + ".exr"));
        write_exr(pair_.options.back().second, noisy(spot.image(), random_, share), {});
      }
      return;
    }
    Image errors = spot.image();
    for (float& value : errors.values()) value *= float(share);
    pair_.a_error = file("a-error.exr");
    pair_.b_error = file("b-error.exr");
    for (const std::string& error : {pair_.a_error, pair_.b_error}) write_exr(error, errors, {});
    add("a-error", pair_.a_error);
    add("b-error", pair_.b_error);
    if (one_of(random_, 2) == 0) add("significance", "0.001");
  }

  void write_sizes() {
    pair_.kind = "sizes";
    pair_.is_plain = true;
    constexpr int kSides[] = {1, 2, 3, 7, 11, 12, 33, 65};
    Spot spot = any_spot(random_, 0.5, 50);
    spot.width = kSides[one_of(random_, 8)];
    spot.height = kSides[one_of(random_, 8)];
    spot.x = spot.width / 2.0;
    spot.y = spot.height / 2.0;
    Spot other = changed(spot, random_);
    if (one_of(random_, 4) == 0) ++other.width;  // an error
    write_exr_files(other.image(), spot.image());
  }

  void write_options() {
    pair_.kind = "options";
    pair_.is_plain = true;
    const Spot spot = any_spot(random_, 0.5, 5000);
    write_exr_files(changed(spot, random_).image(), spot.image());
    const std::vector<std::vector<std::pair<std::string, std::string>>> lists{
        {{"exposures", "auto"}},
        {{"exposures", "-2,2,3"}, {"tone-curve", "reinhard"}, {"exposure", "-1.5"}},
        {{"crop", "2,3,9,8"}, {"mask", "rect:4,4,6,6"}},
        {{"ignore", "rect:0,0,4,4"}, {"ignore", "polygon:1,1 9,1 9,9"}},
        {{"tolerance", "1e-3,1e-6,2"}, {"fail", "rmse=0.25"}},
        {{"no-default-limits", "true"}, {"fail", "psnr=40"}, {"warn", "mae=0"}},
        {{"metrics", "rmse,flip.ldr,colour"}, {"fail", "share_over.abs=0.004=10%"}},
        {{"metrics", "all"}, {"pixels-per-degree", "40"}},
        {{"display-distance", "1.2"}, {"display-width", "0.5"}, {"fail", "rmse=-1"}},
        {{"exposure", "bright"}}};
    pair_.options = lists[std::size_t(one_of(random_, int(lists.size())))];
  }

  void write_nonfinite() {
    pair_.kind = "not finite";
    pair_.is_plain = true;
    const Spot spot = any_spot(random_, 0.5, 50);
    Image a = spot.image(), b = spot.image();
    const std::size_t where = std::size_t(one_of(random_, int(a.values().size())));
    a.values()[where] = std::numeric_limits<float>::infinity();
    if (one_of(random_, 2) == 0) b.values()[where] = a.values()[where];
    if (one_of(random_, 2) == 0) add("allow-equal-nonfinite", "true");
    write_exr_files(a, b);
  }

 private:
  std::string file(const std::string& name) const {
    return (directory_ / fmt::format("{}-{}", pair_.number, name)).string();
  }
  void add(const std::string& option, const std::string& value) {
    pair_.options.emplace_back(option, value);
  }
  void write_exr_files(const Image& a, const Image& b) {
    pair_.a = file("a.exr");
    pair_.b = file("b.exr");
    write_exr(pair_.a, a, {});
    write_exr(pair_.b, b, {});
  }
  /// The spot, changed in A, with further channels.
  void write_with(std::vector<ExrChannel> in_a, const Spot& spot, std::vector<ExrChannel> in_b) {
    pair_.a = file("a.exr");
    pair_.b = file("b.exr");
    for (const ExrChannel& one : colours(changed(spot, random_).image())) in_a.push_back(one);
    for (const ExrChannel& one : colours(spot.image())) in_b.push_back(one);
    write_channels(pair_.a, spot, in_a);
    write_channels(pair_.b, spot, in_b);
  }

  MadePair& pair_;
  std::filesystem::path directory_;
  Random random_;
};

}  // namespace

MadePair make_pair_of_files(int number, const std::filesystem::path& directory) {
  MadePair pair;
  pair.number = number;
  PairWriter writer(pair, directory);
  // Peaks are the most of them: there the choice of exposure counts.
  constexpr void (PairWriter::*kKinds[])() = {
      &PairWriter::write_peaks,   &PairWriter::write_codes, &PairWriter::write_alpha,
      &PairWriter::write_layers,  &PairWriter::write_noise, &PairWriter::write_peaks,
      &PairWriter::write_options, &PairWriter::write_sizes, &PairWriter::write_nonfinite};
  (writer.*kKinds[std::size_t(number) % std::size(kKinds)])();
  return pair;
}

}  // namespace lobelia::fixtures

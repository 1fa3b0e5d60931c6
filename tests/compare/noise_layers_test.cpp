// Noise in layers of a picture's file, as renderers write them, from samples of a known distribution.
#include "compare/uncertainty/noise_layers.hpp"

#include "base/pictures/image_io.hpp"
#include "base/pictures/picture_colour.hpp"
#include "base/system/error.hpp"
#include "compare/compare.hpp"
#include "tests/base/picture_files.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

constexpr int kSide = 24, kPixels = kSide * kSide;
constexpr double kRelative = 0.5;  ///< a sample's standard deviation, of its mean

/// Sums over independent gamma-distributed samples of each value.
struct Moments {
  Moments(std::uint64_t seed, int samples) : n(samples) {
    std::mt19937_64 random(seed);
    constexpr double kShape = 1 / (kRelative * kRelative);
    for (int i = 0; i < 3 * kPixels; ++i) {
      const double expected = 0.2 + (i % 7) * 0.3;
      std::gamma_distribution<double> sample(kShape, expected / kShape);
      double sum = 0, squares = 0;
      for (int k = 0; k < n; ++k) {
        const double value = sample(random);
        sum += value;
        squares += value * value;
      }
      mean.push_back(sum / n);
      square.push_back(squares / n);
    }
  }
  int n;
  std::vector<double> mean, square;
};

class NoiseLayers : public ::testing::Test {
 protected:
  /// Three channels "prefix.first", ... of values by function(i).
  template <class Function>
  static void add(std::vector<ExrChannel>& channels, const std::string& prefix, const char* letters,
                  Function function, Imf::PixelType type = Imf::FLOAT) {
    for (int c = 0; c < 3; ++c) {
      std::vector<float> values;
      for (int i = 0; i < kPixels; ++i) values.push_back(float(function(std::size_t(3 * i + c))));
      channels.push_back({(prefix.empty() ? "" : prefix + ".") + letters[c], values, type});
    }
  }
  std::filesystem::path write(const std::string& name, const std::vector<ExrChannel>& channels,
                              std::map<std::string, std::string> texts = {},
                              std::optional<int> samples = {}) {
    const auto box = window(0, 0, kSide, kSide);
    ExrPart part{"", box, box, channels};
    part.texts = std::move(texts);
    part.samples = samples;
    write_exr_parts(directory_.path() / name, {part});
    return directory_.path() / name;
  }
  std::filesystem::path mitsuba(const std::string& name, const Moments& moments,
                                Imf::PixelType type = Imf::FLOAT) {
    std::vector<ExrChannel> channels;
    add(
        channels, "", "RGB", [&](std::size_t i) { return moments.mean[i]; }, type);
    add(
        channels, "path", "XYZ", [&](std::size_t i) { return moments.mean[i]; }, type);
    add(
        channels, "m2_path", "XYZ", [&](std::size_t i) { return moments.square[i]; }, type);
    return write(name, channels);
  }
  static std::string refusal(const std::filesystem::path& path, const std::string& layer,
                             NoiseLayerOptions options, ExitCode code) {
    try {
      noise_of_layers(path, read_picture(path, layer), options);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      return error.what();
    }
    ADD_FAILURE() << "noise was found";
    return "";
  }
  TemporaryDirectory directory_;
};

/// By n - 1, of the mean.
double standard_error(const Moments& moments, std::size_t i) {
  const double n = moments.n;
  return std::sqrt((moments.square[i] - moments.mean[i] * moments.mean[i]) / (n - 1));
}

TEST_F(NoiseLayers, GiveStandardErrorsOfTheMeanFromMitsubasMoments) {
  const Moments moments(1, 64);
  const auto path = mitsuba("a.exr", moments);
  const PictureNoise noise = noise_of_layers(path, read_picture(path, "path"), {.samples = 64});
  EXPECT_EQ(noise.layer, "m2_path");
  EXPECT_EQ(noise.freedom, 63);
  const double unbiased = 1 + 1 / (4 * 63.0);
  for (std::size_t i = 0; i < moments.mean.size(); ++i)
    ASSERT_NEAR(noise.standard_error.values()[i], unbiased * standard_error(moments, i), 1e-5);
  EXPECT_THAT(refusal(path, "path", {}, ExitCode::kUsage),
              HasSubstr("does not say how many samples"));
  EXPECT_THAT(refusal(path, "path", {.samples = 1}, ExitCode::kUsage), HasSubstr("fewer than 2"));
  EXPECT_THAT(refusal(path, "", {.samples = 64}, ExitCode::kInput), HasSubstr("--layer 'path'"));
}

TEST_F(NoiseLayers, AreNeverTooSmallByTheRoundingOfHalfFloats) {
  const Moments moments(2, 16);
  const auto path = mitsuba("half.exr", moments, Imf::HALF);
  const PictureNoise noise = noise_of_layers(path, read_picture(path, "path"), {.samples = 16});
  for (std::size_t i = 0; i < moments.mean.size(); ++i)
    ASSERT_GE(noise.standard_error.values()[i], standard_error(moments, i));
}

/// How many of `runs` pairs of one expectation are called different.
template <class Write>
int false_differences(int runs, const std::string& layer, Write write) {
  int different = 0;
  for (int run = 0; run < runs; ++run) {
    const auto a = write("a.exr", std::uint64_t(2 * run + 1)),
               b = write("b.exr", std::uint64_t(2 * run + 2));
    const Picture picture_a = read_picture(a, layer), picture_b = read_picture(b, layer);
    ComparisonOptions options;
    options.default_limits = false;
    options.noise.emplace();
    options.noise->significance = 0.1;
    options.noise->bootstraps = 4;
    options.noise->a = noise_of_layers(a, picture_a, {.samples = 64});
    options.noise->b = noise_of_layers(b, picture_b, {.samples = 64});
    const Comparison comparison = compare(picture_a.image, picture_b.image, options);
    different += comparison.value("z.max") > comparison.value("z.critical");
  }
  return different;
}

TEST_F(NoiseLayers, HaveTheTrueSizeFromMitsuba) {
  // 1.96 standard errors hold 95 % of the differences of two pictures of one expectation, whatever the sampler's luck.
  int beyond = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 8; seed += 2) {
    const auto a = mitsuba("a.exr", Moments(seed, 64)), b = mitsuba("b.exr", Moments(seed + 1, 64));
    const Picture picture_a = read_picture(a, "path"), picture_b = read_picture(b, "path");
    const PictureNoise noise_a = noise_of_layers(a, picture_a, {.samples = 64}),
                       noise_b = noise_of_layers(b, picture_b, {.samples = 64});
    for (std::size_t i = 0; i < picture_a.image.values().size(); ++i, ++all) {
      const double error = std::hypot(double(noise_a.standard_error.values()[i]),
                                      double(noise_b.standard_error.values()[i]));
      const double apart =
          double(picture_a.image.values()[i]) - double(picture_b.image.values()[i]);
      beyond += std::abs(apart) > 1.96 * error;
    }
  }
  // 346 of 6912 values are expected, with a spread of 18.
  EXPECT_NEAR(beyond / double(all), 0.05, 0.011);
}

TEST_F(NoiseLayers, RaiseNoMoreFalseDifferencesThanNominalFromMitsuba) {
  // At a significance of 0.1 thirteen of a thousand pairs were called different: the z test takes cautious errors, and the
  // brightness changes from pixel to pixel here.
  const int different = false_differences(40, "path", [&](const char* name, std::uint64_t seed) {
    return mitsuba(name, Moments(seed, 64));
  });
  EXPECT_LE(different, 4);
}

/// As pbrt's GBufferFilm: the picture is RGB, the variance that of X, Y and Z.
std::vector<ExrChannel> pbrt_channels(const Moments& moments) {
  const RgbMatrix to_rgb = inverse(*to_xyz(kRec709Chromaticities));
  std::vector<ExrChannel> channels;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float> colour, variance;
    for (std::size_t i = 0; i < std::size_t(kPixels); ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += to_rgb[c][k] * moments.mean[3 * i + k];
      colour.push_back(float(sum));
      const double n = moments.n, mean = moments.mean[3 * i + c];
      variance.push_back(float((moments.square[3 * i + c] - mean * mean) * n / (n - 1)));
    }
    channels.push_back({std::string(1, "RGB"[c]), colour});
    channels.push_back({std::string("Variance.") + "RGB"[c], variance});
  }
  return channels;
}

TEST_F(NoiseLayers, BoundTheErrorsOfRgbAndKnowTheSamplesFromPbrt) {
  const Moments moments(3, 64);
  const auto path = write("a.exr", pbrt_channels(moments), {}, 64);
  const Picture picture = read_picture(path, "");
  EXPECT_EQ(picture.source.samples, 64);
  const PictureNoise noise = noise_of_layers(path, picture, {});
  EXPECT_EQ(noise.layer, "Variance");
  EXPECT_EQ(noise.freedom, 63);
  const RgbMatrix to_rgb = inverse(*to_xyz(kRec709Chromaticities));
  const double unbiased = 1 + 1 / (4 * 63.0);
  for (std::size_t i = 0; i < std::size_t(kPixels); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      double bound = 0, independent = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double one = std::abs(to_rgb[c][k]) * standard_error(moments, 3 * i + k);
        bound += one;
        independent += one * one;
      }
      const double found = double(noise.standard_error.values()[3 * i + c]);
      ASSERT_NEAR(found, unbiased * bound, 1e-4 * bound);
      ASSERT_GE(found, std::sqrt(independent));
    }
}

TEST_F(NoiseLayers, RaiseNoMoreFalseDifferencesThanNominalFromPbrt) {
  const int different = false_differences(40, "", [&](const char* name, std::uint64_t seed) {
    return write(name, pbrt_channels(Moments(seed, 64)), {}, 64);
  });
  EXPECT_LE(different, 4);
}

TEST_F(NoiseLayers, TakeVariancePassAndSamplesFromOldCycles) {
  const Moments moments(4, 32);
  std::vector<ExrChannel> channels;
  add(channels, "View.Combined", "RGB", [&](std::size_t i) { return moments.mean[i]; });
  add(channels, "View.Denoising Image Variance", "RGB",
      [&](std::size_t i) { return moments.square[i] - moments.mean[i] * moments.mean[i]; });
  const auto path = write("a.exr", channels, {{"cycles.View.samples", "32"}});
  const PictureNoise noise = noise_of_layers(path, read_picture(path, "combined"), {});
  EXPECT_EQ(noise.layer, "View.Denoising Image Variance");
  EXPECT_EQ(noise.freedom, 31);
  const double unbiased = 1 + 1 / (4 * 31.0);
  for (std::size_t i = 0; i < moments.mean.size(); ++i)
    ASSERT_NEAR(noise.standard_error.values()[i], unbiased * standard_error(moments, i), 1e-5);
}

TEST_F(NoiseLayers, ReadTheLayerStandardError) {
  std::vector<ExrChannel> channels;
  add(channels, "", "RGB", [](std::size_t) { return 1; });
  add(channels, "StandardError", "RGB", [](std::size_t) { return 0.25; });
  const auto path = write("a.exr", channels);
  const PictureNoise noise = noise_of_layers(path, read_picture(path, ""), {.freedom = 1e6});
  EXPECT_NEAR(noise.standard_error.values()[5], 0.25, 1e-6);
  EXPECT_EQ(noise.freedom, 1e6);
}

TEST_F(NoiseLayers, AreRefusedWithTheReasonIfTheyAreOtherThings) {
  std::vector<ExrChannel> channels;
  add(channels, "View.Combined", "RGB", [](std::size_t) { return 1; });
  const auto plain = write("a.exr", channels);
  EXPECT_THAT(refusal(plain, "", {.samples = 8}, ExitCode::kInput),
              HasSubstr("Cycles 3 and later write none: render another seed for --a-replicate"));
  add(channels, "View.Denoising Variance", "RGB", [](std::size_t) { return 1; });
  EXPECT_THAT(refusal(write("b.exr", channels), "combined", {.samples = 8}, ExitCode::kInput),
              HasSubstr("is filtered for Cycles' denoiser"));
  add(channels, "View.Combined.StandardError", "RGB", [](std::size_t) { return -1; });
  EXPECT_THAT(refusal(write("c.exr", channels), "combined", {.samples = 8}, ExitCode::kInput),
              HasSubstr("must be finite and not negative"));
}

}  // namespace
}  // namespace lobelia

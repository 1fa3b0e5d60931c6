// FLIP's errors against the formulas of the paper in float64, on pictures where float32 or a careless order of operations
// shows: powers of almost nothing and roots of differences that cancel.
#include <hwy/targets.h>

#include "compare/display_light.hpp"
#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/flip_kernels.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

// LDR-FLIP as the formulas stand: in double, each pixel's windows one after the other, without separation.

/// The filters of the paper, of 2 * radius + 1 taps.
struct PlainFilters {
  using Taps = std::vector<double>;

  explicit PlainFilters(double pixels_per_degree) {
    const double pi = std::acos(-1.0);
    const int contrast = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree));
    for (int i = -contrast; i <= contrast; ++i) {
      const double x = i / pixels_per_degree;
      const auto csf = [&](double a, double b) {
        return std::sqrt(a * std::sqrt(pi / b)) * std::exp(-pi * pi * x * x / b);
      };
      luminance.push_back(csf(1, 0.0047));
      red_green.push_back(csf(1, 0.0053));
      blue_yellow_1.push_back(csf(34.1, 0.04));
      blue_yellow_2.push_back(csf(13.5, 0.025));
    }
    const auto sum = [](const Taps& taps) {
      return std::accumulate(taps.begin(), taps.end(), 0.0);
    };
    const auto divide = [](Taps& taps, double by) {
      for (double& tap : taps) tap /= by;
    };
    divide(luminance, sum(luminance));
    divide(red_green, sum(red_green));
    const double both = std::hypot(sum(blue_yellow_1), sum(blue_yellow_2));
    divide(blue_yellow_1, both);
    divide(blue_yellow_2, both);
    const double sigma = 0.5 * 0.082 * pixels_per_degree;
    const int feature = int(std::ceil(3 * sigma));
    for (int i = -feature; i <= feature; ++i) {
      const double x = i, g = std::exp(-x * x / (2 * sigma * sigma));
      gaussian.push_back(g);
      edge.push_back(-x * g);
      point.push_back((x * x / (sigma * sigma) - 1) * g);
    }
    divide(gaussian, sum(gaussian));
    for (Taps* taps : {&edge, &point}) {
      double above = 0, below = 0;
      for (const double tap : *taps) (tap > 0 ? above : below) += std::abs(tap);
      for (double& tap : *taps) tap /= tap > 0 ? above : below;
    }
  }

  Taps luminance, red_green, blue_yellow_1, blue_yellow_2, gaussian, edge, point;
};

class PlainFlip {
 public:
  PlainFlip(const DisplayLight& shown, const PlainFilters& filters)
      : width_(shown.width()), height_(shown.height()), filters_(filters) {
    for (std::size_t i = 0; i < shown.pixel_count(); ++i) {
      const Rgb xyz = relative_xyz(fixtures::shown_at(shown, i));
      y_.push_back(116 * xyz.g - 16);
      cx_.push_back(500 * (xyz.r - xyz.g));
      cz_.push_back(200 * (xyz.g - xyz.b));
    }
  }

  /// The filtered colour as L, a and b with the Hunt effect.
  Rgb colour(int x, int y) const {
    const double l = window(y_, filters_.luminance, filters_.luminance, x, y);
    const double cx = window(cx_, filters_.red_green, filters_.red_green, x, y);
    const double cz = window(cz_, filters_.blue_yellow_1, filters_.blue_yellow_1, x, y) +
                      window(cz_, filters_.blue_yellow_2, filters_.blue_yellow_2, x, y);
    const double fy = (l + 16) / 116;
    return hunt_lab(clamped_rgb({fy + cx / 500, fy, fy - cz / 200}));
  }
  double edge(int x, int y) const { return feature(filters_.edge, x, y); }
  double point(int x, int y) const { return feature(filters_.point, x, y); }

  static double distance(Rgb a, Rgb b) {
    return std::pow(std::abs(a.r - b.r) + std::hypot(a.g - b.g, a.b - b.b), 0.7);
  }
  static Rgb hunt_lab(Rgb rgb) {
    const auto f = [](double t) {
      return t > 216.0 / 24389 ? std::cbrt(t) : 841.0 / 108 * t + 4.0 / 29;
    };
    const Rgb xyz = relative_xyz(rgb);
    const double fx = f(xyz.r), fy = f(xyz.g), fz = f(xyz.b), l = 116 * fy - 16;
    return {l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
  }

 private:
  // sRGB to XYZ, each row divided by its sum, which is white.
  static constexpr double kMatrix[3][3] = {
      {10135552.0 / 23359437, 8788810.0 / 23359437, 4435075.0 / 23359437},
      {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
      {1425312.0 / 80288307, 8788810.0 / 80288307, 70074185.0 / 80288307}};

  static Rgb relative_xyz(Rgb c) {
    const auto row = [&c](const double(&m)[3]) { return m[0] * c.r + m[1] * c.g + m[2] * c.b; };
    return {row(kMatrix[0]), row(kMatrix[1]), row(kMatrix[2])};
  }
  /// By Cramer's rule: an inverse in nine digits makes coloured specks of white.
  static Rgb clamped_rgb(Rgb relative) {
    const double v[3] = {relative.r, relative.g, relative.b};
    const auto determinant = [&v](int replaced) {
      const auto at = [&](int row, int column) {
        return column == replaced ? v[row] : kMatrix[row][column];
      };
      double sum = 0;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += at(0, i) * (at(1, j) * at(2, k) - at(1, k) * at(2, j));
      }
      return sum;
    };
    const double all = determinant(-1);
    const auto clamped = [](double x) { return std::clamp(x, 0.0, 1.0); };
    return {clamped(determinant(0) / all), clamped(determinant(1) / all),
            clamped(determinant(2) / all)};
  }
  double feature(const PlainFilters::Taps& along, int x, int y) const {
    const auto grey = [this](const auto& across, const auto& down, int u, int v) {
      return window(y_, across, down, u, v) / 116;  // the 16 cancels in a derivative
    };
    return std::hypot(grey(along, filters_.gaussian, x, y), grey(filters_.gaussian, along, x, y));
  }
  double window(const std::vector<double>& in, const PlainFilters::Taps& across,
                const PlainFilters::Taps& down, int x, int y) const {
    const int rx = int(across.size() / 2), ry = int(down.size() / 2);
    double sum = 0;
    for (int j = -ry; j <= ry; ++j)
      for (int i = -rx; i <= rx; ++i) {
        const int u = std::clamp(x + i, 0, width_ - 1), v = std::clamp(y + j, 0, height_ - 1);
        sum += across[std::size_t(i + rx)] * down[std::size_t(j + ry)] *
               in[std::size_t(v * width_ + u)];
      }
    return sum;
  }

  int width_, height_;
  const PlainFilters& filters_;
  std::vector<double> y_, cx_, cz_;
};

/// The error of each pixel.
std::vector<double> plain_flip(const DisplayLight& shown_a, const DisplayLight& shown_b,
                               double pixels_per_degree) {
  const PlainFilters filters(pixels_per_degree);
  const PlainFlip a(shown_a, filters), b(shown_b, filters);
  const double largest =
      PlainFlip::distance(PlainFlip::hunt_lab({0, 1, 0}), PlainFlip::hunt_lab({0, 0, 1}));
  std::vector<double> errors;
  for (int y = 0; y < shown_a.height(); ++y)
    for (int x = 0; x < shown_a.width(); ++x) {
      const double share = PlainFlip::distance(a.colour(x, y), b.colour(x, y)) / largest;
      const double colour = share < 0.4 ? share * 0.95 / 0.4 : 0.95 + (share - 0.4) / 0.6 * 0.05;
      const double edge = std::abs(a.edge(x, y) - b.edge(x, y)),
                   point = std::abs(a.point(x, y) - b.point(x, y));
      errors.push_back(std::pow(colour, 1 - std::sqrt(std::max(edge, point) / std::sqrt(2.0))));
    }
  return errors;
}

/// Measured: at most 2.6e-7 over all tests of this file, on every instruction set.
constexpr double kBound = 1e-6;

/// The largest error over all pixels and instruction sets.
double largest_error(const DisplayLight& a, const DisplayLight& b, double pixels_per_degree) {
  const std::vector<double> plain = plain_flip(a, b, pixels_per_degree);
  double largest = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const PixelValues errors = flip_error_map(a, b, FlipFilters(pixels_per_degree));
    hwy::SetSupportedTargetsForTest(0);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const double error = std::abs(double(errors[i]) - plain[i]);
      if (std::isnan(error)) return error;
      largest = std::max(largest, error);
    }
  }
  return largest;
}

template <class Value>
Image picture(int width, int height, Value value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[std::size_t(c)] = float(value(x, y, c));
  return image;
}

/// The picture with every value changed by a function of it.
template <class Change>
Image changed(Image image, Change change) {
  for (float& value : image.values()) value = float(change(value));
  return image;
}

void expect_accurate(const std::string& name, const Image& a, const Image& b,
                     double pixels_per_degree = kDefaultPixelsPerDegree) {
  const double error = largest_error(DisplayLight(a, 0), DisplayLight(b, 0), pixels_per_degree);
  EXPECT_LT(error, kBound) << name;
  const double exchanged = largest_error(DisplayLight(b, 0), DisplayLight(a, 0), pixels_per_degree);
  EXPECT_LT(exchanged, kBound) << name << ", exchanged";
}

TEST(FlipAccuracy, IsAMillionthOnRandomPicturesAtRandomDistances) {
  Random random(7);
  for (int round = 0; round < 40; ++round) {
    const int width = int(random.between(1, 50)), height = int(random.between(1, 40));
    const double distance = std::exp(random.between(std::log(8.0), std::log(130.0)));
    const Image a = fixtures::noise(width, height, std::uint64_t(2 * round + 1),
                                    float(random.between(0.1, 1.5)));
    const Image other = fixtures::noise(width, height, std::uint64_t(2 * round + 2), 1.2f);
    // From nothing in common to almost equal.
    const double share = std::pow(10, random.between(-9, 0));
    Image b = a;
    for (std::size_t i = 0; i < b.values().size(); ++i)
      b.values()[i] =
          float((1 - share) * double(a.values()[i]) + share * double(other.values()[i]));
    expect_accurate(std::to_string(width) + " x " + std::to_string(height) + ", " +
                        std::to_string(distance) + " pixels per degree, share " +
                        std::to_string(std::log10(share)),
                    a, b, distance);
  }
}

TEST(FlipAccuracy, IsAMillionthOnFlatPictures) {
  const auto flat = [](float r, float g, float b) { return fixtures::flat(23, 9, r, g, b); };
  const Image black = flat(0, 0, 0), white = flat(1, 1, 1), grey = flat(0.2f, 0.2f, 0.2f);
  const float step = 1.0f / (1 << 24);
  expect_accurate("black, white", black, white);
  expect_accurate("grey, lighter", grey, flat(0.21f, 0.21f, 0.21f));
  expect_accurate("grey, a rounding lighter", grey, flat(0.2f + 2 * step, 0.2f, 0.2f + 2 * step));
  expect_accurate("white, almost white", white, flat(1 - step, 1 - step, 1 - step));
  expect_accurate("red, almost red", flat(1, 0, 0), flat(1 - step, 0, 0));
  expect_accurate("red, red with almost no green", flat(1, 0, 0), flat(1, 1e-12f, 0));
  expect_accurate("green, blue", flat(0, 1, 0), flat(0, 0, 1));
  expect_accurate("blue, cyan", flat(0, 0, 1), flat(0, 1, 1));
  expect_accurate("black, the smallest number", black, flat(1e-45f, 1e-45f, 1e-45f));
  expect_accurate("black, denormal", black, flat(1e-39f, 0, 3e-40f));
  for (const float dark : {1e-30f, 1e-20f, 1e-12f, 1e-8f, 1e-6f, 1e-4f})
    expect_accurate("black, " + std::to_string(std::log10(dark)), black,
                    flat(dark, dark, dark / 2));
  // Around the end of the straight part of Lab's curve.
  const float knee = 216.0f / 24389;
  for (const float below : {0.0f, 1e-9f, 1e-7f, 1e-4f})
    for (const float above : {0.0f, 2e-9f, 1e-7f, 1e-3f})
      expect_accurate("about the knee", flat(knee - below, knee - below, knee - below),
                      flat(knee + above, knee + above, knee + above));
}

// FLIP skips what is far from every difference. These pictures are several tiles, bands and blocks large.
TEST(FlipAccuracy, IsAMillionthOnPicturesThatDifferInAFewPlaces) {
  Random random(7);
  for (int round = 0; round < 24; ++round) {
    const int width = int(random.between(1, round % 2 == 0 ? 100 : 300)),
              height = int(random.between(1, 60));
    const double distance = std::exp(random.between(std::log(8.0), std::log(130.0)));
    const Image a = fixtures::noise(width, height, std::uint64_t(round), 1.1f);
    Image b = a;
    for (int places = int(random.between(1, 7)); places > 0; --places) {
      const int left = int(random.between(0, width)), top = int(random.between(0, height));
      const int right = std::min(width, left + int(random.between(1, 20))),
                bottom = std::min(height, top + int(random.between(1, 12)));
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) b.pixel(x, y)[std::size_t(random.between(0, 3))] += 0.1f;
    }
    expect_accurate(
        std::to_string(width) + " x " + std::to_string(height) + ", round " + std::to_string(round),
        a, b, distance);
  }
}

TEST(FlipAccuracy, IsAMillionthOnEdges) {
  // Grey edges: colours must not differ where only the luminance does. The wide filter of blue and yellow reaches where
  // the narrow one of luminance has almost nothing.
  const auto edge = [](int at, float left, float right) {
    return picture(48, 40, [=](int x, int, int) { return x < at ? left : right; });
  };
  expect_accurate("an edge, none", edge(24, 0, 1), fixtures::flat(48, 40, 0, 0, 0));
  expect_accurate("an edge beside", edge(24, 0, 1), edge(25, 0, 1));
  expect_accurate("an edge, the other way", edge(24, 0, 1), edge(24, 1, 0));
  expect_accurate("a weak edge", edge(24, 0.5f, 0.5f + 6e-8f),
                  fixtures::flat(48, 40, 0.5f, 0.5f, 0.5f));
  const Image slope =
      picture(48, 40, [](int x, int y, int c) { return (x + y * (c + 1)) / 170.0; });
  expect_accurate("a slope, steeper", slope, changed(slope, [](float v) { return 1.01 * v; }));
  expect_accurate("a slope, a bit steeper", slope,
                  changed(slope, [](float v) { return 1.000001 * v; }));
}

TEST(FlipAccuracy, IsAMillionthWherePicturesHaveEquallyStrongFeatures) {
  // Strengths are equal but for rounding, and the root of a difference is taken.
  const Image a = fixtures::noise(36, 36, 9, 1);
  const auto from = [&a](auto pixel_of) {
    return picture(36, 36, [&](int x, int y, int c) {
      const auto [u, v] = pixel_of(x, y);
      return a.pixel(u, v)[std::size_t(c)];
    });
  };
  expect_accurate("transposed", a, from([](int x, int y) { return std::pair(y, x); }));
  expect_accurate("mirrored", a, from([](int x, int y) { return std::pair(35 - x, y); }));
  expect_accurate("turned", a, from([](int x, int y) { return std::pair(35 - x, 35 - y); }));
  expect_accurate("negative", a, changed(a, [](float v) { return 1 - v; }));
  const auto stripes = [](int dx, int dy) {
    return picture(36, 36,
                   [=](int x, int y, int) { return (x * dx + y * dy) / 4 % 2 ? 0.8 : 0.1; });
  };
  expect_accurate("stripes across, down", stripes(1, 0), stripes(0, 1));
  expect_accurate("a checker, shifted", stripes(4, 4),
                  changed(stripes(4, 4), [](float v) { return 0.9f - v; }));
}

TEST(FlipAccuracy, IsAMillionthForHighDynamicRangeAtEveryExposure) {
  const auto bright = [](std::uint64_t seed) {
    return changed(fixtures::noise(31, 23, seed, 1),
                   [](float v) { return std::exp2(40 * v - 20); });
  };
  Image a = bright(1);
  a.pixel(3, 3)[0] = 3e38f;
  a.pixel(9, 9)[1] = -5;
  const Image b = bright(2), near = changed(a, [](float v) { return 1.0001f * v; });
  for (const ToneCurve curve :
       {ToneCurve::kClip, ToneCurve::kAces, ToneCurve::kReinhard, ToneCurve::kHable})
    for (const double stops : {-25.0, -12.0, 0.0, 6.5, 20.0})
      for (const Image* other : {&b, &near})
        EXPECT_LT(
            largest_error(DisplayLight(a, stops, curve), DisplayLight(*other, stops, curve), 67),
            kBound)
            << stops;
}

}  // namespace
}  // namespace lobelia

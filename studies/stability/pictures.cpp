#include "studies/stability/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_io.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/render.hpp"
#include "studies/stability/naive.hpp"

namespace lobelia::stability {
namespace {

constexpr int kPictureSide = 160;
constexpr double kDarkest = -8;  ///< log10 of the smallest error that is not black

template <class Pixels, class Radiance>
Image to_image(const Pixels& pixels, Radiance radiance) {
  Image image(kPictureSide, kPictureSide);
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const Rgb c = radiance(pixels[i]);
    const auto p = image.pixel(int(i) % kPictureSide, int(i) / kPictureSide);
    p[0] = float(c.r), p[1] = float(c.g), p[2] = float(c.b);
  }
  return image;
}

double largest_error(const Image& image, const Image& truth, double peak) {
  double largest = 0;
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const double error = std::abs(double(image.values()[i]) - truth.values()[i]) / peak;
    if (!(error <= largest)) largest = error;
  }
  return largest;
}

/// Black, blue, red, yellow, white at 0, 1/4, 1/2, 3/4, 1.
std::array<std::uint8_t, 3> heat(double x) {
  constexpr double kStops[][3] = {
      {0, 0, 0}, {30, 60, 200}, {210, 40, 40}, {250, 210, 40}, {255, 255, 255}};
  const double at = 4 * std::clamp(x, 0.0, 1.0);
  const int below = std::min(3, int(at));
  std::array<std::uint8_t, 3> colour;
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] =
        std::uint8_t(std::lround(std::lerp(kStops[below][c], kStops[below + 1][c], at - below)));
  return colour;
}

void paste(const DisplayImage& from, DisplayImage& to, int x0, int y0) {
  for (int y = 0; y < from.height; ++y)
    std::copy_n(from.rgb.begin() + 3 * std::ptrdiff_t(y) * from.width, 3 * from.width,
                to.rgb.begin() + 3 * (std::ptrdiff_t(y0 + y) * to.width + x0));
}

DisplayImage error_picture(const Image& picture, const Image& truth, double peak) {
  DisplayImage shown{picture.width(), picture.height(), {}};
  for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
    const double error =
        std::abs(double(picture.values()[3 * i + 1]) - truth.values()[3 * i + 1]) / peak;
    const auto colour = std::isfinite(error)
                            ? heat(1 - std::log10(std::max(error, 1e-300)) / kDarkest)
                            : std::array<std::uint8_t, 3>{255, 0, 255};
    shown.rgb.insert(shown.rgb.end(), colour.begin(), colour.end());
  }
  return shown;
}

}  // namespace

std::vector<records::StabilityPictures> write_pictures(const std::filesystem::path& directory,
                                                       const std::filesystem::path& from_record) {
  constexpr int kGap = 4;
  constexpr double kShown[] = {1e3, 1e5, 1e6};
  const int rows = int(std::size(kShown));
  DisplayImage sheet{4 * kPictureSide + 3 * kGap, rows * kPictureSide + (rows - 1) * kGap, {}};
  sheet.rgb.assign(std::size_t{3} * sheet.width * sheet.height, 255);
  const HardScene hard = hard_scenes().front();
  Highlight highlight{*find_model("modified_phong"), *find_lobe("cosine"), Normalisation::kExact};
  std::vector<records::StabilityPictures> pictures;
  for (const double n : kShown) {
    Scene scene = close_to_highlight(hard.scene, n).at(0);
    scene.film = {kPictureSide, kPictureSide};
    highlight.exponent = n;
    scene.materials[0].highlight = highlight;
    const truth::Picture truth(scene);
    const double peak = truth::coefficient(highlight.model, highlight.lobe, n) * truth.peak();
    const Image true_image = to_image(truth.highlights(highlight), [](Rgb c) { return c; });
    const double exposure = exposure_for_peak(peak);
    const int y = int(pictures.size()) * (kPictureSide + kGap);
    int x = 0;
    const auto write = [&](const char* name, const Image& image) {
      const std::string stem = fmt::format("stability-n{:.0f}-{}", n, name),
                        file = (directory / stem).string(),
                        recorded = (from_record / stem).generic_string();
      const DisplayImage eye = to_display(image, exposure),
                         error = error_picture(image, true_image, peak);
      write_exr(file + ".exr", image, {});
      write_png(file + ".png", eye);
      write_png(file + "-error.png", error);
      paste(eye, sheet, x, y);
      paste(error, sheet, x + 2 * (kPictureSide + kGap), y);
      x += kPictureSide + kGap;
      return records::StabilityPicture{recorded + ".exr", recorded + ".png",
                                       recorded + "-error.png",
                                       largest_error(image, true_image, peak)};
    };
    records::StabilityPictures& pair = pictures.emplace_back();
    pair.exponent = n;
    pair.naive = write(
        "naive", to_image(naive::picture(scene), [](const naive::Pixel& p) { return p.radiance; }));
    pair.ours = write("ours", render(scene, {}).image);
  }
  write_png(directory / "stability.png", sheet);
  return pictures;
}

}  // namespace lobelia::stability

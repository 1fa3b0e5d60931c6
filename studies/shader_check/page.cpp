#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_io.hpp"
#include "base/pictures/image_values.hpp"
#include "base/system/version.hpp"
#include "base/words/base64.hpp"
#include "base/words/html.hpp"
#include "base/words/svg_chart.hpp"
#include "compare/maps/difference_map.hpp"
#include "studies/shader_check/check.hpp"
#include "studies/shader_check/points.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view chart_style, shader_check_style;
}
namespace shader_check {
namespace {

constexpr char kPolicy[] = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";

std::string picture_link(const DisplayImage& picture) {
  return "data:image/png;base64," + base64(png_bytes(picture));
}

void write_image(Html& html, const DisplayImage& picture, const std::string& words) {
  html.empty("img", {{"src", picture_link(picture)},
                     {"alt", words},
                     {"width", std::to_string(picture.width)},
                     {"height", std::to_string(picture.height)}});
}

void write_picture(Html& html, const DisplayImage& picture, const std::string& words) {
  const Tag figure(html, "figure");
  write_image(html, picture, words);
  html.element("figcaption", words);
}

/// (theirs - model) / peak by pixel.
std::vector<float> errors_of(const SpherePair& pair, double peak) {
  std::vector<float> errors(pair.model.pixel_count());
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors[i] =
        float((double(pair.theirs.values()[3 * i]) - double(pair.model.values()[3 * i])) / peak);
  return errors;
}

/// A map on a grey ground, so that the sphere is seen where there is no error.
DisplayImage error_map(const std::vector<float>& errors, int size, double largest) {
  DisplayImage map = colour_picture(errors, size, size, largest, kSignedColourMap);
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (!is_sphere(int(i) % size, int(i) / size, size))
      std::fill_n(map.rgb.begin() + std::ptrdiff_t(3 * i), 3, std::uint8_t{64});
  return map;
}

/// The colours of the maps, with the errors at both ends and in the middle.
void write_scale(Html& html, double largest) {
  constexpr int kWidth = 256, kHeight = 12;
  std::vector<float> ramp(std::size_t{kWidth} * kHeight);
  for (std::size_t i = 0; i < ramp.size(); ++i)
    ramp[i] = float(largest * (2 * double(i % kWidth) / (kWidth - 1) - 1));
  const std::string end = fmt::format("{:.3g} % of the peak", 100 * largest);
  const Tag figure(html, "figure", {{"class", "scale"}});
  write_image(html, colour_picture(ramp, kWidth, kHeight, largest, kSignedColourMap),
              "colour scale from -" + end + " to +" + end);
  for (const std::string& label : {"-" + end + ": darker than the model", std::string("0"),
                                   "+" + end + ": brighter than the model"})
    html.element("figcaption", label);
}

void write_spheres(Html& html, const Spheres& spheres, const std::string& function,
                   const char* which) {
  html.element("h2", fmt::format("Spheres, n = {:g}{}", spheres.exponent, which));
  html.element("p", {{"class", "note"}},
               "Both pictures of a row have one exposure, by the model's peak. The third is their "
               "difference, as a share of that peak. Magenta or green is no number.");
  double largest = 1e-3;
  for (const SpherePair& pair : spheres.pairs)
    for (const float error : errors_of(pair, spheres.peak))
      if (std::isfinite(error)) largest = std::max(largest, std::abs(double(error)));
  {
    const Tag grid(html, "div", {{"class", "spheres"}});
    for (const SpherePair& pair : spheres.pairs) {
      const double stops = exposure_for_peak(std::max(peak_value(pair.model), 1e-30));
      const std::string light = fmt::format("light at {:g} degrees", pair.light_degrees);
      write_picture(html, to_display(pair.theirs, stops), function + ", " + light);
      write_picture(html, to_display(pair.model, stops), "model, " + light);
      write_picture(html, error_map(errors_of(pair, spheres.peak), pair.model.width(), largest),
                    "error, " + light);
    }
  }
  write_scale(html, largest);
}

void write_curve(Html& html, const Check& check) {
  double most = 0, least = 0;
  for (const auto* line : {&check.curve.theirs, &check.curve.model})
    for (const double value : *line)
      if (std::isfinite(value)) most = std::max(most, value), least = std::min(least, value);
  html.element("h2", "Over the angle");
  const Tag figure(html, "figure");
  html.raw(draw_chart(
      {.id = "over-angle",
       .title = "Radiance over the angle",
       .description = "Radiance of the function and of the model over the angle of the normal.",
       .width = 960,
       .height = 380,
       .x = {"angle of the normal from the half vector (degrees)", -90, 90},
       .y = {"radiance for unit irradiance", least < 0 ? -round_up(-least) : 0, round_up(most)},
       .series = {{"model", check.curve.degrees, check.curve.model, 0},
                  {check.record.function, check.curve.degrees, check.curve.theirs, 2}}}));
  html.element("figcaption", fmt::format("n = {:g}, with the light 60 degrees from the eye",
                                         check.shown_exponent));
}

}  // namespace

std::string report_page(const Check& check) {
  const records::ShaderCheck& record = check.record;
  Html html;
  html.raw("<!DOCTYPE html>\n");
  const std::string title = fmt::format("{} of {}", record.function, record.file);
  {
    const Tag document(html, "html", {{"lang", "en"}, {"xmlns", "http://www.w3.org/1999/xhtml"}});
    {
      const Tag head(html, "head");
      html.empty("meta", {{"charset", "utf-8"}});
      html.empty("meta", {{"http-equiv", "Content-Security-Policy"}, {"content", kPolicy}});
      html.empty("meta",
                 {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
      html.element("title", title);
      const Tag style(html, "style");
      html.raw(embedded::shader_check_style);
      html.raw(embedded::chart_style);
    }
    const Tag body(html, "body");
    html.element("h1", title);
    const bool passes = record.verdict == "passes";
    html.element("p", {{"class", passes ? "verdict" : "verdict differs"}},
                 passes ? fmt::format("It is {} within the rounding of float32.", record.model)
                        : fmt::format("It differs from {}: {}.", record.model,
                                      record.explanation ? record.explanation->sentence : ""));
    for (const Spheres& spheres : check.spheres)
      write_spheres(html, spheres, record.function,
                    &spheres == check.spheres.data() ? "" : ", furthest above what is allowed");
    write_curve(html, check);
    html.element("h2", "Figures");
    html.element("pre", report_text(record));
    html.element("p", {{"class", "note"}}, std::string(kNameAndVersion));
  }
  return html.str();
}

}  // namespace shader_check
}  // namespace lobelia

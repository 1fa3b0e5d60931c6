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
#include "compare/compare.hpp"
#include "studies/shader_check/check.hpp"

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

void write_picture(Html& html, const DisplayImage& picture, const std::string& words) {
  const Tag figure(html, "figure");
  html.empty("img", {{"src", picture_link(picture)},
                     {"alt", words},
                     {"width", std::to_string(picture.width)},
                     {"height", std::to_string(picture.height)}});
  html.element("figcaption", words);
}

void write_spheres(Html& html, const Check& check) {
  html.element("h2", fmt::format("Spheres, n = {:g}", check.shown_exponent));
  html.element("p", {{"class", "note"}},
               "Both pictures of a row have one exposure, by the model's peak. The difference is "
               "white at the larger of its own peak and a thousandth of the model's; magenta is no "
               "number.");
  const Tag grid(html, "div", {{"class", "spheres"}});
  for (const SpherePair& pair : check.spheres) {
    const double peak = std::max(peak_value(pair.model), 1e-30);
    double largest = 1e-3 * peak;
    for (std::size_t i = 0; i < pair.theirs.values().size(); ++i) {
      const double apart =
          std::abs(double(pair.theirs.values()[i]) - double(pair.model.values()[i]));
      if (std::isfinite(apart)) largest = std::max(largest, apart);
    }
    const double stops = exposure_for_peak(peak);
    const std::string light = fmt::format("light at {:g} degrees", pair.light_degrees);
    write_picture(html, to_display(pair.theirs, stops), check.record.function + ", " + light);
    write_picture(html, to_display(pair.model, stops), "model, " + light);
    write_picture(html, difference_picture(pair.theirs, pair.model, largest),
                  fmt::format("difference, white at {:.2g} of the peak", largest / peak));
  }
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
    write_spheres(html, check);
    write_curve(html, check);
    html.element("h2", "Figures");
    html.element("pre", report_text(record));
    html.element("p", {{"class", "note"}}, std::string(kNameAndVersion));
  }
  return html.str();
}

}  // namespace shader_check
}  // namespace lobelia

#include "program/command/profile_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "profile/clipping.hpp"
#include "profile/lobe_fit.hpp"

namespace lobelia::cli {
namespace {

using Radiance = records::Named<std::vector<double>>;

/// Lays out lines of a name and cells.
class Table {
 public:
  /// The first column is wide enough for the names of the differences: these hold those of the pictures.
  explicit Table(const records::Named<records::ZoneErrors>& differences) {
    for (const auto& [name, zones] : differences) width_ = std::max(width_, name.size() + 2);
  }
  std::string row(const std::string& head, std::initializer_list<std::string> cells) const {
    std::string line = fmt::format("{:<{}}", head, width_);
    for (const std::string& cell : cells) line += fmt::format("{:>12}", cell);
    return line + '\n';
  }

 private:
  std::size_t width_ = 24;
};

std::string curve_table(const Table& table, const records::Profile& profile) {
  std::string text = table.row("the curve", {"peak", "at degrees", "half-width", "energy"});
  for (const auto& [name, shape] : profile.images)
    text += table.row(name, {shown(shape.peak), shown(shape.peak_angle_degrees),
                             shown(shape.half_width_degrees), shown(shape.energy)});
  return text;
}

std::string figures_table(const Table& table, const records::Profile& profile) {
  std::string places =
      table.row("the highlight alone", {"peak", "at x", "y", "centroid x", "y", "energy"});
  std::string widths = table.row("half-width", {"along, px", "degrees", "across, px", "degrees"});
  std::string errors, remarks;
  for (const auto& [name, image] : profile.images) {
    const records::HighlightFigures& h = *image.highlight;
    places +=
        table.row(name, {shown(h.peak.radiance), three_digits(h.peak.x), three_digits(h.peak.y),
                         three_digits(h.centroid.x), three_digits(h.centroid.y), shown(h.energy)});
    widths += table.row(
        name,
        {three_digits(h.half_width_along.pixels), three_digits(h.half_width_along.degrees),
         three_digits(h.half_width_across.pixels), three_digits(h.half_width_across.degrees)});
    const records::CosineLobe& cosine = h.cosine_lobe;
    if (!cosine.because.empty())
      remarks += fmt::format("{}: no power of a cosine can be told: {}\n", name, cosine.because);
    else
      remarks += fmt::format(
          "{}: this highlight is a cosine lobe of n = {} (but for {:.2g} of its peak)\n", name,
          with_error(*cosine.exponent, *cosine.standard_error), *cosine.rms_of_peak);
    if (h.standard_errors && name != records::kAnalytic)
      errors += table.row(
          name,
          {shown(h.standard_errors->peak), three_digits(h.standard_errors->place.x),
           three_digits(h.standard_errors->place.y), three_digits(h.standard_errors->centroid.x),
           three_digits(h.standard_errors->centroid.y), shown(h.standard_errors->energy),
           three_digits(h.standard_errors->half_width_along_pixels),
           three_digits(h.standard_errors->half_width_across_pixels)});
    if (!h.because.empty()) remarks += fmt::format("{}: {}\n", name, h.because);
    if (const std::string remark = peak_remark(h.peak); !remark.empty())
      remarks += fmt::format("{}: {}\n", name, remark);
  }
  if (!errors.empty())
    errors = table.row("standard errors", {"peak", "at x", "y", "centroid x", "y", "energy",
                                           "along, px", "across, px"}) +
             errors + '\n';
  return places + '\n' + widths + '\n' + errors + remarks;
}

/// "exponent 121 +- 3 of Blinn-Phong", "GGX of alpha 0.128 +- 0.002 (roughness 0.358)".
std::string explanation(const records::LobeExplanation& one) {
  const std::string name = one.family == "phong"         ? "Phong"
                           : one.family == "blinn_phong" ? "Blinn-Phong"
                           : one.family == "ggx"         ? "GGX"
                                                         : "Beckmann";
  if (one.exponent)
    return fmt::format("exponent {} of {}{}", with_error(*one.exponent, *one.standard_error), name,
                       one.times_n_dot_l ? " times N.L" : "");
  return fmt::format("{} of alpha {} (roughness {:.3g})", name,
                     with_error(*one.alpha, *one.standard_error), *one.roughness);
}

/// The sentence on what a picture's highlight is, and how well the other families do.
std::string explanations_text(const std::string& name, const records::HighlightFigures& h) {
  if (h.explanations.empty()) return "";
  const records::LobeExplanation& best = h.explanations.front();
  if (!best.because.empty())
    return fmt::format("{}: no lobe explains this highlight: {}\n", name, best.because);
  std::string text = fmt::format("{}: this highlight is best explained by {}", name,
                                 explanation(best)),
              others;
  for (const records::LobeExplanation& one : std::span(h.explanations).subspan(1)) {
    if (!one.because.empty()) continue;
    if (*one.deviations_from_best < kToldApart)
      text += fmt::format(", or as well by {}", explanation(one));
    else
      others +=
          fmt::format("  {} is {} of the peak off\n", explanation(one), percent(*one.rms_of_peak));
  }
  text += fmt::format("\n  it is {} of the peak off", percent(*best.rms_of_peak));
  if (best.rms_of_noise)
    text += *best.rms_of_noise < 1.1 ? ", which is its noise"
                                     : fmt::format(", {:.3g} times its noise", *best.rms_of_noise);
  text += '\n' + others;
  if (h.pixels_show == "means")
    text += "  its pixels are means over their area, as it was fitted\n";
  if (h.pixels_show == "unknown")
    text +=
        "  whether its pixels are means over their area cannot be told: errors allow for both\n";
  if (h.clipped)
    text += fmt::format(
        "{}: clipped: {} of its pixels have the picture's largest {}. They are not fitted, but its "
        "peak and energy are too low and its half-widths too large\n",
        name, h.clipped->pixels, either_of(h.clipped->channels));
  return text + specks_text(name, h.specks);
}

}  // namespace

std::string shown(double x) { return std::isnan(x) ? "-" : fmt::format("{:.6g}", x); }
std::string three_digits(double x) { return std::isnan(x) ? "-" : fmt::format("{:.3f}", x); }

std::string peak_remark(const records::Peak& peak) {
  if (peak.found == "pixel") return "its peak is known to the pixel alone";
  if (peak.found == "plateau")
    return "its peak is the middle of many pixels of the same value: clipped, or flat";
  if (peak.found == "edge")
    return "its brightest pixel is at the border, at the sphere's rim or where light ends: the peak "
           "may lie beyond";
  return "";
}

std::string specks_text(const std::string& name, std::span<const records::Speck> specks) {
  std::string text;
  for (const records::Speck& speck : specks)
    text += fmt::format(
        "{}: {} of {} at ({:g}, {:g}) left out: a fault, or a highlight smaller than a pixel\n",
        name, speck.pixels == 1 ? "a single pixel" : fmt::format("{} pixels", speck.pixels),
        shown(speck.radiance), speck.place.x, speck.place.y);
  return text;
}

std::string with_error(double value, double error) {
  if (std::isnan(error)) return shown(value);
  error = std::max(error, 1e-6 * std::abs(value));
  if (!std::isfinite(value) || !std::isfinite(error)) return fmt::format("{} +- {}", value, error);
  if (!(error > 0)) return fmt::format("{} +- 0", value);
  int power = int(std::floor(std::log10(error)));
  // 0.14 keeps its second digit: as 0.1 it would lose a third of itself; 0.96 is 1.
  const double leading = error / std::pow(10, power);
  if (leading < 1.95) --power;
  if (leading >= 9.5) ++power;
  const double unit = std::pow(10, power);
  const int decimals = std::max(0, -power);
  return fmt::format("{:.{}f} +- {:.{}f}", std::round(value / unit) * unit, decimals,
                     std::round(error / unit) * unit, decimals);
}

std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

std::string differences_table(const records::Named<records::ZoneErrors>& differences) {
  if (differences.empty()) return "";
  const Table table(differences);
  std::string text =
      '\n' + table.row("difference", {"", "pixels", "max error", "rms error", "of the peak"});
  for (const auto& [name, zones] : differences)
    for (const auto& [zone, error] : {std::pair("epicentre", zones.epicentre),
                                      {"flank", zones.flank},
                                      {"blooming", zones.blooming}})
      text += table.row(zone == std::string_view("epicentre") ? name : "",
                        {zone, std::to_string(error.pixels), shown(error.max_abs), shown(error.rms),
                         shown(error.max_rel_peak)});
  return text;
}

std::string csv_head(const Radiance& columns) {
  std::string text;
  for (const auto& [name, column] : columns) text += "," + csv_field(name);
  return text + '\n';
}

std::string csv_values(const Radiance& columns, std::size_t line) {
  std::string text;
  for (const auto& [name, column] : columns) text += "," + records::json_number(column[line]);
  return text + '\n';
}

int style_of(std::size_t line) { return int(1 + line % 5); }

void set_top(Chart& chart) {
  double top = 0, bottom = 0;
  for (const ChartSeries& series : chart.series)
    for (const double value : series.y)
      if (std::isfinite(value)) {
        top = std::max(top, value);
        bottom = std::min(bottom, value);
      }
  chart.y = {"radiance", bottom < 0 ? -round_up(-bottom) : 0, round_up(top)};
}

std::string profile_text(const records::Profile& profile) {
  const Table table(profile.differences);
  std::string text;
  for (const auto& [name, image] : profile.images)
    if (image.highlight && name != records::kAnalytic)
      text += explanations_text(name, *image.highlight);
  if (!text.empty()) text += '\n';
  text += fmt::format("sphere {}, light {}", profile.sphere, profile.light);
  if (const auto& lobe = profile.lobe)
    text += fmt::format(": {}, lobe {} of n = {:g}", lobe->model,
                        lobe->formula.empty() ? lobe->lobe : lobe->formula, lobe->exponent);
  text += '\n';
  if (const auto& formula = profile.images.front().second.highlight;
      profile.lobe && formula && formula->peak.found == "none")
    return text + fmt::format("  no highlight to measure: {}\n", formula->because);
  text +=
      fmt::format("epicentre to {} degrees, flank to {}, blooming zone to {} ({} angle)\n",
                  shown(profile.zones.epicentre_degrees[1]), shown(profile.zones.flank_degrees[1]),
                  shown(profile.zones.blooming_degrees[1]),
                  profile.angle == "reflection" ? "reflection" : "half-vector");
  if (profile.lobe) {
    const auto& plane = profile.plane_of_incidence;
    text += plane
                ? fmt::format("plane of incidence along ({:.4f}, {:.4f}) of the picture, y down\n",
                              plane->x, plane->y)
                : "eye, sphere and light on a line: no plane of incidence; along is x, across y\n";
    text +=
        fmt::format("taken away beneath it, of its peak: {:.2g} diffuse, {:.2g} of other lights\n",
                    profile.subtracted->diffuse_of_peak, profile.subtracted->other_lights_of_peak);
  }
  text += '\n' + curve_table(table, profile);
  if (profile.lobe) text += '\n' + figures_table(table, profile);
  return text + differences_table(profile.differences);
}

std::string profile_csv(std::span<const records::Profile> profiles) {
  std::string text;
  for (const records::Profile& profile : profiles) {
    const records::ProfileCurve& curve = profile.curve;
    if (text.empty()) text = "sphere,light,angleDegrees,pixels" + csv_head(curve.radiance);
    for (std::size_t i = 0; i < curve.pixels.size(); ++i)
      text += fmt::format("{},{},{},{}", profile.sphere, profile.light,
                          records::json_number(curve.angle_degrees[i]), curve.pixels[i]) +
              csv_values(curve.radiance, i);
  }
  return text;
}

std::string profile_svg(const records::Profile& profile) {
  Chart chart;
  chart.id = "profile";
  chart.title = fmt::format("Highlight of light {} on sphere {}", profile.light, profile.sphere);
  chart.description = "Mean radiance of the pixels at each angle of the lobe.";
  const std::vector<double>& angle = profile.curve.angle_degrees;
  chart.x = {profile.angle == "reflection" ? "angle between light and mirror direction (degrees)"
                                           : "angle between normal and half vector (degrees)",
             0, angle.empty() ? 90 : angle.back()};
  const records::ZoneRanges& zones = profile.zones;
  chart.bands = {{zones.epicentre_degrees[0], zones.epicentre_degrees[1], "epicentre"},
                 {zones.flank_degrees[0], zones.flank_degrees[1], "flank"},
                 {zones.blooming_degrees[0], zones.blooming_degrees[1], "blooming zone"}};
  std::size_t line = 0;
  for (const auto& [name, column] : profile.curve.radiance) {
    const bool formula = name == records::kAnalytic;
    chart.series.push_back(
        {formula ? "formula" : name, angle, column, formula ? 0 : style_of(line++)});
  }
  set_top(chart);
  return draw_chart_file(chart);
}

}  // namespace lobelia::cli

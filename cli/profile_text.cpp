#include "cli/profile_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/svg_chart.hpp"
#include "core/text.hpp"
#include "records/record.hpp"

namespace lobelia::cli {
namespace {

using Radiance = records::Named<std::vector<double>>;

std::string shown(double x) { return std::isnan(x) ? "-" : fmt::format("{:.6g}", x); }
std::string three_digits(double x) { return std::isnan(x) ? "-" : fmt::format("{:.3f}", x); }

/// Lines of a table: a name, and cells.
class Table {
 public:
  /// Wide enough for the names of the pictures and of their differences.
  template <class T>
  explicit Table(const T& record) {
    for (const auto& [name, image] : record.images) width_ = std::max(width_, name.size() + 2);
    for (const auto& [name, zones] : record.differences) width_ = std::max(width_, name.size() + 2);
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

/// A remark on a peak that could not be fitted; empty for a fitted one.
std::string peak_remark(const records::Peak& peak) {
  if (peak.found == "pixel") return "its peak is known to the pixel alone";
  if (peak.found == "plateau")
    return "its peak is the middle of many pixels of the same value: clipped, or flat";
  if (peak.found == "edge")
    return "its brightest pixel is at the border, at the sphere's rim or where light ends: the peak "
           "may lie beyond";
  return "";
}

std::string figures_table(const Table& table, const records::Profile& profile) {
  std::string places =
      table.row("the highlight alone", {"peak", "at x", "y", "centroid x", "y", "energy"});
  std::string widths = table.row("half-width", {"along, px", "degrees", "across, px", "degrees"});
  std::string remarks;
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
    if (!h.because.empty()) remarks += fmt::format("{}: {}\n", name, h.because);
    if (const std::string remark = peak_remark(h.peak); !remark.empty())
      remarks += fmt::format("{}: {}\n", name, remark);
  }
  return places + '\n' + widths + '\n' + remarks;
}

std::string differences_table(const Table& table,
                              const records::Named<records::ZoneErrors>& differences) {
  if (differences.empty()) return "";
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

/// Lines 1 to 5; 0 lies broad beneath them.
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

}  // namespace

std::string with_error(double value, double error) {
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

std::string profile_text(const records::Profile& profile) {
  const Table table(profile);
  std::string text = fmt::format("sphere {}, light {}", profile.sphere, profile.light);
  if (const auto& lobe = profile.lobe)
    text += fmt::format(": {}, lobe {} of n = {:g}", lobe->model, lobe->lobe, lobe->exponent);
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
  return text + differences_table(table, profile.differences);
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

std::string blob_text(const records::Blob& blob) {
  const Table table(blob);
  std::string text =
      table.row("brightest blob", {"peak", "at x", "y", "centroid x", "y", "pixels"});
  for (const auto& [name, b] : blob.images)
    text += table.row(
        name, {shown(b.peak.radiance), three_digits(b.peak.x), three_digits(b.peak.y),
               three_digits(b.centroid.x), three_digits(b.centroid.y), std::to_string(b.pixels)});
  text += '\n' + table.row("half-width, pixels", {"long axis", "along x", "along y", "short axis",
                                                  "background", "energy"});
  std::string remarks;
  for (const auto& [name, b] : blob.images) {
    text += table.row(name, {three_digits(b.half_width_pixels.major), three_digits(b.major_axis.x),
                             three_digits(b.major_axis.y), three_digits(b.half_width_pixels.minor),
                             shown(b.background), shown(b.energy)});
    if (!b.because.empty())
      remarks += fmt::format("{}: no blob: {}\n", name, b.because);
    else if (!std::isnan(b.gaussian_sigma_pixels.major))
      remarks += fmt::format("{}: as wide as a Gaussian of {} x {} pixels standard deviation\n",
                             name, three_digits(b.gaussian_sigma_pixels.major),
                             three_digits(b.gaussian_sigma_pixels.minor));
    if (!b.remark.empty())
      remarks += fmt::format("{}: {}\n", name, b.remark);
    else if (const std::string remark = peak_remark(b.peak); !remark.empty())
      remarks += fmt::format("{}: {}\n", name, remark);
    if (b.nonfinite > 0)
      remarks += fmt::format("{}: {} pixels are not finite and are left out\n", name, b.nonfinite);
  }
  return text + '\n' + remarks +
         "An exponent needs to know which angle each pixel sees: --scene.\n" +
         differences_table(table, blob.differences);
}

std::string blob_csv(const records::Blob& blob) {
  std::string text;
  for (const auto& [axis, curve] : blob.curves) {
    if (text.empty()) text = "axis,offsetPixels" + csv_head(curve.radiance);
    for (std::size_t i = 0; i < curve.offset_pixels.size(); ++i)
      text +=
          axis + "," + records::json_number(curve.offset_pixels[i]) + csv_values(curve.radiance, i);
  }
  return text.empty() ? "axis,offsetPixels\n" : text;
}

std::string blob_svg(const records::Blob& blob) {
  Chart chart;
  chart.id = "blob";
  chart.title = "The brightest blob, along its axes";
  chart.description = "Radiance over the distance from the peak along the long and the short axis.";
  chart.x = {"pixels from the reference's peak", -1, 1};
  std::size_t line = 0;
  for (const auto& [axis, curve] : blob.curves) {
    chart.x.from = curve.offset_pixels.front();
    chart.x.to = curve.offset_pixels.back();
    for (const auto& [name, column] : curve.radiance)
      chart.series.push_back({fmt::format("{}, {} axis", name, axis == "major" ? "long" : "short"),
                              curve.offset_pixels, column, style_of(line++)});
  }
  set_top(chart);
  return draw_chart_file(chart);
}

}  // namespace lobelia::cli

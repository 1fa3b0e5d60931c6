#include "cli/profile_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/svg_chart.hpp"
#include "core/ticks.hpp"

namespace lobelia::cli {
namespace {

/// A number of the record, which is a name ("nan") where it is not finite.
double number(const Json& value) {
  if (!value.is_string()) return value.get<double>();
  const std::string name = value.get<std::string>();
  if (name == "nan") return std::numeric_limits<double>::quiet_NaN();
  return (name == "-inf" ? -1 : 1) * std::numeric_limits<double>::infinity();
}
std::string shown(const Json& value) {
  const double x = number(value);
  return std::isnan(x) ? "-" : fmt::format("{:.6g}", x);
}
std::string three_digits(const Json& value) {
  const double x = number(value);
  return std::isnan(x) ? "-" : fmt::format("{:.3f}", x);
}
std::string in_a_cell(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Lines of a table: a name, and cells.
class Table {
 public:
  /// Wide enough for the names of the pictures and of their differences.
  explicit Table(const Json& record) {
    for (const char* members : {"images", "differences"})
      for (const auto& [name, member] : record[members].items())
        width_ = std::max(width_, name.size() + 2);
  }
  std::string row(const std::string& head, std::initializer_list<std::string> cells) const {
    std::string line = fmt::format("{:<{}}", head, width_);
    for (const std::string& cell : cells) line += fmt::format("{:>12}", cell);
    return line + '\n';
  }

 private:
  std::size_t width_ = 24;
};

std::string curve_table(const Table& table, const Json& profile) {
  std::string text = table.row("the curve", {"peak", "at degrees", "half-width", "energy"});
  for (const auto& [name, shape] : profile["images"].items())
    text += table.row(name, {shown(shape["peak"]), shown(shape["peakAngleDegrees"]),
                             shown(shape["halfWidthDegrees"]), shown(shape["energy"])});
  return text;
}

/// What is to be said of a peak that is not a fitted one.
std::string peak_remark(const Json& peak) {
  const std::string found = peak["found"];
  if (found == "pixel") return "its peak is known to the pixel alone";
  if (found == "plateau")
    return "its peak is the middle of many pixels of the same value: clipped, or flat";
  if (found == "edge")
    return "its brightest pixel is at the border, at the sphere's rim or where light ends: the peak "
           "may lie beyond";
  return "";
}

std::string figures_table(const Table& table, const Json& profile) {
  std::string places =
      table.row("the highlight alone", {"peak", "at x", "y", "centroid x", "y", "energy"});
  std::string widths = table.row("half-width", {"along, px", "degrees", "across, px", "degrees"});
  std::string remarks;
  for (const auto& [name, image] : profile["images"].items()) {
    const Json& h = image["highlight"];
    const Json &peak = h["peak"], &centroid = h["centroid"];
    const Json &along = h["halfWidthAlong"], &across = h["halfWidthAcross"];
    places += table.row(
        name, {shown(peak["radiance"]), three_digits(peak["x"]), three_digits(peak["y"]),
               three_digits(centroid["x"]), three_digits(centroid["y"]), shown(h["energy"])});
    widths += table.row(name, {three_digits(along["pixels"]), three_digits(along["degrees"]),
                               three_digits(across["pixels"]), three_digits(across["degrees"])});
    const Json& cosine = h["cosineLobe"];
    if (cosine.contains("because"))
      remarks += fmt::format("{}: no power of a cosine can be told: {}\n", name,
                             cosine["because"].get<std::string>());
    else
      remarks += fmt::format(
          "{}: this highlight is a cosine lobe of n = {} (but for {:.2g} of its peak)\n", name,
          with_error(number(cosine["exponent"]), number(cosine["standardError"])),
          number(cosine["rmsOfPeak"]));
    if (h.contains("because"))
      remarks += fmt::format("{}: {}\n", name, h["because"].get<std::string>());
    if (const std::string remark = peak_remark(peak); !remark.empty())
      remarks += fmt::format("{}: {}\n", name, remark);
  }
  return places + '\n' + widths + '\n' + remarks;
}

std::string differences_table(const Table& table, const Json& differences) {
  if (differences.empty()) return "";
  std::string text =
      '\n' + table.row("difference", {"", "pixels", "max error", "rms error", "of the peak"});
  for (const auto& [name, zones] : differences.items())
    for (const auto& [zone, error] : zones.items())
      text += table.row(zone == "epicentre" ? name : "",
                        {zone, in_a_cell(error["pixels"]), shown(error["maxAbs"]),
                         shown(error["rms"]), shown(error["maxRelPeak"])});
  return text;
}

std::string csv_quoted(const std::string& name) {
  if (name.find_first_of(",\"\n\r") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

/// Names of the columns, and their values line by line, each after `front`.
std::string csv_head(const Json& columns) {
  std::string text;
  for (const auto& [name, column] : columns.items()) text += "," + csv_quoted(name);
  return text + '\n';
}
std::string csv_lines(const Json& columns, const std::string& front) {
  std::string text;
  const std::size_t count = columns.empty() ? 0 : columns.begin()->size();
  for (std::size_t line = 0; line < count; ++line) {
    text += front;
    for (const auto& [name, column] : columns.items()) text += "," + in_a_cell(column[line]);
    text += '\n';
  }
  return text;
}

std::vector<double> numbers(const Json& column) {
  std::vector<double> values;
  for (const Json& value : column) values.push_back(number(value));
  return values;
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

std::string profile_text(const Json& profile) {
  const Table table(profile);
  std::string text =
      fmt::format("sphere {}, light {}", profile["sphere"].get<int>(), profile["light"].get<int>());
  const bool has_figures = profile.contains("lobe");
  if (has_figures)
    text += fmt::format(": {}, lobe {} of n = {:g}", profile["lobe"]["model"].get<std::string>(),
                        profile["lobe"]["lobe"].get<std::string>(),
                        profile["lobe"]["exponent"].get<double>());
  text += '\n';
  const Json& formula = profile["images"].front();
  if (has_figures && formula["highlight"]["peak"]["found"] == "none")
    return text + fmt::format("  no highlight to measure: {}\n",
                              formula["highlight"]["because"].get<std::string>());
  text += "epicentre";
  for (const auto& [zone, range] : profile["zones"].items())
    text += fmt::format("{} to {}",
                        zone == "epicentreDegrees" ? ""
                        : zone == "flankDegrees"   ? " degrees, flank"
                                                   : ", blooming zone",
                        shown(range[1]));
  text +=
      fmt::format(" ({} angle)\n", profile["angle"] == "reflection" ? "reflection" : "half-vector");
  if (has_figures) {
    text += profile.contains("planeOfIncidence")
                ? fmt::format("plane of incidence along ({:.4f}, {:.4f}) of the picture, y down\n",
                              profile["planeOfIncidence"]["x"].get<double>(),
                              profile["planeOfIncidence"]["y"].get<double>())
                : "eye, sphere and light on a line: no plane of incidence; along is x, across y\n";
    text +=
        fmt::format("taken away beneath it, of its peak: {:.2g} diffuse, {:.2g} of other lights\n",
                    number(profile["subtracted"]["diffuseOfPeak"]),
                    number(profile["subtracted"]["otherLightsOfPeak"]));
  }
  text += '\n' + curve_table(table, profile);
  if (has_figures) text += '\n' + figures_table(table, profile);
  return text + differences_table(table, profile["differences"]);
}

std::string profile_csv(std::span<const Json> profiles) {
  std::string text;
  for (const Json& profile : profiles) {
    if (text.empty()) text = "sphere,light" + csv_head(profile["curve"]);
    text += csv_lines(profile["curve"], fmt::format("{},{}", profile["sphere"].get<int>(),
                                                    profile["light"].get<int>()));
  }
  return text;
}

std::string profile_svg(const Json& profile) {
  Chart chart;
  chart.id = "profile";
  chart.title = fmt::format("Highlight of light {} on sphere {}", profile["light"].get<int>(),
                            profile["sphere"].get<int>());
  chart.description = "Mean radiance of the pixels at each angle of the lobe.";
  const Json& curve = profile["curve"];
  const std::vector<double> angle = numbers(curve["angleDegrees"]);
  chart.x = {profile["angle"] == "reflection" ? "angle between light and mirror direction (degrees)"
                                              : "angle between normal and half vector (degrees)",
             0, angle.empty() ? 90 : angle.back()};
  for (const auto& [zone, range] : profile["zones"].items())
    chart.bands.push_back(
        {number(range[0]), number(range[1]),
         zone == "bloomingDegrees" ? "blooming zone" : zone.substr(0, zone.find("Degrees"))});
  std::size_t line = 0;
  for (const auto& [name, column] : curve.items()) {
    if (name == "angleDegrees" || name == "pixels") continue;
    const bool formula = name == "analytic";
    chart.series.push_back(
        {formula ? "formula" : name, angle, numbers(column), formula ? 0 : style_of(line++)});
  }
  set_top(chart);
  return draw_chart_file(chart);
}

std::string blob_text(const Json& blob) {
  const Table table(blob);
  std::string text =
      table.row("brightest blob", {"peak", "at x", "y", "centroid x", "y", "pixels"});
  for (const auto& [name, b] : blob["images"].items())
    text += table.row(name, {shown(b["peak"]["radiance"]), three_digits(b["peak"]["x"]),
                             three_digits(b["peak"]["y"]), three_digits(b["centroid"]["x"]),
                             three_digits(b["centroid"]["y"]), in_a_cell(b["pixels"])});
  text += '\n' + table.row("half-width, pixels", {"long axis", "along x", "along y", "short axis",
                                                  "background", "energy"});
  std::string remarks;
  for (const auto& [name, b] : blob["images"].items()) {
    text += table.row(
        name, {three_digits(b["halfWidthPixels"]["major"]), three_digits(b["majorAxis"]["x"]),
               three_digits(b["majorAxis"]["y"]), three_digits(b["halfWidthPixels"]["minor"]),
               shown(b["background"]), shown(b["energy"])});
    if (b.contains("because"))
      remarks += fmt::format("{}: no blob: {}\n", name, b["because"].get<std::string>());
    else if (!std::isnan(number(b["gaussianSigmaPixels"]["major"])))
      remarks += fmt::format("{}: as wide as a Gaussian of {} x {} pixels standard deviation\n",
                             name, three_digits(b["gaussianSigmaPixels"]["major"]),
                             three_digits(b["gaussianSigmaPixels"]["minor"]));
    if (b.contains("remark"))
      remarks += fmt::format("{}: {}\n", name, b["remark"].get<std::string>());
    else if (const std::string remark = peak_remark(b["peak"]); !remark.empty())
      remarks += fmt::format("{}: {}\n", name, remark);
    if (b["nonfinite"] > 0)
      remarks += fmt::format("{}: {} pixels are not finite and are left out\n", name,
                             in_a_cell(b["nonfinite"]));
  }
  return text + '\n' + remarks +
         "An exponent needs to know which angle each pixel sees: --scene.\n" +
         differences_table(table, blob["differences"]);
}

std::string blob_csv(const Json& blob) {
  std::string text;
  for (const auto& [axis, columns] : blob["curves"].items()) {
    if (text.empty()) text = "axis" + csv_head(columns);
    text += csv_lines(columns, axis);
  }
  return text.empty() ? "axis,offsetPixels\n" : text;
}

std::string blob_svg(const Json& blob) {
  Chart chart;
  chart.id = "blob";
  chart.title = "The brightest blob, along its axes";
  chart.description = "Radiance over the distance from the peak along the long and the short axis.";
  chart.x = {"pixels from the reference's peak", -1, 1};
  std::size_t line = 0;
  for (const auto& [axis, columns] : blob["curves"].items()) {
    const std::vector<double> offset = numbers(columns["offsetPixels"]);
    chart.x.from = offset.front();
    chart.x.to = offset.back();
    for (const auto& [name, column] : columns.items())
      if (name != "offsetPixels")
        chart.series.push_back(
            {fmt::format("{}, {} axis", name, axis == "major" ? "long" : "short"), offset,
             numbers(column), style_of(line++)});
  }
  set_top(chart);
  return draw_chart_file(chart);
}

}  // namespace lobelia::cli

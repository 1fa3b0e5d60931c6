#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "compare/profile/blob.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/svg_chart.hpp"
#include "farm/profile_scene.hpp"
#include "records/record.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

using Radiance = records::Named<std::vector<double>>;

std::string shown(double x) { return std::isnan(x) ? "-" : fmt::format("{:.6g}", x); }
std::string three_digits(double x) { return std::isnan(x) ? "-" : fmt::format("{:.3f}", x); }

/// Lays out lines of a name and cells.
class Table {
 public:
  /// The first column is wide enough for the names of the pictures and of their differences.
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

/// "124.3 +- 0.2": to the first digit of the error, to its second where that is a 1; no finer than a
/// millionth of the value, because float32 pictures tell no more.
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

/// Styles 1 to 5; 0 is the broad line beneath them.
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

/// A line per angle of each: sphere, light, and the columns of its curve. All have the same columns.
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

struct ProfileArguments {
  std::string a, b, scene, json, csv, svg;
  std::optional<int> light, sphere;
  SceneOverrides overrides;
};

/// The pictures' file names, or "a" and "b" where those are equal or stand for a column of ours.
std::pair<std::string, std::string> picture_names(const ProfileArguments& options) {
  const auto stem = [](const std::string& path) {
    return printable(std::filesystem::path(path).stem().string());
  };
  const std::string a = stem(options.a), b = stem(options.b);
  const auto reserved = [](const std::string& name) {
    return name.empty() || name == records::kAnalytic || name == "angleDegrees" ||
           name == "pixels" || name == "offsetPixels";
  };
  if (a != b && !reserved(a) && (options.b.empty() || !reserved(b))) return {a, b};
  return {"a", "b"};
}

/// With more highlights, a choice is required: measuring them would take minutes.
constexpr std::size_t kMostHighlights = 64;

std::vector<records::Profile> profiles_of(const Scene& scene, const ProfileArguments& options,
                                          const NamedImages& images) {
  if (options.light || options.sphere)
    return {profile_scene(scene, options.light.value_or(0), options.sphere.value_or(0), images)};
  const auto highlights = highlights_of(scene);
  if (highlights.empty())
    throw Error(
        ExitCode::kInput,
        fmt::format("{}: no sphere of it has a highlight, or there is no light", options.scene));
  if (highlights.size() > kMostHighlights)
    throw Error(
        ExitCode::kInput,
        fmt::format("{}: it has {} highlights, and up to {} are measured at once; choose one "
                    "with --sphere and --light",
                    options.scene, highlights.size(), kMostHighlights));
  std::vector<records::Profile> profiles;
  for (const auto& [sphere, light] : highlights)
    profiles.push_back(profile_scene(scene, light, sphere, images));
  return profiles;
}

/// The outputs, the same for profiles and blobs.
struct Result {
  std::string record, text, csv, svg;
};

Result measured(const ProfileArguments& options, const NamedImages& images) {
  if (options.scene.empty()) {
    const records::Blob record = blob_record(measure_blob(images));
    return {record_text(record), blob_text(record), blob_csv(record), blob_svg(record)};
  }
  Scene scene = read_scene(options.scene);
  options.overrides.apply(scene);
  const std::vector<records::Profile> profiles = profiles_of(scene, options, images);
  if (profiles.size() > 1 && !options.svg.empty())
    throw Error(ExitCode::kUsage,
                fmt::format("--svg draws one highlight, and there are {}: choose with --sphere and "
                            "--light",
                            profiles.size()));
  const bool chosen = options.light || options.sphere;
  Result result{chosen ? record_text(profiles.front()) : record_text(records::Profiles{profiles}),
                "", profile_csv(profiles), profile_svg(profiles.front())};
  for (const records::Profile& profile : profiles)
    result.text += (result.text.empty() ? "" : "\n") + profile_text(profile);
  return result;
}

void run_profile(const ProfileArguments& options) {
  const bool json_to_file = !options.json.empty() && options.json != "-";
  for (const std::string& path : {json_to_file ? options.json : "", options.csv, options.svg})
    if (!path.empty()) require_writable(path);

  const auto [name_a, name_b] = picture_names(options);
  const Image a = read_image(options.a);
  Image b;
  NamedImages images{{name_a, &a}};
  if (!options.b.empty()) {
    b = read_image(options.b);
    images.emplace_back(name_b, &b);
  }
  const Result result = measured(options, images);
  FilesTogether files;
  if (!options.csv.empty()) write_file(options.csv, result.csv);
  if (!options.svg.empty()) write_file(options.svg, result.svg);
  if (json_to_file) write_file(options.json, result.record);
  files.commit();
  fmt::print("{}", options.json == "-" ? result.record : result.text);
}

}  // namespace

void add_profile(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "profile", "Measure a highlight: peak, width, energy, exponent, and its curve");
  auto options = std::make_shared<ProfileArguments>();
  command->add_option("A", options->a, "Picture")->required();
  command->add_option("B", options->b, "Another one, the reference");
  add_reading_options(*command);
  auto* scene = command->add_option(
      "--scene", options->scene,
      "The scene file that the pictures show; without it the brightest blob is measured");
  const std::size_t before = command->get_options().size();
  command
      ->add_option("--light", options->light,
                   "Whose highlight: a light's number in the scene; default: every one")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--sphere", options->sphere,
                   "On which sphere: its number in the scene; default: every one")
      ->check(CLI::NonNegativeNumber);
  options->overrides.add_to(*command);
  const auto all = command->get_options();
  for (std::size_t i = before; i < all.size(); ++i) all[i]->needs(scene);
  OptionGroup output(*command, "Output");
  output.add("--json", options->json, "FILE|-",
             "Write the record to FILE; with - to stdout, and no table (kind profile of one chosen "
             "highlight, profiles of all, blob without a scene)");
  output.add("--csv", options->csv, "FILE", "Write the curves as a table with a line per angle");
  output.add("--svg", options->svg, "FILE", "Write the curves of one highlight as a chart");
  command->footer(
      "With a scene 'analytic' is its formula at each pixel's centre. The epicentre reaches to where\n"
      "the lobe has fallen to 1/2, the flank to 1/20, the blooming zone to 1/1000. Places are in pixels\n"
      "from the upper left corner, a pixel's centre at a half. The error of n is a standard error; of\n"
      "a picture without noise it says how far the lobe is from a power of a cosine. Radiance is the\n"
      "mean of R, G and B. docs/profiles.md defines every figure.\n"
      "\n"
      "Examples:\n"
      "  lobelia profile ours.exr povray.exr --scene reference_scenes/scenes/oblique_45.xml\n"
      "  lobelia profile mine.exr --json - --svg blob.svg\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 3 an input is unreadable or does not fit the scene, 4 an "
      "output\n"
      "cannot be written.");
  command->callback([options] { run_profile(*options); });
}

}  // namespace lobelia::cli

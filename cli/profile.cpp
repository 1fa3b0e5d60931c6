#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/scene_overrides.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "farm/profile_scene.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

struct Options {
  std::string a, b, scene, json, csv;
  int light = 0, sphere = 0;
  SceneOverrides overrides;
};

/// A number of the record, which is a name ("nan") where it is not finite.
std::string shown(const Json& number) {
  return number.is_string() ? number.get<std::string>()
                            : fmt::format("{:.6g}", number.get<double>());
}

std::string curve_as_csv(const Json& curve) {
  std::string text;
  for (const auto& [name, column] : curve.items())
    text += (text.empty() ? "" : ",") +
            (name.find_first_of(",\"\n") == std::string::npos ? name : fmt::format("\"{}\"", name));
  text += '\n';
  for (std::size_t row = 0; row < curve["angleDegrees"].size(); ++row) {
    std::string line;
    for (const auto& [name, column] : curve.items()) {
      if (!line.empty()) line += ',';
      line += column[row].is_string() ? column[row].get<std::string>() : column[row].dump();
    }
    text += line + '\n';
  }
  return text;
}

void print_table(const Json& record) {
  const auto zone_end = [&](const char* zone) { return shown(record["zones"][zone][1]); };
  fmt::print("epicentre to {} degrees, blooming zone to {} degrees ({} angle)\n\n",
             zone_end("epicentreDegrees"), zone_end("bloomingDegrees"),
             record["angle"] == "reflection" ? "reflection" : "half-vector");
  fmt::print("{:<24}{:>12}{:>12}{:>14}{:>14}\n", "", "peak", "at", "half-width", "energy");
  for (const auto& [name, shape] : record["images"].items())
    fmt::print("{:<24}{:>12}{:>12}{:>14}{:>14}\n", name, shown(shape["peak"]),
               shown(shape["peakAngleDegrees"]), shown(shape["halfWidthDegrees"]),
               shown(shape["energy"]));
  fmt::print("\n{:<24}{:<12}{:>12}{:>14}{:>14}\n", "", "", "max error", "rms error", "of the peak");
  for (const auto& [name, difference] : record["differences"].items())
    for (const auto& [zone, error] : difference.items())
      fmt::print("{:<24}{:<12}{:>12}{:>14}{:>14}\n", zone == "epicentre" ? name : "", zone,
                 shown(error["maxAbs"]), shown(error["rms"]), shown(error["maxRelPeak"]));
}

/// Names for the pictures that differ from each other, and from the formula's.
std::pair<std::string, std::string> picture_names(const Options& options) {
  const auto stem = [](const std::string& path) {
    return std::filesystem::path(path).stem().string();
  };
  const std::string a = stem(options.a), b = stem(options.b);
  const auto reserved = [](const std::string& name) {
    return name.empty() || name == kAnalyticName || name == "angleDegrees" || name == "pixels";
  };
  if (a != b && !reserved(a) && (options.b.empty() || !reserved(b))) return {a, b};
  return {"a", "b"};
}

void run(const Options& options) {
  Scene scene = read_scene(options.scene);
  options.overrides.apply(scene);
  const bool json_to_file = !options.json.empty() && options.json != "-";
  if (json_to_file) require_writable(options.json);
  if (!options.csv.empty()) require_writable(options.csv);

  const auto [name_a, name_b] = picture_names(options);
  const Image a = read_image(options.a);
  Image b;
  NamedImages images{{name_a, &a}};
  if (!options.b.empty()) {
    b = read_image(options.b);
    images.emplace_back(name_b, &b);
  }
  const Json record = profile_scene(scene, options.light, options.sphere, images);
  if (!options.csv.empty()) write_file(options.csv, curve_as_csv(record["curve"]));
  if (json_to_file) write_record(options.json, record);
  if (options.json == "-")
    fmt::print("{}", record_text(record));
  else
    print_table(record);
}

}  // namespace

void add_profile(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "profile", "Measure a highlight as a curve over the angle that its lobe sees");
  auto options = std::make_shared<Options>();
  command->add_option("A", options->a, "Picture of the scene")->required();
  command->add_option("B", options->b, "Another one, the reference");
  command->add_option("--scene", options->scene, "The scene file that the pictures show")
      ->required();
  command->add_option("--light", options->light, "Whose highlight: a light's number in the scene")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--sphere", options->sphere, "On which sphere: its number in the scene")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  options->overrides.add_to(*command);
  command
      ->add_option("--json", options->json,
                   "Write the record (kind profile) to FILE; with - to stdout, and no table")
      ->type_name("FILE|-")
      ->group("Output");
  command->add_option("--csv", options->csv, "Write the curves as a table with a line per angle")
      ->type_name("FILE")
      ->group("Output");
  command->footer(
      "'analytic' is the scene's formula at each pixel's centre, without shadows. The epicentre\n"
      "reaches to where the lobe has fallen to 1/2, the blooming zone from there to 1/1000.\n"
      "Radiance is the mean of R, G and B; angles are in degrees.\n"
      "\n"
      "Example:\n"
      "  lobelia profile ours.exr povray.exr --scene reference_scenes/scenes/oblique_45.xml\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 3 an input is unreadable or does not fit the scene, 4 an "
      "output\n"
      "cannot be written.");
  command->callback([options] { run(*options); });
}

}  // namespace lobelia::cli

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/profile_text.hpp"
#include "cli/scene_overrides.hpp"
#include "compare/profile/blob.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/text.hpp"
#include "farm/profile_scene.hpp"
#include "records/record.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

struct ProfileArguments {
  std::string a, b, scene, json, csv;
  std::string svg;
  std::optional<int> light, sphere;
  SceneOverrides overrides;
};

/// Names for the pictures that differ from each other, and from the formula's.
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

/// Most highlights that are measured without a choice. More would take minutes.
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
  add_any_format(*command);
  auto* scene = command->add_option(
      "--scene", options->scene,
      "The scene file that the pictures show; without it the brightest blob is measured");
  command
      ->add_option("--light", options->light,
                   "Whose highlight: a light's number in the scene; default: every one")
      ->check(CLI::NonNegativeNumber)
      ->needs(scene);
  command
      ->add_option("--sphere", options->sphere,
                   "On which sphere: its number in the scene; default: every one")
      ->check(CLI::NonNegativeNumber)
      ->needs(scene);
  const std::size_t before = command->get_options().size();
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

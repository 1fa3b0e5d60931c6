#include <algorithm>
#include <cmath>
#include <utility>

#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "farm/profile_scene.hpp"
#include "profile/blob.hpp"
#include "profile/measure_noise.hpp"
#include "profile/require_same_size.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"
#include "program/command/profile_report.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

/// The noise of one picture, as `lobelia compare` takes it.
struct NoiseOfPicture {
  std::string error;
  std::vector<std::string> replicates;

  void add_to(OptionGroup& group, const std::string& prefix, const std::string& picture) {
    auto* more = group.add(
        fmt::format("--{}replicate", prefix), replicates, "FILE",
        fmt::format(
            "Another, independent picture of what {0} is, from as many samples: {0} is their "
            "mean, and its noise what they scatter; may be given again",
            picture));
    more->expected(1)->take_all();
    group
        .add(fmt::format("--{}error", prefix), error, "FILE",
             fmt::format("Picture of the standard errors of {}, as render and reference "
                         "--standard-error write",
                         picture))
        ->excludes(more);
  }
  /// The picture becomes the mean of itself and its replicates.
  std::optional<PictureNoise> read(const std::string& path, Image& image) const {
    const auto beside = [&](const std::string& file) {
      Image picture = read_image(file);
      require_same_size(image, picture, path, file);
      return picture;
    };
    // The pixels of a renderer's picture share their sample points.
    if (!error.empty()) return noise_of_standard_errors(beside(error), kFreedomOfErrors, true);
    if (replicates.empty()) return std::nullopt;
    std::vector<Image> others;
    for (const std::string& replicate : replicates) others.push_back(beside(replicate));
    return noise_of_replicates(image, std::move(others));
  }
};

/// Numbers with commas between. Throws Error(kUsage).
template <std::size_t kCount>
std::array<double, kCount> numbers_of(const std::string& option, const std::string& text,
                                      std::string_view form) {
  std::array<double, kCount> numbers{};
  std::string_view rest = text;
  for (std::size_t k = 0; k < kCount; ++k) {
    const std::size_t comma = rest.find(',');
    const bool is_last = k + 1 == kCount;
    if (!parse_number(rest.substr(0, comma), numbers[k]) ||
        is_last != (comma == std::string_view::npos))
      throw Error(ExitCode::kUsage, "{} '{}' has to be {}", option, printable(text), form);
    if (!is_last) rest.remove_prefix(comma + 1);
  }
  return numbers;
}

BlobOptions blob_options(const std::string& at, const std::string& region, double least_share) {
  BlobOptions options;
  options.search.least_share = least_share;
  if (!at.empty()) {
    const auto [x, y] = numbers_of<2>("--at", at, "X,Y");
    options.search.at = {x, y};
  }
  if (!region.empty()) {
    const auto numbers = numbers_of<4>("--region", region, "X,Y,W,H");
    for (const double one : numbers)
      if (one != std::floor(one) || std::abs(one) > kMaxImageSide)
        throw Error(ExitCode::kUsage, "--region '{}' has to be whole pixels", printable(region));
    options.region = {int(numbers[0]), int(numbers[1]), int(numbers[2]), int(numbers[3])};
  }
  return options;
}

using NoiseOfImages = std::vector<const PictureNoise*>;

struct ProfileArguments {
  std::string a, b, scene, json, csv, svg;
  std::optional<int> light, sphere;
  SceneOverrides overrides;
  FilterOption filter;
  std::string at, region;
  double least_share = kLeastShare;
  NoiseOfPicture noise_a, noise_b;
  WorkLimits limits;
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
                                          const NamedImages& images, const NoiseOfImages& noise,
                                          std::optional<PixelsShow> shown) {
  if (options.light || options.sphere)
    return {profile_scene(scene, options.light.value_or(0), options.sphere.value_or(0), images,
                          true, noise, shown)};
  const auto highlights = highlights_of(scene);
  if (highlights.empty())
    throw Error(ExitCode::kInput, "{}: no sphere of it has a highlight, or there is no light",
                options.scene);
  if (highlights.size() > kMostHighlights)
    throw Error(ExitCode::kInput,
                "{}: it has {} highlights, and up to {} are measured at once; choose one "
                "with --sphere and --light",
                options.scene, highlights.size(), kMostHighlights);
  std::vector<records::Profile> profiles;
  for (const auto& [sphere, light] : highlights)
    profiles.push_back(profile_scene(scene, light, sphere, images, true, noise, shown));
  return profiles;
}

/// The outputs, the same for profiles and blobs.
struct Result {
  std::string record, text, csv, svg;
};

Result measured(const ProfileArguments& options, const NamedImages& images,
                const NoiseOfImages& noise) {
  if (options.scene.empty()) {
    BlobOptions blobs = blob_options(options.at, options.region, options.least_share);
    blobs.noise = noise;
    const records::Blobs record = blobs_record(measure_blobs(images, blobs), options.least_share);
    return {options.at.empty() ? record_text(record) : record_text(record.highlights.front()),
            blobs_text(record), blobs_csv(record), blobs_svg(record)};
  }
  Scene scene = read_scene(options.scene);
  options.overrides.apply(scene);
  std::optional<PixelsShow> shown;
  if (const auto means = options.filter.apply(scene.film))
    shown = *means ? PixelsShow::kMeans : PixelsShow::kCentres;
  const std::vector<records::Profile> profiles = profiles_of(scene, options, images, noise, shown);
  if (profiles.size() > 1 && !options.svg.empty())
    throw Error(ExitCode::kUsage,
                "--svg draws one highlight, and there are {}: choose with --sphere and "
                "--light",
                profiles.size());
  const bool chosen = options.light || options.sphere;
  Result result{chosen ? record_text(profiles.front()) : record_text(records::Profiles{profiles}),
                "", profile_csv(profiles), profile_svg(profiles.front())};
  for (const records::Profile& profile : profiles)
    result.text += (result.text.empty() ? "" : "\n") + profile_text(profile);
  return result;
}

void run_profile(const ProfileArguments& options) {
  const std::string* const written[] = {&options.json, &options.csv, &options.svg};
  if (std::ranges::count(written, kStdout, [](const std::string* path) { return *path; }) > 1)
    throw Error(ExitCode::kUsage, "only one of --json, --csv and --svg can go to stdout");
  OutputFiles outputs;
  for (const std::string& path : {options.a, options.b, options.scene}) outputs.reads(path);
  for (const NoiseOfPicture* noise : {&options.noise_a, &options.noise_b}) {
    outputs.reads(noise->error);
    for (const std::string& path : noise->replicates) outputs.reads(path);
  }
  for (const std::string* path : written) outputs.writes_report(*path);

  const auto [name_a, name_b] = picture_names(options);
  Image a = read_image(options.a), b;
  NamedImages images{{name_a, &a}};
  const std::optional<PictureNoise> noise_a = options.noise_a.read(options.a, a);
  std::optional<PictureNoise> noise_b;
  if (!options.b.empty()) {
    b = read_image(options.b);
    noise_b = options.noise_b.read(options.b, b);
    images.emplace_back(name_b, &b);
  }
  const Result result =
      measured(options, images, {noise_a ? &*noise_a : nullptr, noise_b ? &*noise_b : nullptr});
  write_reports(
      result.text,
      {{options.csv, result.csv}, {options.svg, result.svg}, {options.json, result.record}});
}

}  // namespace

void add_profile(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "profile", "Measure a highlight: peak, width, energy, exponent, and its curve");
  auto options = std::make_shared<ProfileArguments>();
  command->add_option("A", options->a, "Picture")->required();
  auto* second = command->add_option("B", options->b, "Another one, the reference");
  add_reading_options(*command);
  auto* scene = command->add_option(
      "--scene", options->scene,
      "The scene file that the pictures show; without it every highlight is looked for");
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
  OptionGroup pixels(*command, "With a scene");
  options->filter.add_to(pixels);
  const auto all = command->get_options();
  for (std::size_t i = before; i < all.size(); ++i) all[i]->needs(scene);
  OptionGroup where(*command, "Without a scene");
  where
      .add("--at", options->at, "X,Y",
           "Measure only the highlight at this place, or the nearest one")
      ->excludes(scene);
  where.add("--region", options->region, "X,Y,W,H", "Look only at these pixels")->excludes(scene);
  where
      .add_number("--least", options->least_share, 0, 1,
                  "Leave out highlights below this share of the brightest")
      ->excludes(scene);
  OptionGroup noise(*command, "Noise, for standard errors");
  options->noise_a.add_to(noise, "", "A");
  const std::size_t of_b = command->get_options().size();
  options->noise_b.add_to(noise, "b-", "B");
  for (std::size_t i = of_b; i < command->get_options().size(); ++i)
    command->get_options()[i]->needs(second);
  OptionGroup output(*command, "Output");
  add_json(output, options->json,
           "profile of one chosen highlight, profiles of all; without a scene blob and blobs");
  output.add("--csv", options->csv, "FILE|-",
             "Write the curves as a table with a line per angle or offset; with - likewise");
  output.add(
      "--svg", options->svg, "FILE|-",
      "Write the curves as a chart: of one highlight, or without a scene of up to five; with - "
      "likewise");
  options->limits.add_to(output);
  command->footer(
      "With a scene 'analytic' is its formula: the mean over each pixel with the film's filter, or its\n"
      "value at the pixel's centre, whichever the pictures show. The epicentre reaches to where the lobe\n"
      "has fallen to 1/2, the flank to 1/20, the blooming zone to 1/1000. Every family of lobes is\n"
      "fitted, and the first lines say which explains the highlight best. Roughness is the root of alpha.\n"
      "\n"
      "Without a scene every highlight is measured, down to a tenth of the brightest. Peak and widths\n"
      "are over the background, which is printed too. A single bright pixel is named and left out.\n"
      "\n"
      "Places are in pixels from the upper left corner, a pixel's centre at a half. Errors are standard\n"
      "errors: from --error or --replicate, or else from the scatter of the pixels. Radiance is the\n"
      "mean of R, G and B. docs/profiles.md defines every figure.\n"
      "\n"
      "Examples:\n"
      "  lobelia profile ours.exr povray.exr --scene reference_scenes/scenes/oblique_45.xml\n"
      "  lobelia profile mine.exr --json - --svg highlights.svg\n"
      "  lobelia profile mine.exr --at 812,340\n"
      "  lobelia profile mine.exr --replicate mine-seed2.exr --region 0,0,400,300\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 3 an input is unreadable or does not fit the scene, 4 an "
      "output\n"
      "cannot be written.");
  command->callback([options] { options->limits.run([&] { run_profile(*options); }); });
}

}  // namespace lobelia::cli

#include "program/command/options.hpp"

#include <algorithm>
#include "program/command/common_options.hpp"

#include "base/pictures/contained_reader.hpp"
#include "base/pictures/picture_file.hpp"
#include "base/system/files.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/formula.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia::cli {
namespace {

template <class Number, class Target>
void replace(const std::optional<Number>& value, std::string_view option, double min, double max,
             Target& target) {
  if (!value) return;
  // Written so that a NaN is refused too.
  if (!(double(*value) >= min && double(*value) <= max))
    throw Error(ExitCode::kUsage, "{} {} is out of range; allowed: {:g} to {:g}", option, *value,
                min, max);
  target = Target(*value);
}

}  // namespace

CLI::Validator not_empty() {
  return {[](const std::string& text) {
            if (text.empty()) return std::string("a name is expected, and it is empty");
            // As in '--html -q'. A file of such a name is ./-q.
            if (text.size() > 1 && text[0] == '-')
              return fmt::format("a name is expected, and '{}' is an option", printable(text));
            return std::string();
          },
          ""};
}

CLI::Validator between(double min, double max) {
  return {[=](std::string& text) { return number_problem(text, min, max); },
          fmt::format("{:g} to {:g}", min, max)};
}

void add_reading_options(CLI::App& command) {
  command.add_flag_callback(
      "--any-format", [] { read_any_picture_format(); },
      fmt::format("Read every format that OpenImageIO knows, not only {}", kPictureFormats));
  // Was removed, and hidden here says what to do.
  command
      .add_flag_callback("--base-only",
                         [] {
                           throw Error(ExitCode::kUsage,
                                       "--base-only was removed: gain maps are not applied any "
                                       "more; leave it out");
                         })
      ->group("");
}

std::size_t chosen_place(const std::string& value, std::string_view option,
                         std::span<const std::string_view> names) {
  return chosen(value, option, names, [&](const std::string& name) {
    const auto place = std::size_t(std::ranges::find(names, name) - names.begin());
    return place < names.size() ? std::optional(place) : std::nullopt;
  });
}

std::filesystem::path checked_record_path(const std::filesystem::path& image) {
  if (image.extension() != ".exr")
    throw Error(ExitCode::kUsage, "-o {}: pictures are linear float32; the name must end in .exr",
                image.string());
  const auto record = std::filesystem::path(image).replace_extension(".json");
  require_writable(image);
  require_writable(record);
  return record;
}

void EnginePrograms::add_to(CLI::App& command) {
  for (const EngineInfo& engine : engine_infos())
    if (engine.is_program)
      command
          .add_option(fmt::format("--{}", engine.name), typed_[std::string(engine.name)],
                      fmt::format("Program to use for {}, if not the one in $PATH", engine.title))
          ->type_name("PATH");
}

std::map<std::string, std::filesystem::path> EnginePrograms::given() const {
  std::map<std::string, std::filesystem::path> programs;
  for (const auto& [engine, program] : typed_)
    if (!program.empty()) programs[engine] = program;
  return programs;
}

std::filesystem::path EnginePrograms::of(std::string_view engine) const {
  const auto found = typed_.find(engine);
  return found == typed_.end() ? std::filesystem::path() : found->second;
}

void LobeOption::add_to(OptionGroup& group, const std::string& usual) {
  usual_ = usual;
  group.add("--lobe", name_, "", fmt::format("Lobe: {}", allowed_lobes(true)))->default_str(usual);
  group.add("--formula", formula_, "",
            fmt::format("Formula of the lobe '{}', in s = 1 - cos, c = 1 - s, the angle x and n: "
                        "'1 / (1 + n * s)'",
                        kFormulaLobe));
}

std::optional<LobeId> LobeOption::lobe() const {
  const std::string name = name_.value_or(formula_ ? std::string(kFormulaLobe) : usual_);
  if (formula_) {
    if (name != kFormulaLobe)
      throw Error(ExitCode::kUsage, "--formula is for --lobe {}, not for '{}'", kFormulaLobe,
                  printable(name));
    try {
      return formula_lobe(*formula_);
    } catch (const FormulaError& e) {
      throw Error(ExitCode::kUsage, "--{}", e.what());
    }
  }
  if (name == kFormulaLobe)
    throw Error(ExitCode::kUsage, "--lobe {} needs a --formula", kFormulaLobe);
  if (name.empty() && !name_) return std::nullopt;
  return chosen(name, "--lobe", lobe_names(), allowed_lobes(true), find_lobe);
}

void require_lobe(const Highlight& highlight) {
  if (const std::string why = why_not_a_lobe(highlight); !why.empty())
    throw Error(ExitCode::kUsage, why);
}

void set_chosen_model(Highlight& highlight, const std::string& name, std::string_view option) {
  highlight = chosen(name, option, settable_models(), [&](const std::string& model) {
    Highlight with = highlight;
    return set_model(with, model) ? std::optional(with) : std::nullopt;
  });
}

void SceneOverrides::add_to(CLI::App& command) {
  OptionGroup group(command, "In place of what the scene says");
  group.add("--model", model_, "", fmt::format("Model: {}", join(settable_models())));
  lobe_.add_to(group);
  group.add("--normalisation", normalisation_, "",
            fmt::format("Coefficient: {}", join(normalisation_names())));
  auto* exponent = group.add("--exponent", exponent_, "",
                             fmt::format("Sharpness n, {} to {:g}", kMinExponent, kMaxExponent));
  group
      .add("--roughness", roughness_, "",
           fmt::format("Roughness of GGX, {} to 1, in place of the exponent", kLeastRoughness))
      ->excludes(exponent);
  group.add("--width", width_, "", "Width of the picture in pixels");
  group.add("--height", height_, "", "Height of the picture in pixels");
  add_common(group, "--samples", samples_);
  add_common(group, "--seed", seed_, ": the positions of samples and points");
}

void SceneOverrides::apply(Scene& scene) const {
  const std::optional<LobeId> lobe = lobe_.lobe();
  Highlight unused;  // wrong values are refused for a scene without materials too
  std::vector<Highlight*> highlights{&unused};
  for (auto& material : scene.materials) highlights.push_back(&material.highlight);
  for (Highlight* const highlight : highlights) {
    if (model_) set_chosen_model(*highlight, *model_, "--model");
    if (lobe && model_ == kGgx && *lobe != highlight->lobe)
      throw Error(ExitCode::kUsage, "--model {} has a lobe of its own; leave --lobe out", kGgx);
    if (lobe) highlight->lobe = *lobe;
    if (normalisation_)
      highlight->normalisation =
          chosen(*normalisation_, "--normalisation", normalisation_names(), find_normalisation);
    replace(exponent_, "--exponent", kMinExponent, kMaxExponent, highlight->exponent);
    if (double roughness = 0; roughness_) {
      replace(roughness_, "--roughness", kLeastRoughness, 1, roughness);
      highlight->exponent = exponent_of_roughness(roughness);
    }
    if (highlight != &unused) require_lobe(*highlight);
  }
  replace(width_, "--width", 1, kMaxImageSide, scene.film.width);
  replace(height_, "--height", 1, kMaxImageSide, scene.film.height);
  if (std::int64_t{scene.film.width} * scene.film.height > kMaxFilmPixels)
    throw Error(ExitCode::kUsage, "{} x {} pixels are too many; allowed: {} in all",
                scene.film.width, scene.film.height, kMaxFilmPixels);
  replace(samples_, "--samples", 1, 65536, scene.sampler.sample_count);
  replace(seed_, "--seed", 0, 0x1p53, scene.sampler.seed);  // what a scene file can hold
}

CLI::Option* FilterOption::add_to(OptionGroup& group) {
  return group.add("--filter", text_, "NAME[,RADIUS]",
                   fmt::format("How the pictures were averaged over their pixels, the radius in "
                               "pixels: {}; none: they show their pixels' centres. Usually the "
                               "scene's filter if it has several samples, or else what fits",
                               join(filter_names())));
}

std::optional<bool> FilterOption::apply(Film& film) const {
  constexpr std::string_view kNone = "none";
  constexpr double kSmallest = 0.1, kLargest = 16;  // as in a scene file
  if (text_.empty()) return std::nullopt;
  if (text_ == kNone) return false;
  const std::size_t comma = text_.find(',');
  film.filter = chosen(text_.substr(0, comma), "--filter", filter_names(),
                       join(filter_names()) + ", none", find_filter);
  if (comma == std::string::npos) return true;
  if (!parse_number(std::string_view(text_).substr(comma + 1), film.filter.radius) ||
      !(film.filter.radius >= kSmallest && film.filter.radius <= kLargest))
    throw Error(ExitCode::kUsage, "--filter '{}': a radius is {:g} to {:g} pixels",
                printable(text_), kSmallest, kLargest);
  return true;
}

}  // namespace lobelia::cli

// Adds a project to the command line of `lobelia compare`.
#include <fmt/chrono.h>

#include "cli/compare_arguments.hpp"
#include "core/text.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

constexpr char kUsualFile[] = "lobelia.toml";

/// A project's paths are from its own directory.
class FromProject {
 public:
  explicit FromProject(const fs::path& file) : folder_(file.parent_path()) {}
  std::string operator()(const std::string& path) const {
    return path.empty() ? path : (folder_ / path).lexically_normal().string();
  }
  std::vector<std::string> operator()(std::vector<std::string> paths) const {
    for (std::string& path : paths) path = (*this)(path);
    return paths;
  }
  /// Rectangles and polygons stay as they are.
  std::vector<std::string> masks(std::vector<std::string> masks) const {
    for (std::string& mask : masks)
      if (is_picture_of_mask(mask)) mask = (*this)(mask);
    return masks;
  }

 private:
  fs::path folder_;
};

std::vector<MetricLimit> limits_of(std::string_view where, const std::vector<std::string>& texts) {
  std::vector<MetricLimit> limits;
  for (const std::string& text : texts) limits.push_back(parse_limit(where, text));
  return limits;
}

PairRule rule_of(const records::ProjectRule& rule, std::size_t number, const FromProject& from) {
  const auto where = [&](const char* key) { return fmt::format("rules[{}].{}", number, key); };
  const auto shapes = [&](const char* key, const std::vector<std::string>& texts) {
    std::vector<MaskShape> shapes;
    for (const std::string& text : from.masks(texts))
      shapes.push_back(parse_mask_shape(where(key), text));
    return shapes;
  };
  PairRule made{rule.match,
                limits_of(where("fail"), rule.fail),
                limits_of(where("warn"), rule.warn),
                {},
                rule.default_limits,
                shapes("mask", rule.mask),
                shapes("ignore", rule.ignore)};
  if (!rule.tolerance.empty()) made.tolerance = parse_tolerance(where("tolerance"), rule.tolerance);
  return made;
}

void apply_pictures(const records::Project& project, const FromProject& from,
                    PairingChoice& pictures) {
  std::vector<std::string>& given = pictures.given;
  if (pictures.csv.empty() && given.empty()) pictures.csv = from(project.pairs);
  if (!pictures.csv.empty()) return;
  const std::vector<std::string> judged = from(project.judged),
                                 references = from(project.references);
  const bool judges_given = !given.empty();
  if (!judges_given && !judged.empty()) given.push_back(judged.front());
  if (given.size() == 1 && !references.empty()) {
    given.push_back(references.front());
    pictures.also_accepted.assign(references.begin() + 1, references.end());
  }
  if (!judges_given && judged.size() > 1)
    given.insert(given.end(), judged.begin() + 1, judged.end());
  if (pictures.pattern.empty()) {
    pictures.pattern = project.pattern;
    if (pictures.sets.empty()) pictures.sets = project.sets;
  }
}

void apply(const records::Project& project, const fs::path& file, CompareArguments& options) {
  const FromProject from(file);
  CompareJob& job = options.job;
  ComparisonOptions& comparison = job.comparison;
  apply_pictures(project, from, job.pictures);
  if (options.html.title.empty()) options.html.title = project.title;
  comparison.limits = with_limits(limits_of("fail", project.fail), comparison.limits);
  comparison.warnings = with_limits(limits_of("warn", project.warn), comparison.warnings);
  if (!comparison.tolerance && !project.tolerance.empty())
    comparison.tolerance = parse_tolerance("tolerance", project.tolerance);
  comparison.default_limits = comparison.default_limits && project.default_limits.value_or(true);
  job.regions.add(from.masks(project.mask), from.masks(project.ignore));
  options.viewing.suggest_exposure(project.exposure);
  if (options.layer.empty() && !job.layers.all) options.layer = project.layer;
  if (job.scene.empty()) job.scene = from(project.scene);
  job.layers.ignore_alpha = job.layers.ignore_alpha || project.ignore_alpha.value_or(false);
  for (std::size_t i = 0; i < project.rules.size(); ++i)
    job.rules.push_back(rule_of(project.rules[i], i, from));
  job.known = project.known;
  job.today = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace

void apply_project(CompareArguments& options) {
  if (options.project.empty()) {
    const PairingChoice& pictures = options.job.pictures;
    std::error_code unknown;
    if (options.sensitivity || !pictures.given.empty() || !pictures.csv.empty() ||
        !fs::exists(kUsualFile, unknown))
      return;
    options.project = kUsualFile;
  }
  const records::Project project = records::read_project(options.project);
  try {
    apply(project, options.project, options);
  } catch (const Error& error) {
    throw Error(ExitCode::kInput,
                fmt::format("{}: {}", printable_path(options.project), error.what()));
  }
}

}  // namespace lobelia::cli

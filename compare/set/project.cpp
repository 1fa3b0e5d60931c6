// Fills in what a choice leaves open from a project.
#include <fmt/chrono.h>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "compare/set/job.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

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

PairRule rule_of(const records::ProjectRule& rule, std::size_t number, const FromProject& from) {
  const auto where = [&](const char* key) { return fmt::format("rules[{}].{}", number, key); };
  const auto shapes = [&](const char* key, const std::vector<std::string>& texts) {
    std::vector<MaskShape> shapes;
    for (const std::string& text : from.masks(texts))
      shapes.push_back(parse_mask_shape(where(key), text));
    return shapes;
  };
  PairRule made{rule.match,
                parse_limits(where("fail"), rule.fail),
                parse_limits(where("warn"), rule.warn),
                {},
                rule.default_limits,
                shapes("mask", rule.mask),
                shapes("ignore", rule.ignore)};
  if (!rule.tolerance.empty()) made.tolerance = parse_tolerance(where("tolerance"), rule.tolerance);
  return made;
}

void apply_pictures(const records::Project& project, const FromProject& from,
                    CompareChoice& choice) {
  std::vector<std::string>& given = choice.given;
  if (choice.pairs.empty() && given.empty()) choice.pairs = from(project.pairs);
  if (!choice.pairs.empty()) return;
  const std::vector<std::string> judged = from(project.judged),
                                 references = from(project.references);
  const bool judges_given = !given.empty();
  if (!judges_given && !judged.empty()) given.push_back(judged.front());
  if (given.size() == 1 && !references.empty()) {
    given.push_back(references.front());
    choice.also_accept.assign(references.begin() + 1, references.end());
  }
  if (!judges_given && judged.size() > 1)
    given.insert(given.end(), judged.begin() + 1, judged.end());
  if (choice.pattern.empty()) {
    choice.pattern = project.pattern;
    if (choice.sets.empty()) choice.sets = project.sets;
  }
}

/// The project's noise of a picture, where the choice has none of it.
void fill_in_noise(const records::Project& project, const FromProject& from,
                   CompareChoice& choice) {
  const auto is_from_layers = [&](const char* letter) {
    return choice.noise_from_layers == letter || choice.noise_from_layers == "both";
  };
  // A pattern such as "*_variance.exr", for a file beside each picture, has no folder.
  const auto file = [&](const std::string& given) {
    return given.starts_with('*') ? given : from(given);
  };
  if (choice.a_error.empty() && choice.a_variance.empty() && choice.a_replicate.empty() &&
      !is_from_layers("a")) {
    choice.a_variance = file(project.judged_variance);
    if (choice.a_samples == 0) choice.a_samples = project.judged_samples.value_or(0);
  }
  if (choice.b_error.empty() && choice.b_variance.empty() && choice.b_replicate.empty() &&
      !is_from_layers("b")) {
    choice.b_variance = file(project.reference_variance);
    if (choice.b_samples == 0) choice.b_samples = project.reference_samples.value_or(0);
  }
}

void fill_in(const records::Project& project, CompareChoice& choice, CompareJob& job) {
  const FromProject from(choice.project);
  ComparisonOptions& comparison = job.comparison;
  apply_pictures(project, from, choice);
  job.title = project.title;
  comparison.limits = with_limits(parse_limits("fail", project.fail), comparison.limits);
  comparison.warnings = with_limits(parse_limits("warn", project.warn), comparison.warnings);
  if (!comparison.tolerance && !project.tolerance.empty())
    comparison.tolerance = parse_tolerance("tolerance", project.tolerance);
  comparison.default_limits = comparison.default_limits && project.default_limits.value_or(true);
  // A mask of the choice counts alone.
  if (choice.mask.empty()) choice.mask = from.masks(project.mask);
  const std::vector<std::string> ignored = from.masks(project.ignore);
  choice.ignore.insert(choice.ignore.begin(), ignored.begin(), ignored.end());
  if (choice.exposure.empty()) choice.exposure = project.exposure;
  if (choice.layer.empty() && !choice.all_layers) choice.layer = project.layer;
  // The last one counts.
  choice.layer_type.insert(choice.layer_type.begin(), project.layer_types.begin(),
                           project.layer_types.end());
  if (choice.scene.empty()) choice.scene = from(project.scene);
  fill_in_noise(project, from, choice);
  if (choice.missing_reference.empty()) choice.missing_reference = project.missing_reference;
  choice.ignore_alpha = choice.ignore_alpha || project.ignore_alpha.value_or(false);
  for (std::size_t i = 0; i < project.rules.size(); ++i)
    job.rules.push_back(rule_of(project.rules[i], i, from));
  job.known = project.known;
  job.today = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace

void apply_project(CompareChoice& choice, CompareJob& job) {
  job.project = choice.project;
  const records::Project project = records::read_project(choice.project);
  try {
    fill_in(project, choice, job);
  } catch (const Error& error) {
    throw Error(ExitCode::kInput, "{}: {}", printable_path(choice.project), error.what());
  }
}

}  // namespace lobelia

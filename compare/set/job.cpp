#include "compare/set/job.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>

#include "base/pictures/colour.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "compare/layer_types.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

bool is_match(const std::string& match, const std::string& name) {
  return ::fnmatch(match.c_str(), name.c_str(), 0) == 0;
}

void add_scene(const ReadScene& read_scene, CompareJob& job) {
  if (!read_scene) throw Error(ExitCode::kUsage, "--scene: scenes cannot be read here");
  ComparisonOptions& comparison = job.comparison;
  const bool with_edges =
      comparison.tolerance.has_value() || std::ranges::any_of(job.rules, [](const PairRule& rule) {
        return rule.tolerance.has_value();
      });
  SceneParts scene = read_scene(job.scene, with_edges);
  comparison.surfaces = std::move(scene.surfaces);
  comparison.mask_of = {job.scene};
  if (comparison.tolerance) comparison.tolerance->edges = scene.edges;
  for (PairRule& rule : job.rules)
    if (rule.tolerance) rule.tolerance->edges = scene.edges;
}

/// Throws Error(kInput) where a rule of the project names no metric that takes a limit, or an impossible limit.
void check_rules(const CompareJob& job) {
  for (std::size_t i = 0; i < job.rules.size(); ++i) try {
      ComparisonOptions judged = job.comparison;
      judged.limits = job.rules[i].limits;
      judged.warnings = job.rules[i].warnings;
      check_options(judged);
    } catch (const Error& error) {
      throw Error(ExitCode::kInput, "{}: rules[{}]: {}", printable_path(job.project), i,
                  error.what());
    }
}

void check_together(const CompareChoice& choice, const CompareJob& job) {
  const ComparisonOptions& comparison = job.comparison;
  if (comparison.noise && job.layers.all)
    throw Error(ExitCode::kUsage,
                "--all-layers: the noise of one layer says nothing of the others");
  if (comparison.noise && comparison.allow_equal_nonfinite)
    throw Error(ExitCode::kUsage,
                "--allow-equal-nonfinite: a value that is not finite has no noise; leave out the "
                "noise of A and B");
  if (choice.no_default_limits && comparison.limits.empty() && !comparison.tolerance &&
      !comparison.noise)
    throw Error(ExitCode::kUsage,
                "--no-default-limits: nothing is left to judge by; add --fail METRIC=LIMIT or "
                "--tolerance");
}

}  // namespace

PairingChoice pictures_of(const CompareChoice& choice) {
  return {.given = choice.given,
          .also_accepted = choice.also_accept,
          .csv = choice.pairs,
          .pattern = choice.pattern,
          .sets = choice.sets};
}

CompareJob make_job(CompareChoice choice, const ReadScene& read_scene) {
  CompareJob job;
  ComparisonOptions& comparison = job.comparison;
  comparison = usual_options();
  comparison.default_limits = !choice.no_default_limits;
  comparison.allow_equal_nonfinite = choice.allow_equal_nonfinite;
  comparison.limits = parse_limits("--fail", choice.fail);
  comparison.warnings = parse_limits("--warn", choice.warn);
  for (const std::string& name : split(choice.metrics, ","))
    comparison.metrics.push_back(metric_in_short(name));
  if (!choice.tolerance.empty())
    comparison.tolerance = parse_tolerance("--tolerance", choice.tolerance);
  if (!choice.project.empty()) apply_project(choice, job);
  job.pictures = pictures_of(choice);
  job.c = choice.reference_floor;
  job.missing_reference_fails = choice.missing_reference == "fail";
  job.scene = choice.scene;
  job.ocio = choice.ocio;
  job.layers = {parse_layer_names(choice.layer), choice.all_layers, choice.ignore_alpha};
  for (const std::string& text : choice.layer_type)
    comparison.layer_types.push_back(parse_layer_type(text));
  choose_viewing(choice, comparison.viewing);
  comparison.viewing.display =
      DisplayView::open({choice.ocio, choice.display, choice.view, choice.input_space});
  if (!job.scene.empty()) add_scene(read_scene, job);
  job.parts = PictureParts(choice, comparison);
  job.noise = NoiseFiles(choice, comparison);
  job.pictures.companions = job.noise.endings();
  check_together(choice, job);
  check_options(comparison);
  check_rules(job);
  return job;
}

ComparisonOptions judging_options(const CompareChoice& choice) {
  return make_job(choice, nullptr).comparison;
}

std::vector<MetricLimit> with_limits(std::vector<MetricLimit> limits,
                                     const std::vector<MetricLimit>& more) {
  std::erase_if(limits, [&](const MetricLimit& limit) {
    return std::ranges::count(more, limit.metric, &MetricLimit::metric) > 0;
  });
  limits.insert(limits.end(), more.begin(), more.end());
  return limits;
}

CompareJob job_of(const CompareJob& job, const std::string& name) {
  CompareJob own = job;
  ComparisonOptions& options = own.comparison;
  for (const PairRule& rule : job.rules) {
    if (!is_match(rule.match, name)) continue;
    options.limits = with_limits(options.limits, rule.limits);
    options.warnings = with_limits(options.warnings, rule.warnings);
    if (rule.tolerance) options.tolerance = rule.tolerance;
    if (rule.default_limits) options.default_limits = *rule.default_limits;
    own.parts.change(rule.mask, rule.ignored, options);
  }
  return own;
}

std::optional<records::Known> known_of(const CompareJob& job, const std::string& name) {
  for (const records::KnownDifference& known : job.known)
    if (is_match(known.match, name))
      return records::Known{known.reason, known.expires, known.expires < job.today};
  return std::nullopt;
}

void check_companions(const CompareJob& job, const Pairing& pairing) {
  const auto fail = [&](std::string_view what) {
    throw Error(ExitCode::kUsage,
                "{} needs two files, or folders that are paired by "
                "name, in which it has the same name",
                what);
  };
  const bool by_name = pairing.is_by_name;
  if (!by_name && !is_one_pair(pairing)) {
    if (!job.c.empty()) fail("--reference-floor");
    if (!job.noise.files("").empty()) fail("a picture of noise");
  }
  std::error_code unknown;
  if (!job.c.empty() && fs::is_directory(job.c, unknown) != by_name)
    throw Error(ExitCode::kInput, "{} is {}a folder, but {} is{}; compare two files or two folders",
                job.pictures.given.front(), by_name ? "" : "not ", job.c, by_name ? " not" : "");
}

}  // namespace lobelia

#include "compare/compare.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "cli/commands.hpp"
#include "cli/compare_arguments.hpp"
#include "cli/messages.hpp"
#include "cli/options.hpp"
#include "cli/replaced_references.hpp"
#include "compare/highlight_region.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/sensitivity.hpp"
#include "core/colour.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/scratch_memory.hpp"
#include "core/threads.hpp"
#include "records/record.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

/// The id with a threshold in its shortest form, as a record has it.
std::string in_shortest_form(const std::string& id) {
  const MetricOutput* output = find_metric_output(id);
  return output ? std::string(output->id) : id;
}

/// Prints what the limits let pass of changed copies of the picture.
ExitCode run_sensitivity(const CompareArguments& options) {
  const CompareJob& job = options.job;
  for (const auto& [given, name] :
       {std::pair(job.pictures.given.size() > 1, "B"),
        {!options.html.path.empty(), "--html"},
        {!job.c.empty(), "--reference-floor"},
        {job.comparison.noise.has_value(), "the noise of a picture"},
        {!job.difference.path.empty(), "--diff-image"},
        {!job.difference.histogram.empty(), "--histogram"},
        {options.accept, "--accept"},
        {!job.pictures.also_accepted.empty(), "--also-accept"},
        {!(options.csv.empty() && options.junit.empty() && options.markdown.empty()),
         "--csv, --junit and --markdown"}})
    if (given)
      throw Error(
          ExitCode::kUsage,
          fmt::format("--sensitivity takes one picture and changes it itself: leave out {}", name));
  if (job.pictures.given.empty()) throw Error(ExitCode::kUsage, "--sensitivity needs a picture: A");
  const std::string& picture = job.pictures.given.front();
  const bool has_table = !prints_report(options);
  Pairing of_one;
  of_one.rows.push_back({.name = {}, .files = {picture}});
  require_outputs(options, of_one);
  FilesTogether files;
  std::vector<Change> changes;
  ThreadLimit(options.threads).run([&] {
    PicturePair pictures{read_picture(picture, job.layers.layer.a), {}};
    pictures.b = pictures.a;
    ComparisonOptions comparison = job.comparison;
    job.regions.apply(pictures.a.image.width(), pictures.a.image.height(), comparison);
    take_part(pictures, picture, picture, comparison);
    changes = sensitivity(pictures.b.image, comparison);
  });
  const bool as_expected = are_as_expected(changes);
  const ExitCode code = as_expected ? ExitCode::kSuccess : ExitCode::kDiffers;
  if (!options.json.empty()) {
    const std::string record =
        record_text(sensitivity_record(picture, changes, options.job.comparison));
    if (has_table) write_file(options.json, record);
    files.commit();
    if (!has_table) fmt::print("{}", record);
  }
  if (!has_table) return code;
  fmt::print("{}\n\n  {:<38}{:<12}{}\n", printable_path(picture), "changed copy", "verdict", "by");
  for (const Change& change : changes) {
    const std::string why = change.is_as_expected() ? change.found_by
                            : change.expected == Expected::kFound
                                ? "NOT FOUND"
                                : "FOUND, though it is no difference: " + change.found_by;
    fmt::print("  {:<38}{:<{}}{}\n", change.name, verdict_name(change.verdict),
               why.empty() ? 0 : 12, why);
  }
  fmt::print("\n{}\n", as_expected ? "These limits find what they should."
                                   : "These limits do not find what they should.");
  return code;
}

/// Throws Error(kInput) where a rule of the project names no metric that takes a limit, or an impossible limit.
void check_rules(const CompareArguments& options) {
  for (std::size_t i = 0; i < options.job.rules.size(); ++i) try {
      const PairRule& rule = options.job.rules[i];
      ComparisonOptions judged = options.job.comparison;
      judged.limits = rule.limits;
      judged.warnings = rule.warnings;
      check_options(judged);
    } catch (const Error& error) {
      throw Error(ExitCode::kInput, fmt::format("{}: rules[{}]: {}",
                                                printable_path(options.project), i, error.what()));
    }
}

ExitCode run_compare(CompareArguments options) {
  choose_colours(options.colour);
  options.print.colour = stdout_has_colours();
  options.print.quiet = verbosity().quiet;
  options.print.verbose = verbosity().verbose;
  ComparisonOptions& comparison = options.job.comparison;
  for (const std::string& given : {options.a, options.b})
    if (!given.empty()) options.job.pictures.given.push_back(given);
  for (const std::string& given : options.further) options.job.pictures.given.push_back(given);
  comparison.highlight = true;
  comparison.default_limits = !options.no_default_limits;
  for (const std::string& text : options.fail)
    comparison.limits.push_back(parse_limit("--fail", text));
  for (const std::string& text : options.warn)
    comparison.warnings.push_back(parse_limit("--warn", text));
  for (const std::string& name : split(options.metrics, ","))
    comparison.metrics.push_back(in_shortest_form(name));
  if (!options.tolerance.empty())
    comparison.tolerance = parse_tolerance("--tolerance", options.tolerance);
  apply_project(options);
  options.job.layers.layer = parse_layer_names(options.layer);
  options.viewing.apply(comparison.viewing);
  comparison.viewing.display = DisplayView::open(options.display);
  if (!options.job.scene.empty()) {
    const Scene scene = read_scene(options.job.scene);
    comparison.surfaces = truth::surface_mask(scene);
    comparison.mask_of = {options.job.scene};
    const auto set_edges = [&](std::optional<Tolerance>& tolerance) {
      if (tolerance) tolerance->edges = truth::edge_ring(scene);
    };
    set_edges(comparison.tolerance);
    for (PairRule& rule : options.job.rules) set_edges(rule.tolerance);
  }
  options.job.regions.read(comparison);
  options.job.noise.apply(comparison);
  if (comparison.noise && options.job.layers.all)
    throw Error(ExitCode::kUsage,
                "--all-layers: the noise of one layer says nothing of the others");
  if (comparison.noise && comparison.allow_equal_nonfinite)
    throw Error(ExitCode::kUsage,
                "--allow-equal-nonfinite: a value that is not finite has no noise; leave out the "
                "noise of A and B");
  if (options.no_default_limits && comparison.limits.empty() && !comparison.tolerance &&
      !comparison.noise)
    throw Error(ExitCode::kUsage,
                "--no-default-limits: nothing is left to judge by; add --fail METRIC=LIMIT or "
                "--tolerance");
  check_options(comparison);
  check_rules(options);
  if (options.sensitivity) return run_sensitivity(options);
  if (options.job.pictures.given.empty() && options.job.pictures.csv.empty())
    throw Error(ExitCode::kUsage,
                "A and B are required, the pictures to judge and the references, or a --project");
  const bool has_table = !prints_report(options);
  if (options.accept) require_person();
  options.job.hash_files = options.accept;
  const Pairing pairing = pair_finished(options.job.pictures);
  const bool one = is_one_pair(pairing);
  check_companions(options.job, pairing);
  options.job.difference.check(!one, comparison.viewing.hdr_exposures.has_value());
  require_outputs(options, pairing);

  keep_large_pieces_in_files();
  SetReport report;
  {
    FilesTogether files;
    const std::size_t count = pairs_of(pairing).size();
    ProgressLine progress;
    ThreadLimit(options.threads).run([&] {
      report = compare_pairs(options.job, pairing, [&](std::size_t done) {
        if (!one)
          progress.show(double(done) / double(count), fmt::format("{} of {} pairs", done, count));
      });
    });
    progress.clear();
    write_reports(options, report, one, files);
  }
  const bool unreadable = one && !report.pairs.front().comparison;
  if (!options.html.path.empty() && !unreadable)
    ThreadLimit(options.threads).run([&] {
      write_html(options.html, options.job, pairing, report);
    });
  if (has_table && !one) print_set(report, options.print);
  if (has_table && one && !unreadable) print_pair(report.pairs.front(), options.print);
  if (options.format == "github") fmt::print("{}", set_github(report));
  if (unreadable) throw Error(ExitCode::kInput, report.pairs.front().error);
  if (options.accept && accept_pictures(options, pairing, report)) return ExitCode::kSuccess;
  require_pairs(report);
  return set_exit_code(report);
}

std::string footer() {
  return fmt::format(
      "Metrics that a limit can be set on:\n"
      "  {}\n"
      "Of most there is one more for a part of the picture: with .highlight at the end (rmse.highlight) of\n"
      "the pixels that have {:g} % of the peak of A or B, and with --mask or --scene .mask and .outside.\n"
      "The default limits are {}, {}. --sensitivity shows what they find.\n"
      "Channels are taken by their names, grey as three equal ones. A file's integers are decoded from\n"
      "sRGB to linear light unless it says otherwise, floats are light; the record says how each was read.\n"
      "Of a picture that is a crop of its display window, the rest is black. Data outside of it are compared as\n"
      "well; what one side alone has there fails, unless it is 0. Alpha is judged where both have one.\n"
      "What was not compared is named in a line.\n"
      "A NaN or an infinity in either picture is a verdict of its own and does not pass, but for one that\n"
      "both have in the same place, with --allow-equal-nonfinite or in a layer of depth.\n"
      "Where noise is known the verdict is same, different, or undecided: the noise leaves it open, and\n"
      "more samples are needed (docs/metrics.md).\n"
      "\n"
      "Examples:\n"
      "  lobelia compare ours.exr povray.exr\n"
      "  lobelia compare ours.exr povray.exr --tolerance 6e-4,1e-8,3 --scene scene.xml\n"
      "  lobelia compare ours.exr blender.exr --fail max_rel_peak=3e-5 --fail flip.ldr.mean=1e-3\n"
      "  lobelia compare half1.exr reference.exr --a-replicate half2.exr --b-error error.exr\n"
      "\n"
      "  lobelia compare --sensitivity reference.exr\n"
      "  lobelia compare renders/ references/ --html report/ --junit report.xml\n"
      "  lobelia compare renders/ --pattern '{{scene}}_{{engine}}.exr' --sets engine=mine,reference\n"
      "  lobelia compare --project lobelia.toml --accept\n"
      "\n"
      "A picture's format is told by its first bytes, not by its name. A picture that crashes its decoder\n"
      "is an error of its pair, and the others go on.\n"
      "Of two folders, a name that only B has fails, one that only A has is named. A link to a folder is\n"
      "followed if it stays inside A or B; else it is named and fails. A file that nearly is a frame of a\n"
      "sequence, as f.01.exr is of f.%d.exr, is named and fails too. Exit codes: 0 pass or same, 1 over a\n"
      "limit, not measured, not finite, missing, misnamed or not followed, 2 usage, 3 a picture is\n"
      "unreadable, has no such layer or another size, or there is no pair, 4 an output cannot be written,\n"
      "6 undecided, 130 Ctrl-C, 143 SIGTERM.",
      join(limit_names(false)), 100 * kHighlightShare, limits_text(default_limits()),
      limits_text(highlight_limits()));
}

void add_display_options(OptionGroup& viewing, DisplayViewChoice& display) {
  viewing.add(
      "--ocio", display.config, "FILE",
      fmt::format("Show the perceptual metrics what this OpenColorIO configuration shows; {} "
                  "is Lobelia's own; default: $OCIO, or Lobelia's own",
                  kOwnConfig));
  viewing.add("--display", display.display, "NAME", "Its display; default: its first");
  viewing.add("--view", display.view, "NAME", "The view of that display; default: its first");
  viewing.add("--input-space", display.input_space, "NAME",
              "The colour space of A and B in it; default: its linear Rec. 709, or else its "
              "role scene_linear");
}

}  // namespace

void check_companions(const CompareJob& job, const Pairing& pairing) {
  const auto fail = [&](std::string_view what) {
    throw Error(ExitCode::kUsage, fmt::format("{} needs two files, or folders that are paired by "
                                              "name, in which it has the same name",
                                              what));
  };
  const bool by_name = has_folders_by_name(job, pairing);
  if (!by_name && !is_one_pair(pairing)) {
    if (!job.c.empty()) fail("--reference-floor");
    if (!job.noise.files("").empty()) fail("a picture of noise");
  }
  std::error_code unknown;
  if (!job.c.empty() && fs::is_directory(job.c, unknown) != by_name)
    throw Error(ExitCode::kInput,
                fmt::format("{} is {}a folder, but {} is{}; compare two files or two folders",
                            job.pictures.given.front(), by_name ? "" : "not ", job.c,
                            by_name ? " not" : ""));
}

void require_pairs(const SetReport& report) {
  if (report.pairs.empty())
    throw Error(ExitCode::kInput,
                fmt::format("no pair to compare: {} references have no picture, {} pictures no "
                            "reference, and {} files are no pictures or do not fit the pattern",
                            report.missing.size(), report.extra.size(), report.passed_over));
}

MetricLimit parse_limit(std::string_view where, const std::string& text) {
  // The last one, because an id may hold another: relmse.eps=0.01.
  const std::size_t equals = text.rfind('=');
  MetricLimit limit{in_shortest_form(text.substr(0, equals)), 0};
  const bool is_percent = text.ends_with('%');
  const std::size_t digits = text.size() - std::min(text.size(), equals + 1) - is_percent;
  if (equals == std::string::npos || !parse_number(text.substr(equals + 1, digits), limit.limit))
    throw Error(ExitCode::kUsage,
                fmt::format("{} {}: expected METRIC=LIMIT, for example rmse=0.001", where,
                            printable(text)));
  const MetricOutput* output = find_metric_output(limit.metric);
  if (is_percent && output && output->unit != Unit::kShare)
    throw Error(ExitCode::kUsage,
                fmt::format("{} {}: {} is no share, so its limit is no percentage", where,
                            printable(text), limit.metric));
  if (is_percent) limit.limit /= 100;
  return limit;
}

Tolerance parse_tolerance(std::string_view where, const std::string& text) {
  const std::vector<std::string> parts = split(text, ",");
  Tolerance tolerance;
  long long count = 0;
  if (parts.size() != 3 || !parse_number(parts[0], tolerance.relative) ||
      !parse_number(parts[1], tolerance.of_peak) || !parse_integer(parts[2], count))
    throw Error(ExitCode::kUsage, fmt::format("{} {}: expected RELATIVE,OF_PEAK,OUTLIERS, "
                                              "for example 6e-4,1e-6,3",
                                              where, printable(text)));
  tolerance.allowed_outliers = count;
  return tolerance;
}

void add_compare(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand("compare", "Compare two pictures: metrics and a verdict");
  auto options = std::make_shared<CompareArguments>();
  CompareJob& job = options->job;
  Viewing& viewing = job.comparison.viewing;
  command->add_option("A", options->a,
                      "Picture to judge, a folder of them, or a sequence such as a.%04d.exr");
  command->add_option(
      "B", options->b,
      "Reference picture, of the same size, or a folder or sequence of references: pictures are "
      "paired by their name within the folders, or by their number");
  command->add_option("MORE", options->further, "Further pictures, each judged against B as A is");
  OptionGroup pairs(*command, "Pairs");
  pairs.add("--pairs", job.pictures.csv, "FILE.csv",
            "In place of A and B: a table whose first line has the titles of the sets, the "
            "reference second, and perhaps 'name'; each further line is a pair of files");
  pairs.add("--pattern", job.pictures.pattern, "PATTERN",
            "Pair by fields of the names within the folders, such as '{scene}_{light}.exr'; {} "
            "fits what differs");
  pairs.add("--sets", job.pictures.sets, "FIELD=A,B[,..]",
            "The field of --pattern that tells the sets apart, and its values: with it one folder "
            "can hold all sets");
  OptionGroup general(*command);
  general.add(
      "--project", options->project, "FILE",
      "Sets of pictures, limits by their names, masks, known differences: TOML, or JSON if it ends in "
      ".json (docs/comparing.md). The command line counts more. Default without A: lobelia.toml");
  general
      .add("--also-accept", job.pictures.also_accepted, "B2",
           "A further reference, in the form of B: each picture is judged by the one that it "
           "fits best; may be given again")
      ->expected(1)
      ->take_all();
  general.add_flag(
      "--accept", options->accept,
      "Afterwards, show which references would change, ask, and copy A over those that "
      "it differs from; only at a terminal, never in CI. lobelia accept --undo puts them back");
  general.add("--reference-floor", job.c, "C",
              "A second reference: how far it is from B is shown beside how far A is");
  add_reading_options(*command);
  OptionGroup layers(*command, "Layers"), verdict(*command, "Verdict"), look(*command, "Viewing"),
      output(*command, "Output");
  auto* layer = layers.add(
      "--layer", options->layer, "NAME",
      "Compare this layer of both files: a prefix of channels, an EXR part, a view of a stereo EXR, or one "
      "channel; diffuse=ViewLayer.DiffDir where the files call it differently");
  layers
      .add_flag("--all-layers", job.layers.all,
                "Compare every layer; the verdict is the worst, and a layer that only B has fails")
      ->excludes(layer);
  layers.add_flag("--ignore-alpha", job.layers.ignore_alpha,
                  "Do not judge the alpha of the picture, which is judged where both have one");
  command
      ->add_flag_callback(
          "--list-metrics",
          [] {
            fmt::print("{}", metrics_document());
            throw CLI::Success();
          },
          "List the metrics: id, family, direction, meaning, source (docs/metrics.md)")
      ->trigger_on_parse()  // before A and B are asked for
      ->group("Output");

  const auto add_limits = [&](const char* name, auto& limits, const char* help) {
    verdict.add(name, limits, "METRIC=LIMIT", help)->expected(1)->take_all();
  };
  add_limits(
      "--fail", options->fail,
      "Verdict 'differs' if METRIC is over LIMIT (a likeness, such as psnr: below it); a limit on a "
      "share may be a percentage (share_over.abs=0.004=10%); may be given again");
  verdict.add(
      "--metrics", options->metrics, "LIST",
      "Measure only these, and what the limits are on: ids or their beginnings (rmse,flip.ldr), "
      "families (colour), with a region (rmse.mask), regions (highlight), default or all. "
      "Default limits are still judged, unless --no-default-limits leaves them out");
  verdict.add_flag(
      "--no-default-limits", options->no_default_limits,
      "Judge by --fail and --tolerance alone; otherwise they add to the default limits, "
      "each of which --fail on the same metric replaces");
  verdict.add_flag(
      "--sensitivity", options->sensitivity,
      "Of A alone: what would these limits let pass? Compares changed copies of it, and "
      "ends with 1 if one that matters is not found");
  add_limits("--warn", options->warn, "As --fail, but a line and no verdict; may be given again");
  verdict.add("--tolerance", options->tolerance, "REL,PEAK,COUNT",
              "A pixel is an outlier if |A - B| > REL * |B| + PEAK * (brightest value of B) in "
              "any channel; verdict 'differs' if there are more than COUNT");
  verdict.add("--scene", job.scene, "",
              "Measure errors on the pixels that see a surface of this scene as well (ids in "
              ".mask); with --tolerance, outliers may lie only on its silhouettes, terminators "
              "and shadow edges");
  verdict.add_flag(
      "--allow-equal-nonfinite", job.comparison.allow_equal_nonfinite,
      "A NaN or an infinity that both pictures have in the same pixel and channel is no "
      "difference; always so for layers named Z, ZBack, depth, distance or position");

  job.regions.add_to(*command);
  job.noise.add_to(*command);

  options->viewing.add_to(*command, viewing);
  add_display_options(look, options->display);

  add_json(output, options->json,
           "comparison, of folders comparison-set, with --sensitivity sensitivity");
  output.add("--csv", options->csv, "FILE|-",
             "Write a table with a line for each pair; with - to stdout, likewise");
  output.add("--junit", options->junit, "FILE.xml|-",
             "Write the verdicts as JUnit's XML, for continuous integration; with - to "
             "stdout, likewise");
  output.add(
      "--markdown", options->markdown, "FILE|-",
      "Write what does not pass as Markdown, for a pull request; with - to stdout, likewise");
  output.add_choice("--format", options->format, {"text", "github"},
                    "With github, print a line for each problem besides, which GitHub Actions "
                    "shows beside the change");
  output.add_choice("--color", options->colour, {"auto", "always", "never"},
                    "Colour the verdicts; auto: on a terminal, unless $NO_COLOR is set");
  output.add_choice("--junit-undecided", options->junit_undecided, {"failure", "skipped"},
                    "What an undecided pair is in --junit");
  auto* html = output.add("--html", options->html.path, "DIR",
                          "Write a report: all pairs, the worst first, each with its pictures, "
                          "maps, values and verdict; DIR/index.html opens without a server");
  output
      .add_flag(
          "--single-file", options->html.single_file,
          "The report is one file that can be sent: DIR/index.html, or DIR if it ends in .html")
      ->needs(html);
  output.add("--title", options->html.title, "TEXT", "The title of the report")->needs(html);
  job.difference.add_to(*command);
  add_common(output, "--threads", options->threads)->check(between(0, 1024))->capture_default_str();
  options->limits.add_time_limit_to(output);
  command->footer(footer());
  command->callback(
      [options, &exit_code] { options->limits.run([&] { exit_code = run_compare(*options); }); });
}

}  // namespace lobelia::cli

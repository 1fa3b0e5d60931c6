#include "compare/compare.hpp"

#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/system/scratch_memory.hpp"
#include "base/system/threads.hpp"
#include "compare/highlight_region.hpp"
#include "compare/layer_types.hpp"
#include "compare/layers.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/sensitivity.hpp"
#include "compare/set/unjudged_limits.hpp"
#include "program/command/commands.hpp"
#include "program/command/compare/compare_arguments.hpp"
#include "program/command/compare/compare_options.hpp"
#include "program/command/compare/replaced_references.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"

namespace lobelia::cli {
namespace {

/// Prints what the limits let pass of changed copies of the picture.
ExitCode run_sensitivity(const CompareArguments& options) {
  const CompareJob& job = options.job;
  for (const auto& [given, name] :
       {std::pair(job.pictures.given.size() > 1, "B"),
        {!options.html.path.empty(), "--html"},
        {!job.c.empty(), "--reference-floor"},
        {job.comparison.noise.has_value(), "the noise of a picture"},
        {!options.difference.path.empty(), "--diff-image"},
        {options.accept, "--accept"},
        {!job.pictures.also_accepted.empty(), "--also-accept"},
        {!(options.csv.empty() && options.junit.empty() && options.markdown.empty()),
         "--csv, --junit and --markdown"}})
    if (given)
      throw Error(ExitCode::kUsage,
                  "--sensitivity takes one picture and changes it itself: leave out {}", name);
  if (job.pictures.given.empty()) throw Error(ExitCode::kUsage, "--sensitivity needs a picture: A");
  const std::string& picture = job.pictures.given.front();
  const bool has_table = !prints_report(options);
  Pairing of_one;
  of_one.rows.push_back({.name = {}, .files = {picture}});
  require_outputs(options, of_one);
  FilesTogether files;
  std::vector<Change> changes;
  std::vector<std::string> unused;
  ThreadLimit(options.choice.threads).run([&] {
    PicturePair pictures{read_picture(picture, job.layers.layer.a), {}};
    pictures.b = pictures.a;
    ComparisonOptions comparison = job.comparison;
    job.parts.apply(pictures.a.image.width(), pictures.a.image.height(), comparison);
    take_part(pictures, picture, picture, comparison);
    const LayerType type = type_of_layers(pictures.b.source, pictures.b.source, comparison);
    if (type != LayerType::kColour)
      throw Error(ExitCode::kUsage, "--sensitivity needs a layer of colours; this one has type {}",
                  layer_type_name(type));
    changes = sensitivity(pictures.b.image, options_of_type(type, comparison));
    unused = limits_of_other_types(comparison.limits, type, false);
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
  std::size_t width = 38;
  for (const Change& change : changes) width = std::max(width, change.name.size() + 2);
  fmt::print("{}\n\n  {:<{}}{:<12}{}\n", printable_path(picture), "changed copy", width, "verdict",
             "by");
  for (const Change& change : changes) {
    const std::string why = change.is_as_expected() ? change.found_by
                            : change.expected == Expected::kFound
                                ? "NOT FOUND"
                                : "FOUND, though it is no difference: " + change.found_by;
    fmt::print("  {:<{}}{:<{}}{}\n", change.name, width, verdict_name(change.verdict),
               why.empty() ? 0 : 12, why);
  }
  if (!unused.empty())
    fmt::print("\n  not used, because this layer has colours: limits on {}\n",
               fmt::join(unused, ", "));
  fmt::print("\n{}\n", as_expected ? "These limits find what they should."
                                   : "These limits do not find what they should.");
  return code;
}

ExitCode run_compare(CompareArguments options) {
  choose_colours(options.colour);
  options.print.colour = stdout_has_colours();
  options.print.quiet = verbosity().quiet;
  options.print.verbose = verbosity().verbose;
  CompareChoice& choice = options.choice;
  for (const std::string& given : {options.a, options.b})
    if (!given.empty()) choice.given.push_back(given);
  choice.given.insert(choice.given.end(), options.further.begin(), options.further.end());
  if (choice.project.empty() && !options.sensitivity && choice.given.empty() &&
      choice.pairs.empty())
    choice.project = usual_project();
  options.job = make_job(choice, scene_parts);
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
  options.difference.check(!one, options.job.comparison.viewing.hdr_exposures.has_value());
  require_outputs(options, pairing);

  keep_large_pieces_in_files();
  SetReport report;
  {
    FilesTogether files;
    const std::size_t count = pairs_of(pairing).size();
    ProgressLine progress;
    ThreadLimit(choice.threads).run([&] {
      report = compare_and_show(options.job, options.difference, pairing, [&](std::size_t done) {
        if (!one)
          progress.show(double(done) / double(count), fmt::format("{} of {} pairs", done, count));
      });
    });
    progress.clear();
    write_reports(options, report, one, files);
  }
  const bool unreadable = one && !report.pairs.front().comparison;
  if (!options.html.path.empty() && !unreadable)
    ThreadLimit(choice.threads).run([&] {
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
      "well; what one side alone has there fails, unless it is 0. Alpha is judged; one that a side alone\n"
      "has fails, unless it is 1.\n"
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
      "Of two folders, a name that only B has fails; one that only A has is named, or fails with\n"
      "--missing-reference fail. A link to a folder is\n"
      "followed if it stays inside A or B; else it is named and fails. A file that nearly is a frame of a\n"
      "sequence, as f.01.exr is of f.%d.exr, is named and fails too. Exit codes: 0 pass or same, 1 over a\n"
      "limit, not measured, not finite, missing, misnamed or not followed, 2 usage, 3 a picture is\n"
      "unreadable, has no such layer or another size, or there is no pair, 4 an output cannot be written,\n"
      "6 undecided, 130 Ctrl-C, 143 SIGTERM.",
      join(limit_names(false)), 100 * kHighlightShare, limits_text(default_limits()),
      limits_text(highlight_limits()));
}

}  // namespace

void add_compare(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand("compare", "Compare two pictures: metrics and a verdict");
  auto options = std::make_shared<CompareArguments>();
  CompareChoice& choice = options->choice;
  command->add_option("A", options->a,
                      "Picture to judge, a folder of them, or a sequence such as a.%04d.exr");
  command->add_option(
      "B", options->b,
      "Reference picture, of the same size, or a folder or sequence of references: pictures are "
      "paired by their name within the folders, or by their number");
  command->add_option("MORE", options->further, "Further pictures, each judged against B as A is");
  const auto add_table = [&](std::string_view heading) {
    add_compare_options(*command, choice, heading);
  };
  OptionGroup general(*command), verdict(*command, "Verdict"), output(*command, "Output");
  add_table("Pairs");
  add_table("Options");
  general.add_flag(
      "--accept", options->accept,
      "Afterwards, show which references would change, ask, and copy A over those that "
      "it differs from; only at a terminal, never in CI. lobelia accept --undo puts them back");
  add_reading_options(*command);
  add_table("Layers");
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

  add_table("Verdict");
  verdict.add_flag(
      "--sensitivity", options->sensitivity,
      "Of A alone: what would these limits let pass? Compares changed copies of it, and "
      "ends with 1 if one that matters is not found");
  add_table("Parts of the pictures");
  add_table("Noise of Monte-Carlo pictures");
  add_table("Viewing");

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
  options->difference.add_to(*command);
  add_table("Output");
  options->limits.add_time_limit_to(output);
  command->footer(footer());
  command->callback(
      [options, &exit_code] { options->limits.run([&] { exit_code = run_compare(*options); }); });
}

}  // namespace lobelia::cli

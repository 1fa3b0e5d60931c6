// lobelia verify paper | stability | references | verdicts | profiles | highlights
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "compare/uncertainty/error_bars.hpp"
#include "farm/profile_scene.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"
#include "studies/agreement/agreement.hpp"
#include "studies/highlights/table.hpp"
#include "studies/paper/report.hpp"
#include "studies/profiles/made_pictures.hpp"
#include "studies/profiles/profiles.hpp"
#include "studies/stability/report.hpp"
#include "studies/verdicts/verdicts.hpp"

namespace lobelia::cli {
namespace {

struct VerifyPaperArguments {
  std::string json, plots;
  bool errata = false;
  WorkLimits limits;
};

void run_verify_paper(const VerifyPaperArguments& options) {
  OutputFiles().writes_report(options.json);
  if (!options.plots.empty()) make_directories(options.plots);
  const auto claims = paper::measure_all();
  std::vector<paper::Plot> plots;
  FilesTogether files;
  if (!options.plots.empty()) {
    plots = paper::plots();
    paper::write_plots(options.plots, plots);
  }
  write_reports(options.errata ? paper::errata_document(claims) : paper::table_text(claims),
                {{options.json,
                  record_text(paper::paper_record(claims, command_line(), figure_records(plots)))}},
                files);
}

void add_verify_paper(CLI::App& verify) {
  auto* command = verify.add_subcommand(
      "paper", "Recompute every figure and claim of the paper, and say what is true");
  auto options = std::make_shared<VerifyPaperArguments>();
  OptionGroup group(*command);
  add_json(group, options->json, "verify-paper");
  group.add("--plots", options->plots, "DIR",
            "Write the curves as SVG files into DIR, and into the record of --json");
  group.add_flag("--errata", options->errata, "Print docs/errata.md instead of the table");
  options->limits.add_to(group);
  command->footer(
      "A claim is confirmed or not reproduced; 'found' is what the paper does not speak of.\n"
      "docs/errata.md has the definitions and the reasons.\n"
      "\n"
      "Exit codes: 0 measured, however much the paper gets wrong; 2 usage, 4 an output cannot\n"
      "be written.");
  command->callback([options] { options->limits.run([&] { run_verify_paper(*options); }); });
}

struct VerifyStabilityArguments {
  std::string json, pictures, lobe;
  bool all = false;
  WorkLimits limits;
};

ExitCode run_verify_stability(const VerifyStabilityArguments& options) {
  std::vector<LobeId> lobes = stability::lobes_under_test();
  if (!options.lobe.empty())
    lobes = {chosen(options.lobe, "--lobe", lobe_names(), allowed_lobes(), find_lobe)};
  OutputFiles().writes_report(options.json);
  if (!options.pictures.empty()) {
    make_directories(options.pictures);
    require_writable(std::filesystem::path(options.pictures) / "stability.png");
  }
  records::VerifyStability report;
  report.command = command_line();
  ProgressLine progress;
  report.rows = stability::all_rows(lobes, [&](double done) { progress.show(done, "hard cases"); });
  progress.clear();
  stability::summarise(report);
  if (!options.json.empty()) report.curves = stability::error_curves();
  FilesTogether files;
  if (!options.pictures.empty()) {
    const auto from = std::filesystem::absolute(options.json).parent_path();
    report.pictures = stability::write_pictures(
        options.pictures, std::filesystem::absolute(options.pictures).lexically_relative(from));
  }
  const std::string text = stability::report_text(report, options.all);
  if (!options.all) stability::keep_rows_outside(report);
  write_reports(text, {{options.json, record_text(report)}}, files);
  return report.outside == 0 ? ExitCode::kSuccess : ExitCode::kDiffers;
}

void add_verify_stability(CLI::App& verify, ExitCode& exit_code) {
  auto* command = verify.add_subcommand(
      "stability", "Hold float32 and geometry to a reference of 50 digits, in the hard cases");
  auto options = std::make_shared<VerifyStabilityArguments>();
  OptionGroup group(*command);
  add_json(group, options->json, "verify-stability");
  group.add("--pictures", options->pictures, "DIR",
            "Write a highlight by the textbook's float32 and by ours into DIR");
  group.add("--lobe", options->lobe, "LOBE", "This lobe alone, listed or not");
  group.add_flag("--all", options->all, "Print and record every case, not the worst alone");
  options->limits.add_to(group);
  command->footer(
      "naive is the textbook formula in float32 without care; in the group float16 naive and ours are\n"
      "in emulated half floats, n = 8 to 1024. 'of peak' is the error relative to the highlight's\n"
      "middle, 'ulp' that in units in the last place that float32 has at the true value, 'pixels' are\n"
      "those that show the wrong sphere, none, or no number.\n"
      "docs/numerics.md has the bounds and why they hold.\n"
      "\n"
      "Where no bound below the whole peak is stated, a case is counted as not compared.\n"
      "\n"
      "Exit codes: 0 no case is outside its stated bound, 1 some are; 2 usage, 4 an output\n"
      "cannot be written.");
  command->callback([options, &exit_code] {
    options->limits.run([&] { exit_code = run_verify_stability(*options); });
  });
}

struct VerifyReferencesArguments {
  std::string output, json;
  std::vector<std::string> engines;
  int size = 0;
  bool small = false, markdown = false, require_engines = false;
  WorkLimits limits;
  EnginePrograms programs;
};

/// The engines named by --engine, which have to be available; without it all.
std::vector<std::unique_ptr<Engine>> engines_of(const VerifyReferencesArguments& options) {
  std::vector<std::string_view> names;
  for (const EngineInfo& engine : engine_infos())
    if (engine.is_program) names.push_back(engine.name);
  std::vector<bool> wanted(names.size(), options.engines.empty());
  for (const std::string& typed : options.engines)
    wanted[chosen_place(typed, "--engine", names)] = true;
  std::vector<std::unique_ptr<Engine>> engines;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!wanted[i]) continue;
    const auto& engine = engines.emplace_back(make_engine(names[i], options.programs.of(names[i])));
    if (!options.engines.empty() || options.require_engines ||
        engine->status().state == EngineState::kBroken)
      require_available(engine->info(), engine->status());
  }
  return engines;
}

/// The command that gives the same table, without where its files go.
std::string command_for(const VerifyReferencesArguments& options) {
  std::string command = "lobelia verify references";
  if (options.small) command += " --small";
  if (options.size > 0) command += fmt::format(" --size {}", options.size);
  for (const std::string& engine : options.engines) command += " --engine " + engine;
  return command;
}

ExitCode run_verify_references(const VerifyReferencesArguments& options) {
  agreement::Scope scope{options.small,
                         options.small ? agreement::kSmallSize : agreement::kFullSize};
  if (options.size > 0) scope.size = options.size;
  OutputFiles().writes_report(options.json);
  const auto engines = engines_of(options);
  const std::filesystem::path directory = options.output;
  if (!options.output.empty()) {
    make_directories(directory);
    require_writable(directory / "agreement.json");
  }
  ProgressLine progress;
  const auto result = agreement::measure(
      scope, engines, [&](double done, std::string_view what) { progress.show(done, what); });
  progress.clear();
  const records::Agreement record = agreement::report_record(result, command_line());
  const std::string page = agreement::report_markdown(result, command_for(options));
  FilesTogether files;
  if (!options.output.empty()) {
    write_record(directory / "agreement.json", record);
    write_file(directory / "agreement.csv", agreement::report_csv(result));
    write_file(directory / "agreement.md", page);
  }
  write_reports(options.markdown ? page : agreement::report_text(result),
                {{options.json, record_text(record)}}, files);
  if (result.count(agreement::Verdict::kFailed) > 0) return ExitCode::kEngine;
  return result.count(agreement::Verdict::kMissed) > 0 ? ExitCode::kDiffers : ExitCode::kSuccess;
}

void add_verify_references(CLI::App& verify, ExitCode& exit_code) {
  auto* command = verify.add_subcommand(
      "references", "Hold ours and every engine to the formulas, and engines to one another");
  auto options = std::make_shared<VerifyReferencesArguments>();
  OptionGroup group(*command);
  add_common(group, "--output", options->output,
             ": agreement.json (kind agreement), agreement.csv and agreement.md", "DIR");
  group.add_flag("--small", options->small, "A part of it that takes less than a minute");
  group.add("--size", options->size, "", "Width of pictures; usually 96, with --small 64")
      ->check(between(agreement::kSmallestSize, agreement::kLargestSize));
  group.add("--engine", options->engines, "NAME",
            "These engines alone, which have to be there; otherwise all that are");
  options->programs.add_to(*command);
  group.add_flag("--require-engines", options->require_engines,
                 "An engine that is not installed is an error");
  auto* json = add_json(group, options->json, "agreement");
  group.add_flag("--markdown", options->markdown, "Print docs/agreement.md instead of the table")
      ->excludes(json);
  options->limits.add_to(group);
  command->footer(
      "Differences are from pictures evaluated from the formulas in double or 50 digits. Those of\n"
      "the value are what number formats leave, those of the peak what arithmetic leaves; pixels\n"
      "on edges are counted apart. docs/agreement.md has the outcome and says what columns mean.\n"
      "\n"
      "Exit codes: 0 every target is met, 1 some are missed; 2 usage, 4 an output cannot be\n"
      "written, 5 an engine that was named or required is absent, one is broken, or one failed.");
  command->callback([options, &exit_code] {
    options->limits.run([&] { exit_code = run_verify_references(*options); });
  });
}

struct VerifyVerdictsArguments {
  std::string json, plots, pictures;
  std::vector<std::string> noises;
  bool markdown = false;
  verdicts::Options measured;
  WorkLimits limits;
  EnginePrograms programs;
};

ExitCode run_verify_verdicts(VerifyVerdictsArguments options) {
  for (const std::string& typed : options.noises)
    options.measured.noises.push_back(
        verdicts::Noise(chosen_place(typed, "--noise", verdicts::kNoiseNames)));
  options.measured.pictures = options.pictures;
  options.measured.programs = options.programs.given();
  OutputFiles().writes_report(options.json);
  if (!options.plots.empty()) make_directories(options.plots);
  ProgressLine progress;
  records::VerifyVerdicts record = verdicts::measure(
      options.measured, [&](double done) { progress.show(done, "pairs with noise"); });
  progress.clear();
  record.command = command_line();
  if (!options.plots.empty()) verdicts::write_charts(options.plots, record);
  write_reports(
      options.markdown ? verdicts::report_markdown(record) : verdicts::report_text(record),
      {{options.json, record_text(record)}});
  return record.outside == 0 ? ExitCode::kSuccess : ExitCode::kDiffers;
}

void add_verify_verdicts(CLI::App& verify, ExitCode& exit_code) {
  auto* command = verify.add_subcommand(
      "verdicts", "Count how often pictures with noise are called different, rightly and wrongly");
  auto options = std::make_shared<VerifyVerdictsArguments>();
  OptionGroup group(*command);
  auto* json = add_json(group, options->json, "verify-verdicts");
  group.add("--plots", options->plots, "DIR", "Write the curves as SVG files into DIR");
  group.add(
      "--pictures", options->pictures, "DIR",
      "Write the pairs into folders in DIR, for another judge: NOISE-SIZE-SAMPLES-PICTURES/b1, "
      "b2, ... and CHANGE/a1, a2, ...");
  group.add_number("--seeds", options->measured.seeds, 1, 100000, "Pairs of each kind of noise");
  group.add_number("--changed", options->measured.changed, 0, 100000,
                   "Judge only so many of them with each change, too; 0: all");
  group.add(
      "--noise", options->noises, "NAME",
      fmt::format("This kind of noise alone: {}; may be given again", join(verdicts::kNoiseNames)));
  group.add_number("--significance", options->measured.significance, 1e-6, 0.5,
                   "The chance of a false difference that is asked for");
  group
      .add("--bootstrap", options->measured.bootstraps, "NUMBER",
           "As that of compare; default: its own")
      ->check(between(kFewestBootstraps, kMostBootstraps));
  group.add_flag("--small", options->measured.small,
                 "Two kinds of pairs for each kind of noise, without Cycles");
  group.add_flag("--markdown", options->markdown, "Print the table of docs/verdicts.md instead")
      ->excludes(json);
  options->programs.add_to(*command);
  options->limits.add_to(group);
  command->footer(
      "Each pair is judged as compare does by default: with both expectations equal, where different\n"
      "is a false alarm, and with one picture dimmer, moved or wider. docs/verdicts.md has the outcome.\n"
      "A kind is outside if it has more false alarms than a chance of one and a half times the\n"
      "significance has but once in a thousand such tests.\n"
      "\n"
      "Exit codes: 0 no kind is outside, 1 some are; 2 usage, 4 an output cannot be written,\n"
      "5 a picture of Cycles failed.");
  command->callback([options, &exit_code] {
    options->limits.run([&] { exit_code = run_verify_verdicts(*options); });
  });
}

void add_verify_highlights(CLI::App& verify, ExitCode& exit_code) {
  auto* command = verify.add_subcommand(
      "highlights",
      "Try whether the default limits find a changed highlight beside a bright light");
  struct Arguments {
    std::string json;
    WorkLimits limits;
  };
  auto options = std::make_shared<Arguments>();
  OptionGroup group(*command);
  add_json(group, options->json, "verify-highlights");
  options->limits.add_to(group);
  command->footer(
      "The light has 5 to 50 000 times the highlight's peak. The highlight alone is dimmer, moved,\n"
      "gone, or only in the judged picture; rounding to half floats must pass. docs/limits.md says how\n"
      "each highlight is judged.\n"
      "\n"
      "Exit codes: 0 every change is found, 1 some are missed or rounding is a difference; 2 usage,\n"
      "4 an output cannot be written.");
  command->callback([options, &exit_code] {
    options->limits.run([&] {
      OutputFiles().writes_report(options->json);
      ProgressLine progress;
      records::VerifyHighlights record = highlights::measure_table(
          [&](double done) { progress.show(done, "highlights beside a light"); });
      progress.clear();
      record.command = command_line();
      write_reports(highlights::table_text(record), {{options->json, record_text(record)}});
      exit_code = record.wrong == 0 ? ExitCode::kSuccess : ExitCode::kDiffers;
    });
  });
}

struct VerifyProfilesArguments {
  profile_study::Options study;
  std::string json;
  bool markdown = false;
  WorkLimits limits;
};

ExitCode run_verify_profiles(const VerifyProfilesArguments& options) {
  const std::string& only = options.study.only;
  std::vector<std::string_view> names;
  for (const profile_study::Kind& kind : profile_study::kinds()) names.push_back(kind.name);
  if (!only.empty()) chosen_place(only, "--kind", names);
  OutputFiles().writes_report(options.json);
  ProgressLine progress;
  const auto rows = profile_study::measure(
      options.study,
      [](const Scene& scene, const NamedImages& images) {
        return profile_scene(scene, 0, 0, images, true);
      },
      [&](double done) { progress.show(done, "made pictures"); });
  progress.clear();
  records::VerifyProfiles record = profile_study::report_record(rows, options.study.seed);
  record.command = command_line();
  write_reports(profile_study::report_text(rows, options.markdown),
                {{options.json, record_text(record)}});
  return profile_study::meets_goal(rows) ? ExitCode::kSuccess : ExitCode::kDiffers;
}

void add_verify_profiles(CLI::App& verify, ExitCode& exit_code) {
  auto* command = verify.add_subcommand(
      "profiles", "Hold the standard errors of profiles to highlights of known figures");
  auto options = std::make_shared<VerifyProfilesArguments>();
  OptionGroup group(*command);
  group.add_number("--pictures", options->study.pictures, 1, 10000, "Pictures of each kind");
  add_common(group, "--seed", options->study.seed, " of the pictures");
  group.add("--kind", options->study.only, "KIND", "This row of the table alone, by its name");
  auto* json = add_json(group, options->json, "verify-profiles");
  group.add_flag("--markdown", options->markdown, "Print the table of docs/profiles.md")
      ->excludes(json);
  options->limits.add_to(group);
  command->footer(
      "Pictures are made from formulas. Some are of spheres with Phong, Blinn-Phong and GGX highlights,\n"
      "whose exponent or alpha is told with the scene. Others are of highlights on a background, and have\n"
      "no scene.\n"
      "They have noise, few bits, a clipped peak, a pixel filter or a slope beneath. 95 % of the figures\n"
      "of each kind are to lie within two of their standard errors of the truth.\n"
      "docs/profiles.md has the outcome.\n"
      "\n"
      "Exit codes: 0 every kind meets the goal, 1 some do not; 2 usage, 4 an output cannot be\n"
      "written.");
  command->callback([options, &exit_code] {
    options->limits.run([&] { exit_code = run_verify_profiles(*options); });
  });
}

}  // namespace

void add_verify(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand(
      "verify", "Check the paper, float32, engines and error bars by measurement");
  command->require_subcommand(1);
  command->footer(
      "Begin with:\n  lobelia verify paper\n  lobelia verify stability\n"
      "  lobelia verify references --small\n  lobelia verify verdicts --small\n"
      "  lobelia verify profiles --pictures 6\n"
      "  lobelia verify highlights");
  add_verify_paper(*command);
  add_verify_stability(*command, exit_code);
  add_verify_references(*command, exit_code);
  add_verify_verdicts(*command, exit_code);
  add_verify_profiles(*command, exit_code);
  add_verify_highlights(*command, exit_code);
}

}  // namespace lobelia::cli

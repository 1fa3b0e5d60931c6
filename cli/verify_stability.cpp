#include "cli/verify_stability.hpp"

#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/progress.hpp"
#include "core/files.hpp"
#include "records/record.hpp"
#include "studies/stability/report.hpp"

namespace lobelia::cli {
namespace {

struct VerifyStabilityArguments {
  std::string json, pictures, lobe;
  bool all = false, no_timing = false, quiet = false;
};

ExitCode run_verify_stability(const VerifyStabilityArguments& options) {
  std::vector<LobeId> lobes = stability::lobes_under_test();
  if (!options.lobe.empty())
    lobes = {chosen(options.lobe, "--lobe", lobe_names(), allowed_lobes(), find_lobe)};
  if (!options.json.empty()) require_writable(options.json);
  if (!options.pictures.empty()) {
    make_directories(options.pictures);
    require_writable(std::filesystem::path(options.pictures) / "stability.png");
  }
  records::VerifyStability report;
  report.command = command_line();
  ProgressLine progress(!options.quiet);
  report.rows = stability::all_rows(lobes, [&](double done) { progress.show(done, "hard cases"); });
  progress.clear();
  stability::summarise(report);
  if (!options.json.empty()) report.curves = stability::error_curves();
  // One thread, after everything else: nothing of ours disturbs it.
  if (!options.no_timing) {
    report.stalls = stability::measure_stalls(lobes);
    report.price = stability::measure_prices(lobes);
  }
  FilesTogether files;
  if (!options.pictures.empty()) {
    const auto from = std::filesystem::absolute(options.json).parent_path();
    report.pictures = stability::write_pictures(
        options.pictures, std::filesystem::absolute(options.pictures).lexically_relative(from));
  }
  const std::string text = stability::report_text(report, options.all);
  if (!options.all) stability::keep_rows_outside(report);
  if (!options.json.empty()) write_record(options.json, report);
  files.commit();
  fmt::print("{}", text);
  return report.outside == 0 ? ExitCode::kSuccess : ExitCode::kDiffers;
}

}  // namespace

void add_verify_stability(CLI::App& verify, ExitCode& exit_code) {
  auto* command = verify.add_subcommand(
      "stability", "Hold float32 and geometry to a reference of 50 digits, in the hard cases");
  auto options = std::make_shared<VerifyStabilityArguments>();
  command->add_option("--json", options->json, "Write the record (kind verify-stability) to FILE")
      ->type_name("FILE");
  command
      ->add_option("--pictures", options->pictures,
                   "Write a highlight by the textbook's float32 and by ours into DIR")
      ->type_name("DIR");
  command->add_option("--lobe", options->lobe, "This lobe alone, listed or not")->type_name("LOBE");
  command->add_flag("--all", options->all, "Print and record every case, not the worst alone");
  command->add_flag("--no-timing", options->no_timing,
                    "Do not measure what denormal results and precision cost");
  command->add_flag("-q,--quiet", options->quiet, "No progress line");
  command->footer(
      "naive is the textbook formula in float32 without care. 'of peak' is the error relative to\n"
      "the highlight's middle, 'ulp' that in units in the last place that float32 has at the true\n"
      "value, 'pixels' are those that show the wrong sphere, none, or no number.\n"
      "docs/numerics.md has the bounds and why they hold.\n"
      "\n"
      "Where no bound below the whole peak is stated, a case is counted as not compared.\n"
      "\n"
      "Exit codes: 0 no case is outside its stated bound, 1 some are; 2 usage, 4 an output\n"
      "cannot be written.");
  command->callback([options, &exit_code] { exit_code = run_verify_stability(*options); });
}

}  // namespace lobelia::cli

#include "cli/verify_paper.hpp"

#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "core/files.hpp"
#include "records/record.hpp"
#include "studies/paper/report.hpp"

namespace lobelia::cli {
namespace {

struct PaperOptions {
  std::string json, plots;
  bool errata = false;
};

void run_paper(const PaperOptions& options) {
  if (!options.json.empty()) require_writable(options.json);
  if (!options.plots.empty()) make_directories(options.plots);
  const auto claims = paper::measure_all();
  std::vector<paper::Plot> plots;
  FilesTogether files;
  if (!options.plots.empty()) {
    plots = paper::plots();
    paper::write_plots(options.plots, plots);
  }
  if (!options.json.empty())
    write_record(options.json, paper::paper_record(claims, command_line(), figure_records(plots)));
  files.commit();
  fmt::print("{}", options.errata ? paper::errata_document(claims) : paper::table_text(claims));
}

}  // namespace

void add_verify_paper(CLI::App& verify) {
  auto* command = verify.add_subcommand(
      "paper", "Recompute every figure and claim of the paper, and say what is true");
  auto options = std::make_shared<PaperOptions>();
  command->add_option("--json", options->json, "Write the record (kind verify-paper) to FILE")
      ->type_name("FILE");
  command
      ->add_option("--plots", options->plots,
                   "Write the curves as SVG files into DIR, and into the record of --json")
      ->type_name("DIR");
  command->add_flag("--errata", options->errata, "Print docs/errata.md instead of the table");
  command->footer(
      "A claim is confirmed or not reproduced; 'found' is what the paper does not speak of.\n"
      "docs/errata.md has the definitions and the reasons.\n"
      "\n"
      "Exit codes: 0 measured, however much the paper gets wrong; 2 usage, 4 an output cannot\n"
      "be written.");
  command->callback([options] { run_paper(*options); });
}

}  // namespace lobelia::cli

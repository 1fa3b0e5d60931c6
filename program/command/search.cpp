// lobelia search: the cheapest lobe within an error.
#include "studies/search/search.hpp"
#include "base/records/record.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"

namespace lobelia::cli {
namespace {

struct SearchArguments {
  std::string metric = "max", exponents = "16..inf", precision = "float32", coefficients = "by-n",
              family = "all";
  std::string json;
  std::optional<double> error;
  std::optional<int> price;
  bool certificates = false;
  WorkLimits limits;
};

void run_search(const SearchArguments& options, ExitCode& exit_code) {
  search::Request request;
  request.range = search::parse_range(options.exponents);
  request.metric = options.metric;
  request.rounding = search::parse_rounding(options.precision);
  request.family = options.family;
  request.by_n = options.coefficients == "by-n";
  request.error = options.error;
  request.price = options.price;
  OutputFiles outputs;
  outputs.writes_report(options.json);
  ProgressLine line;
  request.on_progress = [&](double part, const std::string& what) { line.show(part, what); };
  records::LobeSearch found = search::search(request);
  line.clear();
  found.command = command_line();
  write_reports(search::search_text(found, request, options.certificates),
                {{options.json, record_text(found)}});
  if (!search::is_met(found, request)) exit_code = ExitCode::kDiffers;
}

}  // namespace

void add_search(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand(
      "search", "Find the cheapest lobe within an error of cos^n, and prove that it is");
  auto options = std::make_shared<SearchArguments>();
  OptionGroup asked(*command, "What is asked for");
  asked
      .add("--error", options->error, "",
           "The cheapest lobe within this error, of the peak (--metric)")
      ->check(between(1e-300, 1));
  asked.add("--operations", options->price, "", "The nearest lobe of at most so many operations")
      ->check(between(1, search::kMostPrice));
  const auto texts = [](const auto& names) {
    return std::vector<std::string>(std::begin(names), std::end(names));
  };
  asked.add_choice("--metric", options->metric, texts(records::kSearchMetrics),
                   "Which error chooses");
  OptionGroup lobes(*command, "Lobes");
  lobes.add_choice("--family", options->family, texts(records::kSearchFamilies), "Which lobes");
  lobes
      .add("--exponents", options->exponents, "A..B", "Exponents for which it holds; B may be inf")
      ->capture_default_str();
  lobes
      .add("--precision", options->precision, "",
           "float32, float16 or fixed:BITS (BITS behind the point)")
      ->capture_default_str();
  lobes.add_choice("--coefficients", options->coefficients, {"by-n", "constant"},
                   "May they depend on n");
  OptionGroup output(*command, "Output");
  add_json(output, options->json, "lobe-search");
  output.add_flag("--certificates", options->certificates,
                  "Print the points that prove the lower bounds of the front");
  options->limits.add_to(output);
  command->footer(
      "pkD.M is a clamped polynomial of degree D and M squarings, rkD.M a reciprocal, bkD.M the bits of\n"
      "a polynomial read as a number. 'free' has pfD.M, rfD.M and bfD.M, whose peak is not 1: nearer at\n"
      "the same price, but no lobes for a scene file. Coefficients are best for the largest error; the other metrics\n"
      "choose among those lobes. docs/cheapest_lobe.md has the method and the proofs.\n"
      "\n"
      "Examples:\n"
      "  lobelia search --error 1e-3\n"
      "  lobelia search --operations 6 --exponents 16..1024 --certificates\n"
      "\n"
      "Exit codes: 0 done, 1 no lobe meets what is asked for, 2 usage, 4 an output cannot be written.");
  command->callback(
      [options, &exit_code] { options->limits.run([&] { run_search(*options, exit_code); }); });
}

}  // namespace lobelia::cli

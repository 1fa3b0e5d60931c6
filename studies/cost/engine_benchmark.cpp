// Whole programs on the same picture: ours, POV-Ray, Cycles and the formulas in double, against the formulas in
// 50 digits.
#include "studies/cost/benchmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "compare/set/job.hpp"
#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/error_time_chart.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/image_values.hpp"
#include "core/process.hpp"
#include "core/text.hpp"
#include "records/record.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/cost/scenes.hpp"

namespace lobelia::cost {
namespace {

constexpr std::array kStages = {"start", "parse", "trace", "write"};

/// One picture and its times; only the stages that the program reports.
struct Made {
  Image image;
  double seconds = 0;
  records::Named<double> stages = {};
};

struct Contender {
  std::string name;
  std::vector<std::pair<std::string, std::string>> settings;
  std::function<Made()> make;
  Made last = {};
  std::vector<double> seconds = {};
  std::map<std::string, std::vector<double>> stages = {};
};

/// Runs a command of ours as a process that writes KIND.exr and KIND.json into `directory`.
Made run_lobelia(const std::filesystem::path& program, std::vector<std::string> arguments,
                 const std::string& kind, const std::filesystem::path& directory) {
  const auto picture = directory / (kind + ".exr");
  arguments.insert(arguments.begin(), program.string());
  arguments.insert(arguments.end(), {"-q", "-o", picture.string()});
  const ProcessResult ended = run_process(arguments, {});
  if (ended.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  if (ended.exit_code != 0)
    throw Error(ExitCode::kEngine, fmt::format("lobelia {} failed: {}", arguments[1],
                                               printable(ended.output_tail, 300)));
  return {read_image(picture), ended.seconds};
}

Made make_ours(const std::filesystem::path& program, const std::filesystem::path& directory) {
  Made made =
      run_lobelia(program, {"render", (directory / "scene.xml").string()}, "render", directory);
  const auto took = records::read_record<records::Render>(directory / "render.json").seconds;
  const double read = *took.read, write = *took.pack + *took.write;
  const double trace = took.total - *took.pack;
  made.stages = {{"start", made.seconds - read - trace - write},
                 {"parse", read},
                 {"trace", trace},
                 {"write", write}};
  return made;
}

/// By an engine that is part of our program.
Made make_built_in(const std::filesystem::path& program, std::string_view engine,
                   const std::filesystem::path& directory) {
  Made made = run_lobelia(
      program, {"reference", (directory / "scene.xml").string(), "--engine", std::string(engine)},
      "reference", directory);
  const auto record = records::read_record<records::Reference>(directory / "reference.json");
  made.stages = {{"trace", record.seconds.total}};
  return made;
}

/// By an engine's program, from the call to the picture in memory.
Made make_theirs(Engine& engine, const Scene& scene, const ReferenceOptions& options) {
  ReferenceResult result;
  const double seconds = seconds_of([&] { result = Session(engine, options).render(scene); });
  if (!result.error.empty()) throw Error(ExitCode::kEngine, result.error);
  Made made{std::move(result.image), seconds};
  const records::EngineSeconds& took = result.record.seconds;
  for (const auto& [stage, of_stage] : {std::pair("start", took.start),
                                        {"parse", took.parse},
                                        {"trace", took.trace},
                                        {"write", took.write}})
    if (of_stage) made.stages.emplace_back(stage, *of_stage);
  return made;
}

/// The formulas in 50 digits: the built-in engine, in its finer format.
Made make_truth(const Scene& scene) {
  const auto infos = engine_infos();
  const auto formulas = std::ranges::find(infos, false, &EngineInfo::is_program);
  ReferenceOptions how;
  how.fine = true;
  return make_theirs(*make_engine(formulas->name, {}), scene, how);
}

/// With the truth at edges, where two correct programs may differ by a whole pixel.
Image without_edges(Image image, const Image& truth, const PixelFlags& edges) {
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges[i])
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) image.values()[c] = truth.values()[c];
  return image;
}

/// All programs that can render the scene, which must outlive them; `table` gets the reasons why others cannot.
std::vector<Contender> contenders(const Scene& scene, const std::filesystem::path& directory,
                                  const Options& options, Table& table) {
  std::vector<Contender> all;
  const auto ours = options.program("lobelia");
  all.push_back({"ours", {{"engine", "lobelia"}, {"precision", "sufficient"}}, [ours, directory] {
                   return make_ours(ours, directory);
                 }});
  for (const EngineInfo& info : engine_infos()) {
    // The formulas in their finer digits are the truth itself.
    const bool fine_too = !info.fine.empty() && info.is_program;
    const std::shared_ptr<Engine> engine = make_engine(info.name, options.program(info.name));
    ReferenceOptions how;
    how.stages = true;
    const EngineStatus& status = engine->status();
    if (const std::string why = status.available() ? engine->why_not(scene, how) : status.why;
        !why.empty()) {
      table.remarks.push_back(fmt::format("without {}: {}", info.title, why));
      continue;
    }
    for (const bool fine : {false, true}) {
      if (fine && !fine_too) continue;
      how.fine = fine;
      const std::string_view format = fine ? info.fine : info.plain;
      all.push_back(
          {info.fine.empty() ? std::string(info.title) : fmt::format("{}, {}", info.title, format),
           {{"engine", std::string(info.name)}, {"precision", std::string(format)}},
           [engine, &scene, how, ours, directory] {
             const EngineInfo& made_by = engine->info();
             return made_by.is_program ? make_theirs(*engine, scene, how)
                                       : make_built_in(ours, made_by.name, directory);
           }});
    }
  }
  return all;
}

Variant measured_contender(Contender& one, const Image& truth, const PixelFlags& edges,
                           const ComparisonOptions& seen) {
  const Comparison comparison = compare(without_edges(one.last.image, truth, edges), truth, seen);
  Variant variant;
  variant.name = one.name;
  variant.settings = one.settings;
  variant.seconds = records::rounds_record(summary(one.seconds));
  variant.errors = {{"max_rel_peak", comparison.value("max_rel_peak")},
                    {"de2000_p99", comparison.value("ciede2000.p99")}};
  records::Named<double> stages;
  for (const auto& [stage, seconds] : one.stages)
    stages.emplace_back(stage, summary(seconds).median);
  if (!stages.empty()) variant.facts.emplace().stage_seconds = std::move(stages);
  return variant;
}

/// "start 12.0 ms, parse 0.10 ms, ..."
std::string stages_text(const Variant& variant) {
  std::string text;
  double told = 0;
  const auto stages = variant.facts ? variant.facts->stage_seconds : std::nullopt;
  for (const char* stage : kStages)
    if (const double* seconds = stages ? records::find(*stages, stage) : nullptr) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", stage, short_time_text(*seconds));
      told += *seconds;
    }
  if (text.empty())
    return fmt::format("{}: {}, not told apart", variant.name,
                       short_time_text(variant.seconds->median));
  const double rest = variant.seconds->median - told;
  if (rest > 0.02 * variant.seconds->median)
    text += fmt::format(", all else {}", short_time_text(rest));
  return fmt::format("{}: {}", variant.name, text);
}

/// The most that our own picture may be off outside the edges.
constexpr double kMostError = 1e-4;

Table measure_scene(const NamedScene& named, const Options& options) {
  Scene scene = with_film(named.scene, options.rounds(48, 256, 1024));
  scene.sampler.sample_count = 1;
  Table table;
  table.id = "engine-" + named.name;
  table.level = "engine";
  table.title = fmt::format("Programs that render {}, {} x {}, one ray a pixel", named.name,
                            scene.film.width, scene.film.height);
  table.per = "picture";
  table.errors = {{"max_rel_peak", "largest error, relative to the brightest value"},
                  {"de2000_p99", "CIEDE2000 of 99 % of the pixels at most"}};
  if (const std::string why = truth::why_not_evaluated(scene); !why.empty()) {
    table.remarks.push_back("nothing was measured, for there is no truth to measure by: " + why);
    return table;
  }
  const TemporaryDirectory directory;
  write_file(directory.path() / "scene.xml", scene_to_xml(scene));
  std::vector<Contender> all = contenders(scene, directory.path(), options, table);

  options.progress(named.name + ": the formulas in 50 digits");
  const Made truth = make_truth(scene);
  const PixelFlags edges = truth::edge_ring(scene);
  const int rounds = options.rounds(1, 5, 11);
  for (int round = 0; round < rounds; ++round)
    for (Contender& one : all) {
      options.progress(
          fmt::format("{}: round {} of {}, {}", named.name, round + 1, rounds, one.name));
      one.last = one.make();
      one.seconds.push_back(one.last.seconds);
      for (const auto& [stage, seconds] : one.last.stages) one.stages[stage].push_back(seconds);
    }

  CompareChoice choice = plain_choice(exposure_for_peak(peak_value(truth.image)));
  choice.metrics = "max_rel_peak,ciede2000";
  const ComparisonOptions seen = judging_options(choice);
  for (Contender& one : all)
    table.variants.push_back(measured_contender(one, truth.image, edges, seen));
  if (!(table.variants[0].errors[0].second <= kMostError))
    throw Error(ExitCode::kInternal,
                fmt::format("engine: our picture of {} is off by {:.2g} of the peak", named.name,
                            table.variants[0].errors[0].second));
  for (const Variant& variant : table.variants) table.remarks.push_back(stages_text(variant));
  table.remarks.push_back(fmt::format(
      "times are of whole processes, all of an engine's passes included; errors are to the formulas in 50 "
      "digits, which took {}, rounded to float32 as all pictures are (6e-8 of a value), seen with the peak as white, without the {} pixels at edges where a rounding "
      "decides",
      short_time_text(truth.seconds), std::count(edges.begin(), edges.end(), 1)));
  return table;
}

}  // namespace

std::vector<Table> measure_engines(const Options& options) {
  std::vector<Table> tables;
  for (const NamedScene& named : options.scenes) tables.push_back(measure_scene(named, options));
  return tables;
}

}  // namespace lobelia::cost

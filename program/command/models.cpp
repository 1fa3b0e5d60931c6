#include <map>
#include <numbers>

#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"
#include "renderer/albedo.hpp"
#include "renderer/catalogue_record.hpp"
#include "renderer/export/export.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia::cli {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string range_of(const Parameter& p) {
  const std::string choices = string_choices(p);
  return choices.empty() ? fmt::format("{:g} to {:g}", p.min, p.max) : choices;
}

void print_catalogues(std::span<const LobeId> lobes) {
  fmt::print("{:<26}{:<28}{:<10}{:<6}{:<20}{}\n", "model", "title", "angle", "N.L", "normalised",
             "exact normalisation constant of any lobe, by its moments");
  for (const ModelId id : all_models()) {
    const ModelInfo& m = info(id);
    fmt::print("{:<26}{:<28}{:<10}{:<6}{:<20}{}\n", m.name, m.title, angle_name(m.angle),
               m.applies_cosine ? "yes" : "no", name(m.normalised), exact_formula(id));
  }
  fmt::print("\n{:<26}{:<44}{:<44}{}\n", "normalisation constant", "cosine, exact", "cosine, paper",
             "cs16, paper");
  for (const ModelId id : all_models()) {
    const ConstantFormulas f = formulas(id);
    fmt::print("{:<26}{:<44}{:<44}{}\n", info(id).name, f.exact_cosine, f.paper_cosine,
               f.paper_cs16);
  }
  fmt::print("\n{:<20}{:<50}{:<50}{}\n", "lobe", "value, s = 1 - cos",
             "moments M_j = integral of value s^j, 0 to S", "source");
  for (const LobeId& id : lobes)
    fmt::print("{:<20}{:<50}{:<50}{}\n", info(id).name, info(id).formula, info(id).moments,
               info(id).source);
  fmt::print("\n{:<20}meaning\n", "normalisation");
  for (const std::string_view how : normalisation_names())
    fmt::print("{:<20}{}\n", how, meaning(*find_normalisation(how)));
  fmt::print("\n{:<22}{:<10}{:<40}meaning\n", "parameter", "default", "allowed");
  for (const Parameter& p : kHighlightParameters)
    fmt::print("{:<22}{:<10}{:<40}{}\n", p.name,
               p.default_value.empty() ? "required" : p.default_value, range_of(p), p.meaning);
}

void print_operations(std::string_view name, const OperationCount& c) {
  fmt::print("{:<26}{:>13}{:>9}{:>5}{:>8}{:>6}{:>16}{:>9}{:>7}\n", name, c.multiply_add, c.multiply,
             c.add, c.divide, c.root, c.transcendental, c.compare, price(c));
}

void print_costs(std::span<const LobeId> lobes) {
  fmt::print("\n{:<26}{:>13}{:>9}{:>5}{:>8}{:>6}{:>16}{:>9}{:>7}\n", "operations a point",
             "multiply-add", "multiply", "add", "divide", "root", "transcendental", "compare",
             "price");
  for (const LobeId& id : lobes) print_operations(info(id).name, operations(id));
  for (const ModelId id : all_models()) print_operations(info(id).name, operations(id));
}

void print_measured(double exponent, std::span<const LobeId> lobes) {
  fmt::print("\nMeasured at n = {:g}\n\n{:<20}{:>12}{:>12}{:>15}{:>15}\n", exponent, "lobe",
             "half width", "0 beyond", "above cosine", "below cosine");
  for (const LobeId& id : lobes) {
    const LobeProperties p = measure(id, exponent);
    fmt::print("{:<20}{:>8.3f} deg{:>8.3f} deg{:>15.3g}{:>15.3g}\n", info(id).name,
               p.half_width / kDegree, p.support / kDegree, p.above_cosine, p.below_cosine);
  }
  fmt::print("\n{:<26}{:<20}{:<8}{:>12}{:>12}{:>9}{:>14}{:>17}{:>13}{:>13}\n", "model", "lobe",
             "norm.", "constant", "coefficient", "energy", "seen at most", "lit at most, at",
             "above 1 from", "reciprocity");
  for (const Highlight& h : all_highlights(exponent, lobes)) {
    const AlbedoPeak lit = largest_albedo_of_light(h);
    fmt::print(
        "{:<26}{:<20}{:<8}{:>12.6g}{:>12.6g}{:>9.5f}{:>14.5f}{:>9.5g}{:>6.2f} d{:>13}{:>13}\n",
        info(h.model).name, info(h.lobe).name, name(h.normalisation), normalisation_constant(h),
        radiance_coefficient(h), directional_albedo(h, 0), largest_albedo(h).albedo, lit.albedo,
        lit.incidence / kDegree,
        lit.above_one_from ? fmt::format("{:.2f} d", *lit.above_one_from / kDegree) : "-",
        reciprocity_gap(h) < 1e-9 ? "holds" : "fails");
  }
  fmt::print(
      "\nconstant: the normalisation constant, which makes the integral of the model 1. coefficient: the\n"
      "factor of the lobe in the radiance, for a shader; a quarter of the constant of a distribution D.\n"
      "energy: reflected at normal incidence; a microfacet distribution without masking loses some.\n"
      "seen: the albedo towards an eye under a uniform sky. lit: what leaves of a beam. Both the most\n"
      "over incidences up to 89.99 degrees; above 1 the model makes light. They are one where\n"
      "reciprocity holds.\n");
}

/// Tables with the text of every highlight. Texts share most of their paragraphs, so each stands there once.
records::HighlightTables tables_with_shaders(std::span<const double> exponents) {
  records::HighlightTables tables = highlight_tables(exponents);
  std::map<std::string, std::int64_t> known;
  const auto parts_of = [&](ModelId model, LobeId lobe, Normalisation normalisation) {
    std::vector<std::int64_t> parts;
    ShaderExport request;
    request.language = *find_shader_language("glsl");
    request.models = {model};
    request.lobe = lobe;
    request.normalisation = normalisation;
    request.coefficient = CoefficientFrom::kArgument;
    const std::string text = shader_text(request);
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end) {
      const std::size_t blank = std::min(text.find("\n\n", begin), text.find("\n//\n", begin));
      end = blank == text.npos ? text.size() : text.find('\n', blank + 1) + 1;
      const std::string part = text.substr(begin, end - begin);
      const auto [at, is_new] = known.try_emplace(part, std::int64_t(known.size()));
      if (is_new) tables.shader_parts.push_back(part);
      parts.push_back(at->second);
    }
    return parts;
  };
  for (records::HighlightTable& one : tables.highlights) {
    const ModelId model = *find_model(one.model);
    const LobeId lobe = *find_lobe(one.lobe);
    one.shader = parts_of(model, lobe, Normalisation::kExact);
    if (has_paper_coefficient(lobe))
      one.paper_shader = parts_of(model, lobe, Normalisation::kPaper);
  }
  return tables;
}

struct ModelsArguments {
  double exponent = 64;
  LobeOption lobe;
  std::string json, tables;
  WorkLimits limits;
};

void run_models(const ModelsArguments& options, bool has_exponent) {
  if (!options.tables.empty()) {
    require_writable(options.tables);
    write_record(options.tables, tables_with_shaders(has_exponent ? std::vector{options.exponent}
                                                                  : table_exponents()));
    return;
  }
  std::vector<LobeId> lobes(all_lobes().begin(), all_lobes().end());
  if (const auto one = options.lobe.lobe()) {
    require_lobe({{}, *one, {}, options.exponent});
    lobes = {*one};
  }
  OutputFiles().writes_report(options.json);
  std::string record;
  if (!options.json.empty()) record = record_text(catalogue_record(options.exponent, lobes));
  write_reports("", {{options.json, record}});
  if (options.json == kStdout) return;
  print_catalogues(lobes);
  print_costs(lobes);
  print_measured(options.exponent, lobes);
}

}  // namespace

void add_models(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "models", "List models, lobes and normalisations: formulas, costs and measurements");
  auto options = std::make_shared<ModelsArguments>();
  OptionGroup group(*command);
  auto* json = add_json(group, options->json, "models");
  auto* exponent = group.add_number("--exponent", options->exponent, kMinExponent, kMaxExponent,
                                    "Exponent n at which to measure");
  options->lobe.add_to(group);
  group
      .add(
          "--tables", options->tables, "FILE",
          "Write curves and albedos of every highlight over the exponent (kind highlight-tables) to "
          "FILE instead; with --exponent, which is at least 1 then, at that one alone")
      ->excludes(json);
  options->limits.add_to(group);
  command->callback([options, exponent] {
    if (!options->tables.empty() && options->exponent < 1)
      throw CLI::ValidationError("--exponent", "with --tables it is at least 1");
    options->limits.run([&] { run_models(*options, exponent->count() > 0); });
  });
}

}  // namespace lobelia::cli

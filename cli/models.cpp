#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "core/record.hpp"
#include "renderer/highlight.hpp"

namespace lobelia::cli {
namespace {

std::string_view angle_name(LobeAngle angle) {
  return angle == LobeAngle::kReflection ? "L and R" : "N and H";
}

Json catalogue_record() {
  Json record = make_record("models");
  for (const auto& m : models())
    record["models"].push_back({{"name", m.name},
                                {"title", m.title},
                                {"angle", angle_name(m.angle)},
                                {"appliesCosine", m.applies_cosine},
                                {"integral", m.integral},
                                {"source", m.source}});
  for (const LobeId id : all_lobes()) {
    const LobeInfo& l = info(id);
    record["lobes"].push_back(
        {{"name", l.name}, {"title", l.title}, {"formula", l.formula}, {"source", l.source}});
  }
  record["normalisations"] = normalisation_names();
  return record;
}

void run(bool json) {
  if (json) {
    fmt::print("{}", record_text(catalogue_record()));
    return;
  }
  fmt::print("{:<26}{:<28}{:<10}{:<6}coefficient makes this 1\n", "model", "title", "angle", "N.L");
  for (const auto& m : models())
    fmt::print("{:<26}{:<28}{:<10}{:<6}{}\n", m.name, m.title, angle_name(m.angle),
               m.applies_cosine ? "yes" : "no", m.integral);
  fmt::print("\n{:<26}{:<38}source\n", "lobe", "value, s = 1 - cos");
  for (const LobeId id : all_lobes())
    fmt::print("{:<26}{:<38}{}\n", info(id).name, info(id).formula, info(id).source);
  fmt::print(
      "\n{:<26}meaning\n{:<26}the closed form: energy 1 at normal incidence\n"
      "{:<26}the constant as the paper prints it, misprints included\n",
      "normalisation", "exact", "paper");
}

}  // namespace

void add_models(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand("models", "List the models, lobes and normalisations");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print the catalogue as JSON");
  command->callback([json] { run(*json); });
}

}  // namespace lobelia::cli

#include "base/records/catalogue.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "base/records/agreement.hpp"
#include "base/records/bench.hpp"
#include "base/records/bsdf_check.hpp"
#include "base/records/cluster.hpp"
#include "base/records/comparison.hpp"
#include "base/records/conversion.hpp"
#include "base/records/cost.hpp"
#include "base/records/farm.hpp"
#include "base/records/lobe_search.hpp"
#include "base/records/measured.hpp"
#include "base/records/models.hpp"
#include "base/records/pages.hpp"
#include "base/records/paper.hpp"
#include "base/records/profile.hpp"
#include "base/records/project.hpp"
#include "base/records/record.hpp"
#include "base/records/render.hpp"
#include "base/records/result.hpp"
#include "base/records/scene.hpp"
#include "base/records/shader_check.hpp"
#include "base/records/stability.hpp"
#include "base/records/verdicts.hpp"
#include "base/records/verify.hpp"
#include "base/words/text.hpp"

namespace lobelia::records {
namespace {

template <class... T>
constexpr std::array<Kind, sizeof...(T)> kinds_of() {
  return {Kind{struct_type<T>, [](std::string_view text, const std::string& where) {
                 return record_text(parse_record<T>(text, where));
               }}...};
}

constexpr auto kKinds =
    kinds_of<Agreement, Bench, Blob, Blobs, BsdfCheck, Cell, Comparison, ComparisonSet, Content,
             Conversion, ConversionTable, ConvertedMaterials, Cost, Engines, Failure, Farm,
             FarmChunk, FarmChunkReport, FarmExplanation, FarmRun, FarmStatus, KnownHashes,
             GalleryList, HighlightTables, LobeSearch, MeasuredFits, Models, Plan, Profile,
             Profiles, Project, Reference, Render, Result, Scene, Sensitivity, ShaderCheck,
             SlurmDoctor, SlurmRun, VerifyHighlights, VerifyPaper, VerifyProfiles, VerifyStability,
             VerifyVerdicts>();

/// "list of Limit, at least 1": the type of a key, for people.
std::string type_text(const Json& schema) {
  if (schema.contains("allOf")) return type_text(schema["allOf"][0]);
  if (schema.contains("$ref")) {
    const std::string name = schema["$ref"].get<std::string>().substr(14);
    return fmt::format("[{}](#{})", name, lower_case(name));
  }
  if (schema.contains("anyOf")) {
    std::string text;
    for (const Json& one : schema["anyOf"]) text += (text.empty() ? "" : " or ") + type_text(one);
    return text;
  }
  if (schema.contains("enum")) {
    std::string text;
    for (const Json& one : schema["enum"])
      text += fmt::format("{}`{}`", text.empty() ? "" : ", ", one.get<std::string>());
    return text;
  }
  const std::string type = schema["type"];
  std::string text = type;
  if (type == "array") text = "list of " + type_text(schema["items"]);
  if (type == "object") text = "by name: " + type_text(schema["additionalProperties"]);
  const auto bound = [&](const char* key, const char* words) {
    if (schema.contains(key)) text += fmt::format(", {} {}", words, schema[key].dump());
  };
  bound("minimum", "at least");
  bound("maximum", "at most");
  bound("exclusiveMinimum", "over");
  bound("exclusiveMaximum", "below");
  bound("minItems", "at least");
  bound("maxItems", "at most");
  return text;
}

std::string table_of(const Struct& type) {
  std::string text =
      fmt::format("## {}\n\n{}\n\n| key | type | there | meaning |\n|---|---|---|---|\n",
                  type.name(), type.meaning());
  const auto row = [&](std::string_view key, const std::string& value, std::string_view presence,
                       std::string_view meaning) {
    text += fmt::format("| {} | {} | {} | {} |\n", key, value, presence, meaning);
  };
  if (!type.kind().empty()) {
    const std::string there = type.is_by_hand() ? "if any" : "always";
    row("`schemaVersion`", fmt::format("{}", kRecordSchemaVersion), there, "");
    row("`kind`", fmt::format("`{}`", type.kind()), there, "");
    row("`madeBy`", "string", there, "program and version");
  }
  for (const Field& field : type.fields()) {
    const Json schema = field.type->schema(field.bounds);
    if (field.is_rest())
      row("any other", type_text(schema["additionalProperties"]), "", field.description());
    else
      row(fmt::format("`{}`", field.key), type_text(schema),
          field.presence == Presence::kAlways  ? "always"
          : field.presence == Presence::kIfAny ? "if any"
                                               : "or null",
          field.description());
  }
  if (type.is_sealed())
    row(fmt::format("`{}`", kSealKey), "string", "always",
        "SHA-256 of the record without this key");
  return text;
}

}  // namespace

const Struct& detail::find_struct(const std::type_info& type) {
  static const Tables tables = [] {
    Tables all;
    for (auto* const define :
         {define_agreement_tables,  define_bench_tables,       define_bsdf_check_tables,
          define_chart_tables,      define_cluster_tables,     define_comparison_tables,
          define_conversion_tables, define_cost_tables,        define_farm_tables,
          define_highlight_tables,  define_lobe_search_tables, define_measured_tables,
          define_model_tables,      define_page_tables,        define_paper_tables,
          define_profile_tables,    define_project_tables,     define_render_tables,
          define_result_tables,     define_scene_tables,       define_shader_check_tables,
          define_stability_tables,  define_verdict_tables,     define_verify_tables})
      define(all);
    return all;
  }();
  return tables[type];
}

std::span<const Kind> kinds() { return kKinds; }

std::string schema_text(const Kind& kind) {
  Definitions definitions;
  definitions.add(kind.type());
  const Struct& type = kind.type();
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", fmt::format("Lobelia's record of kind {}", type.kind())}};
  schema.update(type.definition());
  for (const Struct* one : definitions.all())
    if (one != &type) schema["definitions"][std::string(one->name())] = one->definition();
  return schema.dump(2) + "\n";
}

std::string reference_page(const Kind& kind) {
  const Struct& type = kind.type();
  Definitions definitions;
  definitions.add(type);
  std::string text = fmt::format(
      "# Records of kind {0}\n\nFor programs that read or write these files. Generated by `lobelia records -o "
      "DIR`; the same as a JSON Schema is in [{0}.schema.json]({0}.schema.json).\n\n{1}",
      type.kind(), table_of(type));
  for (const Struct* one : definitions.all())
    if (one != &type) text += "\n" + table_of(*one);
  return text;
}

std::string reference_index() {
  std::string text =
      "# Records\n\nFor programs that read Lobelia's files. Generated by `lobelia records -o DIR`; "
      "[records.md](../records.md) says where they lie.\n\n| kind | what it says |\n|---|---|\n";
  for (const Kind& kind : kinds())
    text += fmt::format("| [{0}]({0}.md) | {1} |\n", kind.type().kind(), kind.type().meaning());
  return text;
}

std::string typescript_text() {
  Definitions definitions;
  for (const Struct* page :
       {&struct_type<GridPage>(), &struct_type<GridColumns>(), &struct_type<CellPage>(),
        &struct_type<PackedPicture>(), &struct_type<PixelRuns>(), &struct_type<InlinedPage>(),
        &struct_type<CellIndex>(), &struct_type<CellChunk>(), &struct_type<CellTexts>(),
        &struct_type<Thumbnails>(), &struct_type<ExplorerPage>()})
    definitions.add(*page);
  std::string text =
      "// The program's data for the pages' scripts. Written by `lobelia records --typescript > "
      "gallery/web/src/records.ts`;\n// do not edit: base/records/pages.cpp has the tables.\n";
  for (const Struct* one : definitions.all()) text += "\n" + one->interface();
  return text;
}

}  // namespace lobelia::records

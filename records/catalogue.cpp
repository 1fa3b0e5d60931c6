#include "records/catalogue.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "records/agreement.hpp"
#include "records/cluster.hpp"
#include "records/comparison.hpp"
#include "records/cost.hpp"
#include "records/farm.hpp"
#include "records/models.hpp"
#include "records/paper.hpp"
#include "records/profile.hpp"
#include "records/record.hpp"
#include "records/render.hpp"
#include "records/result.hpp"
#include "records/stability.hpp"

namespace lobelia::records {
namespace {

template <class T>
constexpr Kind kind() {
  return {T::type, [](std::string_view text, const std::string& where) {
            return record_text(parse_record<T>(text, where));
          }};
}

constexpr Kind kKinds[] = {kind<Agreement>(),
                           kind<Blob>(),
                           kind<Cell>(),
                           kind<Comparison>(),
                           kind<ComparisonSet>(),
                           kind<Content>(),
                           kind<Cost>(),
                           kind<Engines>(),
                           kind<Failure>(),
                           kind<Farm>(),
                           kind<FarmChunk>(),
                           kind<FarmChunkReport>(),
                           kind<FarmExplanation>(),
                           kind<FarmRun>(),
                           kind<FarmStatus>(),
                           kind<KnownHashes>(),
                           kind<GalleryList>(),
                           kind<HighlightTables>(),
                           kind<Models>(),
                           kind<Plan>(),
                           kind<Profile>(),
                           kind<Profiles>(),
                           kind<Reference>(),
                           kind<Render>(),
                           kind<Result>(),
                           kind<SlurmDoctor>(),
                           kind<SlurmRun>(),
                           kind<VerifyPaper>(),
                           kind<VerifyStability>()};

/// "list of Limit, at least 1": the type of a key, for people.
std::string type_text(const Json& schema) {
  if (schema.contains("allOf")) return type_text(schema["allOf"][0]);
  if (schema.contains("$ref")) {
    const std::string name = schema["$ref"].get<std::string>().substr(14);
    std::string anchor;
    for (const char c : name) anchor += char(std::tolower(static_cast<unsigned char>(c)));
    return fmt::format("[{}](#{})", name, anchor);
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
    row("`schemaVersion`", fmt::format("{}", kRecordSchemaVersion), "always", "");
    row("`kind`", fmt::format("`{}`", type.kind()), "always", "");
    row("`madeBy`", "string", "always", "program and version");
  }
  for (const Field& field : type.fields()) {
    std::string meaning(field.meaning);
    if (!field.unit_name.empty())
      meaning += fmt::format("{}{}", meaning.empty() ? "" : "; ", field.unit_name);
    const Json schema = field.type->schema(field.bounds);
    if (field.is_rest())
      row("any other", type_text(schema["additionalProperties"]), "", meaning);
    else
      row(fmt::format("`{}`", field.key), type_text(schema),
          field.presence == Presence::kAlways  ? "always"
          : field.presence == Presence::kIfAny ? "if any"
                                               : "or null",
          meaning);
  }
  if (type.is_sealed())
    row(fmt::format("`{}`", kSealKey), "string", "always",
        "SHA-256 of the record without this key");
  return text;
}

}  // namespace

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
      "docs/reference`; the same as a JSON Schema is in [{0}.schema.json]({0}.schema.json).\n\n{1}",
      type.kind(), table_of(type));
  for (const Struct* one : definitions.all())
    if (one != &type) text += "\n" + table_of(*one);
  return text;
}

std::string reference_index() {
  std::string text =
      "# Records\n\nFor programs that read Lobelia's files. Generated by `lobelia records -o docs/reference`; "
      "[records.md](../records.md) says where they lie.\n\n| kind | what it says |\n|---|---|\n";
  for (const Kind& kind : kinds())
    text += fmt::format("| [{0}]({0}.md) | {1} |\n", kind.type().kind(), kind.type().meaning());
  return text;
}

}  // namespace lobelia::records

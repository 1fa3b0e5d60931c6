#include "base/records/struct_type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/version.hpp"
#include "base/words/text.hpp"

namespace lobelia::records {

std::string Field::description() const {
  const std::string_view between = meaning.empty() || unit.empty() ? "" : "; ";
  return fmt::format("{}{}{}", meaning, between, unit);
}

void* Field::member_of(void* record) const { return static_cast<char*>(record) + offset; }

void Struct::add_key(std::string_view key, const Type& type, std::size_t offset,
                     Presence presence) {
  fields_.push_back({key, &type, offset, presence});
}

Json Struct::write(const void* value) const {
  Json object = Json::object();
  if (!kind_.empty())
    object = {
        {"schemaVersion", kRecordSchemaVersion}, {"kind", kind_}, {"madeBy", kNameAndVersion}};
  for (const Field& field : fields_) {
    // Writing does not change the record; member_of() also serves the reader.
    const void* member = field.member_of(const_cast<void*>(value));
    const bool is_empty = field.presence != Presence::kAlways && field.type->is_empty(member);
    if (is_empty && field.presence == Presence::kIfAny) continue;
    if (field.is_rest()) {
      object.update(field.type->write(member));
      continue;
    }
    object[std::string(field.key)] = is_empty ? Json(nullptr) : field.type->write(member);
  }
  return object;
}

void Struct::read(const Json& json, const Bounds&, const Place& place, void* value) const {
  if (!json.is_object()) place.fail("not an object");
  if (is_by_hand_) refuse_others(json, place);
  if (!kind_.empty() && (!is_by_hand_ || json.contains("kind"))) require_kind(json, kind_, place);
  for (const Field& field : fields_) {
    if (field.is_rest()) {
      field.type->read(others(json), field.bounds, place, field.member_of(value));
      continue;
    }
    const auto found = json.find(field.key);
    const bool is_missing =
        found == json.end() || (field.presence == Presence::kOrNull && found->is_null());
    if (is_missing) {
      if (found == json.end() && field.is_required()) Place(place, field.key).fail("missing");
      continue;
    }
    field.type->read(*found, field.bounds, Place(place, field.key), field.member_of(value));
  }
  const auto is_there = [&](std::string_view key) { return json.contains(key); };
  if (!needs_.empty() && std::ranges::none_of(needs_, [&](const auto& keys) {
        return std::ranges::all_of(keys, is_there);
      })) {
    std::string lists;
    for (const auto& keys : needs_)
      lists += fmt::format("{}{}", lists.empty() ? "" : ", or ", fmt::join(keys, " and "));
    place.fail("needs " + lists);
  }
  if (contradiction_)
    if (const std::string sentence = contradiction_(value); !sentence.empty()) place.fail(sentence);
}

void Struct::refuse_others(const Json& json, const Place& place) const {
  std::vector<std::string_view> known;
  for (const Field& field : fields_) known.push_back(field.key);
  if (!kind_.empty()) known.insert(known.end(), {"schemaVersion", "kind", "madeBy"});
  for (const auto& [key, value] : json.items())
    if (std::ranges::count(known, key) == 0)
      Place(place, key).fail("there is no such key" + did_you_mean(key, known));
}

Json Struct::others(const Json& json) const {
  Json others = Json::object();
  for (const auto& [key, value] : json.items())
    if (std::ranges::find(fields_, key, &Field::key) == fields_.end()) others[key] = value;
  return others;
}

Json Struct::schema(const Bounds&) const {
  return {{"$ref", fmt::format("#/definitions/{}", name_)}};
}

std::string Struct::typescript(const Bounds&) const { return std::string(name_); }

Json Struct::definition() const {
  Json required = Json::array(), properties = Json::object(), rest;
  if (!kind_.empty()) {
    if (!is_by_hand_) required = {"schemaVersion", "kind", "madeBy"};
    properties = {{"schemaVersion", {{"const", kRecordSchemaVersion}}},
                  {"kind", {{"const", kind_}}},
                  {"madeBy", {{"type", "string"}}}};
  }
  for (const Field& field : fields_) {
    if (field.is_required()) required.push_back(field.key);
    Json schema = field.type->schema(field.bounds);
    if (field.is_rest()) {
      rest = schema["additionalProperties"];
      continue;
    }
    if (field.presence == Presence::kOrNull)
      schema = {{"anyOf", Json::array({std::move(schema), Json{{"type", "null"}}})}};
    // JSON Schema draft 7 ignores keys beside $ref.
    const std::string text = field.description();
    if (!text.empty() && schema.contains("$ref"))
      schema = {{"allOf", Json::array({std::move(schema)})}};
    if (!text.empty()) schema["description"] = text;
    properties[std::string(field.key)] = std::move(schema);
  }
  if (is_sealed_) {
    required.push_back(kSealKey);
    properties[kSealKey] = {{"type", "string"},
                            {"description", "SHA-256 of the record without this key"}};
  }
  Json schema{{"type", "object"},
              {"description", meaning_},
              {"required", std::move(required)},
              {"properties", std::move(properties)}};
  for (const auto& keys : needs_) schema["anyOf"].push_back({{"required", keys}});
  if (!rest.is_null()) schema["additionalProperties"] = std::move(rest);
  if (is_by_hand_) schema["additionalProperties"] = false;
  return schema;
}

std::string Struct::interface() const {
  std::string text = fmt::format("/** {} */\nexport interface {} {{\n", meaning_, name_);
  if (!kind_.empty())
    text += fmt::format("  schemaVersion: {};\n  kind: \"{}\";\n  madeBy: string;\n",
                        kRecordSchemaVersion, kind_);
  for (const Field& field : fields_) {
    if (const std::string meaning = field.description(); !meaning.empty())
      text += fmt::format("  /** {} */\n", meaning);
    if (field.is_rest()) {
      // TypeScript requires this type to cover the keys above.
      text += "  [name: string]: unknown;\n";
      continue;
    }
    text += fmt::format("  {}{}: {}{};\n", field.key, field.is_required() ? "" : "?",
                        field.type->typescript(field.bounds),
                        field.presence == Presence::kOrNull ? " | null" : "");
  }
  if (is_sealed_) text += fmt::format("  {}: string;\n", kSealKey);
  return text + "}\n";
}

}  // namespace lobelia::records

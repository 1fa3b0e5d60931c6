// Records against the JSON Schemas in docs.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "core/files.hpp"
#include "core/record.hpp"
#include "lobelia_paths.hpp"

namespace lobelia {

/// The validator knows the library's default type, not the one that keeps its order.
using Plain = nlohmann::json;

inline std::string document_text(const std::string& page) {
  return read_file(std::string(LOBELIA_SOURCE_DIR) + "/docs/" + page, 1 << 20);
}

/// As it stands in a file.
inline Plain as_written(const Json& record) { return Plain::parse(record_text(record)); }

/// What is wrong with a record; empty if nothing. A schema may refer to others of docs by their file's name.
inline std::string schema_problems(const std::string& schema_file, const Plain& record) {
  const Plain document = Plain::parse(document_text(schema_file));
  valijson::Schema parsed;
  valijson::SchemaParser().populateSchema(
      valijson::adapters::NlohmannJsonAdapter(document), parsed,
      [](const std::string& uri) { return new Plain(Plain::parse(document_text(uri))); },
      [](const Plain* fetched) { delete fetched; });
  valijson::ValidationResults results;
  if (valijson::Validator().validate(parsed, valijson::adapters::NlohmannJsonAdapter(record),
                                     &results))
    return "";
  std::string text = "invalid:";
  valijson::ValidationResults::Error error;
  while (results.popError(error)) text += " " + error.description;
  return text;
}

}  // namespace lobelia

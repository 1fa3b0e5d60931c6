// Holds a record to a JSON Schema of docs/.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "core/record.hpp"

namespace lobelia::testing {

// The validator knows the library's default type, not the one that keeps its order.
using PlainJson = nlohmann::json;

inline std::string text_of(const std::string& page) {
  std::ifstream file(std::string(LOBELIA_SOURCE_DIR) + "/docs/" + page);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// As it stands in a file.
inline PlainJson as_written(const Json& record) { return PlainJson::parse(record_text(record)); }

/// What is wrong with a record by a schema of docs/; empty if nothing.
inline std::string problems(const std::string& schema, const PlainJson& record) {
  const PlainJson document = PlainJson::parse(text_of(schema));
  valijson::Schema parsed;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(document),
                                          parsed);
  valijson::ValidationResults results;
  if (valijson::Validator().validate(parsed, valijson::adapters::NlohmannJsonAdapter(record),
                                     &results))
    return "";
  std::string text = "invalid:";
  valijson::ValidationResults::Error error;
  while (results.popError(error)) text += " " + error.description;
  return text;
}

}  // namespace lobelia::testing

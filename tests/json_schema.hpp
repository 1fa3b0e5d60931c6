// Records against their JSON Schemas, by a validator that knows nothing of ours.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "base/records/catalogue.hpp"
#include "tests/json.hpp"

namespace lobelia {

/// The validator knows the library's default type, not the one that keeps its order.
using Plain = nlohmann::json;

/// As it stands in a file.
template <class T>
Plain as_written(const T& record) {
  return Plain::parse(records::record_text(record));
}

class JsonSchema {
 public:
  explicit JsonSchema(const std::string& text) : document_(Plain::parse(text)) {
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(document_),
                                            parsed_);
  }

  /// The mistakes of a record; empty if there are none.
  std::string problems(const Plain& record) const {
    valijson::ValidationResults results;
    if (valijson::Validator().validate(parsed_, valijson::adapters::NlohmannJsonAdapter(record),
                                       &results))
      return "";
    std::string text = "invalid:";
    valijson::ValidationResults::Error error;
    while (results.popError(error)) text += " " + error.description;
    return text;
  }

 private:
  Plain document_;
  valijson::Schema parsed_;
};

template <class T>
JsonSchema schema_of() {
  return JsonSchema(records::schema_text({records::struct_type<T>, nullptr}));
}

/// The mistakes of a record by the schema of its kind.
template <class T>
std::string schema_problems(const T& record) {
  return schema_of<T>().problems(as_written(record));
}

}  // namespace lobelia

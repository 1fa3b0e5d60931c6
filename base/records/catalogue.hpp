// Every kind of record, by name.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct Kind {
  const Struct& (*type)();
  /// Reads a record of this kind and writes it again. Throws as parse_record().
  std::string (*reread)(std::string_view text, const std::string& where);
};

/// In the order of their names.
std::span<const Kind> kinds();

/// The JSON Schema (draft 7) of a kind: NAME.schema.json.
std::string schema_text(const Kind& kind);
/// The reference page of a kind, in Markdown.
std::string reference_page(const Kind& kind);
/// The list of all kinds, in Markdown: README.md of the reference pages.
std::string reference_index();
/// gallery/web/src/records.ts: an interface for each struct that the pages' scripts receive.
std::string typescript_text();

}  // namespace lobelia::records

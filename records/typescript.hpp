// The page data as TypeScript.
#pragma once

#include <string>

namespace lobelia::records {

/// gallery/web/src/records.ts: an interface for each struct that a page's script is given.
std::string typescript_text();

}  // namespace lobelia::records

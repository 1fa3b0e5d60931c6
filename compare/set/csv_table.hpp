// Reads tables of comma-separated values.
#pragma once

#include <string>
#include <vector>

namespace lobelia {

/// The records of RFC 4180, without empty lines and a byte order mark. `file` is for messages. Throws Error(kInput).
std::vector<std::vector<std::string>> csv_records(const std::string& file, const std::string& text);

}  // namespace lobelia

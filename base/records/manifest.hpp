// The manifest of a Cryptomatte. It is no record of ours, but is JSON that others wrote.
//
// Source: Cryptomatte Specification 1.2, an object {"name": "hexadecimal hash", ...}.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace lobelia::records {

/// Longer names are cut, in bytes.
inline constexpr std::size_t kLongestObjectName = 200;

/// The names of objects by hash, at most as many as the text has; the first of a hash counts. What follows a mistake is not
/// read; nothing is nested, so that depth is bounded.
std::map<std::uint32_t, std::string> object_names(const std::string& manifest);

}  // namespace lobelia::records

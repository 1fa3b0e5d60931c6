// The name of a result: a hash of everything that decides it.
#pragma once

#include <cstring>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/sha256.hpp"

namespace lobelia {

struct ResultKey {
  Sha256Digest digest{};

  std::string text() const { return hex(digest); }
  bool operator==(const ResultKey&) const = default;
  auto operator<=>(const ResultKey&) const = default;
};

/// Hashes the parts in their order, each with its length, so that no two lists make the same text.
inline ResultKey result_key(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) {
    text += std::to_string(part.size());
    text += ':';
    text += part;
  }
  return {sha256(text)};
}

/// A key as a part of another one.
inline std::string_view as_part(const ResultKey& key) {
  return {reinterpret_cast<const char*>(key.digest.data()), key.digest.size()};
}

}  // namespace lobelia

template <>
struct std::hash<lobelia::ResultKey> {
  std::size_t operator()(const lobelia::ResultKey& key) const noexcept {
    std::size_t value = 0;
    std::memcpy(&value, key.digest.data(), sizeof value);
    return value;
  }
};

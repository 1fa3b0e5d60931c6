// A cell's jobs, and the keys of their results in the cache.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "base/system/sha256.hpp"

namespace lobelia {

/// The name of a result: a hash of everything that decides it.
struct ResultKey {
  Sha256Digest digest{};

  std::string text() const { return hex(digest); }
  bool operator==(const ResultKey&) const = default;
  auto operator<=>(const ResultKey&) const = default;
};

/// Hashes the parts in order, each with its length: no two lists have the same text.
inline ResultKey result_key(std::span<const std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) {
    text += std::to_string(part.size());
    text += ':';
    text += part;
  }
  return {sha256(text)};
}

inline ResultKey result_key(std::initializer_list<std::string_view> parts) {
  return result_key(std::span(parts.begin(), parts.size()));
}

/// A key as a part of another key.
inline std::string_view as_part(const ResultKey& key) {
  return {reinterpret_cast<const char*>(key.digest.data()), key.digest.size()};
}

enum class JobKind : std::uint8_t {
  kRender,     ///< our picture
  kReference,  ///< an engine's picture
  kCompare,    ///< our picture with an engine's
  kProfile,    ///< the highlight in all pictures
};
inline constexpr std::string_view kJobKindNames[] = {"render", "reference", "compare", "profile"};

constexpr bool is_picture(JobKind kind) {
  return kind == JobKind::kRender || kind == JobKind::kReference;
}

inline constexpr char kOurs[] = "lobelia";  ///< our name among the engines
inline constexpr std::uint8_t kNoEngine = 255;

struct Job {
  ResultKey key;
  JobKind kind = JobKind::kRender;
  std::uint8_t engine = kNoEngine;  ///< index among the farm's, for a reference or a comparison
  bool exists = false;  ///< false: the cell has no such job, such as for an unknown engine
};

/// "compare-povray"
std::string job_name(JobKind kind, std::string_view engine);

/// GoogleTest's patterns, each as fnmatch(3) has it: "a*:b?c-d*" matches names like a* or b?c, except d*. An empty list
/// before '-' is everything.
class JobFilter {
 public:
  JobFilter() = default;
  explicit JobFilter(std::string_view patterns) : text_(patterns) {}
  bool picks(const std::string& name) const;
  bool picks_everything() const { return text_.empty(); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace lobelia

// A cell's jobs, each with a result in the cache.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "farm/result_key.hpp"

namespace lobelia {

enum class JobKind : std::uint8_t {
  kRender,     ///< our picture
  kReference,  ///< an engine's picture
  kCompare,    ///< ours with an engine's
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
  std::uint8_t engine = kNoEngine;  ///< among the farm's, for a reference and a comparison
  bool exists = false;  ///< false: the cell has no such job (an engine that is not there, say)
};

/// "compare-povray"
std::string job_name(JobKind kind, std::string_view engine);

/// GoogleTest's patterns: "a*:b?c-d*" is what matches a* or b?c and does not match d*. An empty list in front of
/// the '-' is everything.
class JobFilter {
 public:
  JobFilter() = default;
  explicit JobFilter(std::string_view patterns) : text_(patterns) {}
  bool picks(std::string_view name) const;
  bool picks_everything() const { return text_.empty(); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace lobelia

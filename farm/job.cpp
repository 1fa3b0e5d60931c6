#include "farm/job.hpp"

#include <fnmatch.h>

#include <algorithm>

#include "base/words/text.hpp"

namespace lobelia {
namespace {

bool matches_any(std::string_view patterns, const std::string& name) {
  return std::ranges::any_of(split(patterns, ":"), [&](const std::string& pattern) {
    return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  });
}

}  // namespace

std::string job_name(JobKind kind, std::string_view engine) {
  std::string name(kJobKindNames[int(kind)]);
  if (!engine.empty()) (name += '-') += engine;
  return name;
}

bool JobFilter::picks(const std::string& name) const {
  const std::string_view text = text_;
  // Names contain '-': the excluded patterns begin at the start or after a ':'.
  std::size_t minus = text.starts_with('-') ? 0 : text.find(":-");
  const std::string_view wanted = text.substr(0, minus);
  const std::string_view left_out =
      minus == text.npos ? std::string_view() : text.substr(minus + (text[minus] == ':' ? 2 : 1));
  if (!wanted.empty() && !matches_any(wanted, name)) return false;
  return !matches_any(left_out, name);
}

}  // namespace lobelia

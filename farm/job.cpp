#include "farm/job.hpp"

namespace lobelia {
namespace {

/// '*' is any text, '?' any one character. Linear time for each '*'.
bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = pattern.npos, after = 0;
  while (n < name.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]) && pattern[p] != '*') {
      ++p;
      ++n;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      after = n;
    } else if (star != pattern.npos) {
      p = star + 1;
      n = ++after;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

bool matches_any(std::string_view patterns, std::string_view name) {
  while (true) {
    const auto colon = patterns.find(':');
    const std::string_view pattern = patterns.substr(0, colon);
    if (!pattern.empty() && matches(pattern, name)) return true;
    if (colon == patterns.npos) return false;
    patterns.remove_prefix(colon + 1);
  }
}

}  // namespace

std::string job_name(JobKind kind, std::string_view engine) {
  std::string name(kJobKindNames[int(kind)]);
  if (!engine.empty()) (name += '-') += engine;
  return name;
}

bool JobFilter::picks(std::string_view name) const {
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

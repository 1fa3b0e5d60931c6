#include "farm/slurm/slurm_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "core/text.hpp"

namespace lobelia {
namespace {

constexpr long long kMost =
    1'000'000'000;  // no request is as large, and twice of it is still a number

/// Digits and nothing else.
std::optional<long long> count_of(std::string_view text) {
  long long value = 0;
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != text.npos ||
      !parse_integer(text, value))
    return {};
  return value;
}

}  // namespace

std::optional<long long> parse_slurm_time(std::string_view text) {
  const auto dash = text.find('-');
  const bool with_days = dash != text.npos;
  std::optional<long long> days = 0;
  if (with_days) {
    days = count_of(text.substr(0, dash));
    text.remove_prefix(dash + 1);
  }
  std::vector<long long> parts;
  while (true) {
    const auto colon = text.find(':');
    const auto part = count_of(text.substr(0, colon));
    if (!part || !days || parts.size() == 3) return {};
    parts.push_back(*part);
    if (colon == text.npos) break;
    text.remove_prefix(colon + 1);
  }
  // With days the first part is hours; without, a single one or the first of two is minutes.
  if (!with_days && parts.size() < 3) parts.insert(parts.begin(), 0);
  parts.resize(3, 0);
  const long long seconds = ((*days * 24 + parts[0]) * 60 + parts[1]) * 60 + parts[2];
  if (seconds <= 0 || seconds > kMost) return {};
  return seconds;
}

std::string slurm_time_text(long long seconds) {
  const long long days = seconds / 86400, hours = seconds / 3600 % 24;
  const std::string rest = fmt::format(":{:02}:{:02}", seconds / 60 % 60, seconds % 60);
  return days > 0 ? fmt::format("{}-{:02}{}", days, hours, rest) : fmt::format("{}{}", hours, rest);
}

std::optional<long long> parse_slurm_memory(std::string_view text) {
  constexpr std::string_view kUnits = "KMGT";
  long long kibibytes = 1024;
  if (text.ends_with('B') || text.ends_with('b')) text.remove_suffix(1);
  if (!text.empty()) {
    const auto unit = kUnits.find(char(std::toupper(static_cast<unsigned char>(text.back()))));
    if (unit != kUnits.npos) {
      kibibytes = 1LL << (10 * unit);
      text.remove_suffix(1);
    }
  }
  const auto value = count_of(text);
  if (!value || *value == 0) return {};
  const long long mebibytes = (*value * kibibytes + 1023) / 1024;
  if (mebibytes > kMost) return {};
  return mebibytes;
}

std::string slurm_memory_text(long long mebibytes) {
  return mebibytes % 1024 == 0 ? fmt::format("{}G", mebibytes / 1024)
                               : fmt::format("{}M", mebibytes);
}

SlurmOptions with_own_fields(SlurmOptions options) {
  std::vector<std::string> raw;
  for (std::string& option : options.raw) {
    const auto equals = option.find('=');
    const std::string name = option.substr(0, equals);
    const std::string value = equals == option.npos ? "" : option.substr(equals + 1);
    if (name == "--time" && !value.empty())
      options.time = value;
    else if (name == "--mem" && !value.empty())
      options.memory = value;
    else if ((name == "--exclude" || name == "--exclud") && !value.empty())
      options.exclude += (options.exclude.empty() ? "" : ",") + value;
    else
      raw.push_back(std::move(option));
  }
  options.raw = std::move(raw);
  return options;
}

std::optional<long long> twice_at_most(long long asked, std::optional<long long> most) {
  const long long next = most ? std::min(2 * asked, *most) : 2 * asked;
  if (next <= asked || next > kMost) return {};
  return next;
}

}  // namespace lobelia

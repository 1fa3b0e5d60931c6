#include "farm/slurm/slurm_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

/// A run sets these itself: they decide what it waits for, where its logs are, how it is found again.
constexpr std::string_view kSetByTheRun[] = {
    "--array",      "--job-name",   "--comment",   "--output",      "--error",
    "--dependency", "--parsable",   "--wrap",      "--wait",        "--chdir",
    "--requeue",    "--no-requeue", "--open-mode", "--test-only",   "--kill-on-invalid-dep",
    "--ntasks",     "--hold",       "--export",    "--export-file", "--begin"};

void require_plain(std::string_view what, std::string_view value, std::size_t most = 1000) {
  const bool plain = value.size() <= most && std::ranges::none_of(value, [](unsigned char c) {
                       return c < 32 || c == 127;
                     });
  if (!plain)
    throw Error(ExitCode::kUsage, "{}: '{}' is over {} bytes or holds control characters", what,
                printable(value), most);
}

constexpr long long kMostAsked = 1'000'000'000;  // beyond any request; its double still is a number

/// Digits and nothing else.
std::optional<long long> count_of(std::string_view text) {
  long long value = 0;
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != text.npos ||
      !parse_integer(text, value))
    return {};
  return value;
}

}  // namespace

std::string memory_of_element(std::uint64_t job_bytes, int processors) {
  constexpr std::uint64_t kMebibyte = 1 << 20, kOwn = 512;
  if (job_bytes == 0) return "";
  return fmt::format("{}M",
                     (job_bytes + kMebibyte - 1) / kMebibyte * std::uint64_t(processors) + kOwn);
}

std::vector<std::string> sbatch_arguments(const SlurmOptions& options) {
  std::vector<std::string> result;
  const auto add = [&](const char* name, const std::string& value) {
    require_plain(name, value);
    if (!value.empty()) result.push_back(fmt::format("{}={}", name, value));
  };
  add("--partition", options.partition);
  add("--time", options.time);
  add("--mem", options.memory);
  add("--account", options.account);
  add("--qos", options.qos);
  add("--constraint", options.constraint);
  // A run adds nodes to the list; sbatch takes a list with "/" for the name of a file.
  if (options.exclude.find('/') != std::string::npos)
    throw Error(ExitCode::kUsage, "--exclude={}: name the nodes, not a file of them",
                printable(options.exclude));
  require_plain("--exclude", options.exclude, 60000);
  if (!options.exclude.empty()) result.push_back("--exclude=" + options.exclude);
  if (options.exclusive) result.push_back("--exclusive");
  if (options.processors < 1 || options.processors > 4096)
    throw Error(ExitCode::kUsage, "processors of an element: {} is not within 1 to 4096",
                options.processors);
  if (options.throttle < 0 || options.throttle > 1'000'000)
    throw Error(ExitCode::kUsage, "elements at once: {} is not within 0 to 1000000",
                options.throttle);
  add("--cpus-per-task", std::to_string(options.processors));
  for (const std::string& option : options.raw) {
    require_plain("sbatch option", option);
    if (option.size() < 3 || !option.starts_with("--"))
      throw Error(ExitCode::kUsage, "sbatch option '{}' does not begin with --", printable(option));
    // sbatch also takes abbreviated options: "--arr=0-9".
    const std::string_view name = std::string_view(option).substr(0, option.find('='));
    for (const auto ours : kSetByTheRun)
      if (ours == name || (name.size() > 4 && ours.starts_with(name)))
        throw Error(ExitCode::kUsage, "sbatch option '{}': {} is set by the run itself",
                    printable(option), ours);
    result.push_back(option);
  }
  return result;
}

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
  // The first part is hours after days or before two others, otherwise minutes.
  if (!with_days && parts.size() < 3) parts.insert(parts.begin(), 0);
  parts.resize(3, 0);
  const long long seconds = ((*days * 24 + parts[0]) * 60 + parts[1]) * 60 + parts[2];
  if (seconds <= 0 || seconds > kMostAsked) return {};
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
  if (mebibytes > kMostAsked) return {};
  return mebibytes;
}

std::string slurm_memory_text(long long mebibytes) {
  return mebibytes % 1024 == 0 ? fmt::format("{}G", mebibytes / 1024)
                               : fmt::format("{}M", mebibytes);
}

SlurmOptions with_own_fields(SlurmOptions options) {
  std::erase_if(options.raw, [&](const std::string& option) {
    const auto equals = option.find('=');
    const std::string name = option.substr(0, equals);
    const std::string value = equals == option.npos ? "" : option.substr(equals + 1);
    if (value.empty()) return false;
    if (name == "--time")
      options.time = value;
    else if (name == "--mem")
      options.memory = value;
    else if (name == "--exclude" || name == "--exclud")
      options.exclude += (options.exclude.empty() ? "" : ",") + value;
    else
      return false;
    return true;
  });
  return options;
}

std::optional<long long> twice_at_most(long long asked, std::optional<long long> most) {
  const long long next = most ? std::min(2 * asked, *most) : 2 * asked;
  if (next <= asked || next > kMostAsked) return {};
  return next;
}

}  // namespace lobelia

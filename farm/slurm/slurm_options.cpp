#include "farm/slurm/slurm_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

/// A run depends on them: what it waits for, where its logs are, how it is found again.
constexpr std::array<std::string_view, 20> kSetByTheRun = {
    "--array",      "--job-name",   "--comment",   "--output",      "--error",
    "--dependency", "--parsable",   "--wrap",      "--wait",        "--chdir",
    "--requeue",    "--no-requeue", "--open-mode", "--test-only",   "--kill-on-invalid-dep",
    "--ntasks",     "--hold",       "--export",    "--export-file", "--begin"};

void require_plain(std::string_view what, std::string_view value, std::size_t most = 1000) {
  const bool plain = value.size() <= most && std::none_of(value.begin(), value.end(), [](char c) {
                       return static_cast<unsigned char>(c) < 32 || c == 127;
                     });
  if (!plain)
    throw Error(ExitCode::kUsage,
                fmt::format("{}: '{}' is over {} bytes or holds control characters", what,
                            printable(value), most));
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
  // A run adds nodes to the list, and with "/" sbatch takes it for the name of a file that has them.
  if (options.exclude.find('/') != std::string::npos)
    throw Error(ExitCode::kUsage, fmt::format("--exclude={}: name the nodes, not a file of them",
                                              printable(options.exclude)));
  require_plain("--exclude", options.exclude, 60000);
  if (!options.exclude.empty()) result.push_back("--exclude=" + options.exclude);
  if (options.exclusive) result.push_back("--exclusive");
  if (options.processors < 1 || options.processors > 4096)
    throw Error(
        ExitCode::kUsage,
        fmt::format("processors of an element: {} is not within 1 to 4096", options.processors));
  if (options.throttle < 0 || options.throttle > 1'000'000)
    throw Error(ExitCode::kUsage,
                fmt::format("elements at once: {} is not within 0 to 1000000", options.throttle));
  add("--cpus-per-task", std::to_string(options.processors));
  for (const std::string& option : options.raw) {
    require_plain("sbatch option", option);
    if (option.size() < 3 || !option.starts_with("--"))
      throw Error(ExitCode::kUsage,
                  fmt::format("sbatch option '{}' does not begin with --", printable(option)));
    // sbatch takes an option by its beginning too: "--arr=0-9".
    const std::string_view name = std::string_view(option).substr(0, option.find('='));
    for (const auto ours : kSetByTheRun)
      if (ours == name || (name.size() > 4 && ours.starts_with(name)))
        throw Error(ExitCode::kUsage, fmt::format("sbatch option '{}': {} is set by the run itself",
                                                  printable(option), ours));
    result.push_back(option);
  }
  return result;
}

}  // namespace lobelia

#include "program/command/common_options.hpp"

#include <algorithm>
#include <fstream>

namespace lobelia::cli {
namespace {

constexpr CommonOption kCommonOptions[] = {
    {"-o,--output", "", "Where the result goes"},
    {"--json", "FILE|-", "Write the record to FILE; with - to stdout, in place of the text"},
    {"-q,--quiet", "", "Print less: no progress, no notes, nothing of what passes"},
    {"-v,--verbose", "", "Print more, and at the end the time and memory used"},
    {"--seed", "N", "Chooses the random numbers"},
    {"--samples", "N", "Rays per pixel; 1 is the pixel's centre"},
    {"--threads", "N", "Worker threads; 0: one per processor"},
    {"--time-limit", "SECONDS", "Stop after this time"},
};

constexpr OldOption kOldOptions[] = {
    {"compare", "--noise-seed", "--seed N"},
    {"compare", "--histogram", "--diff-image ERRORS.exr --diff-of flip.ldr"},
    {"search", "-o", "--json FILE"},
    {"search", "--output", "--json FILE"},
    {"reference", "--witness", "--shading NAME"},
    {"reference", "--point-seed", "--seed N"},
};

Verbosity g_verbosity;

/// Refuses a file of another kind, which a command would replace that once took --json without a value.
CLI::Validator json_file() {
  return {[](const std::string& path) {
            if (path == "-" || path.ends_with(".json")) return std::string();
            std::error_code error;
            if (!std::filesystem::is_regular_file(path, error)) return std::string();
            char first = '{';
            std::ifstream(path) >> first;
            return first == '{' ? std::string()
                                : fmt::format(
                                      "{}: is there and is no JSON; allowed: a file to "
                                      "write, or - for stdout",
                                      printable_path(path));
          },
          ""};
}

}  // namespace

std::span<const CommonOption> common_options() { return kCommonOptions; }

const CommonOption& common_option(std::string_view name) {
  return *std::ranges::find_if(kCommonOptions, [&](const CommonOption& option) {
    return option.names == name || option.names.ends_with("," + std::string(name));
  });
}

CLI::Option* add_json(OptionGroup& group, std::string& target, const std::string& kinds) {
  return add_common(group, "--json", target, fmt::format(" (kind {})", kinds))->check(json_file());
}

void WorkLimits::add_to(OptionGroup& group) {
  add_common(group, "--threads", threads_)->check(between(0, 1024))->capture_default_str();
  add_time_limit_to(group);
}

void WorkLimits::add_time_limit_to(OptionGroup& group) {
  add_common(group, "--time-limit", time_limit_, ", with exit code 124")
      ->check(between(0.001, 1e7));
}

const Verbosity& verbosity() { return g_verbosity; }

void add_verbosity(CLI::App& program) {
  for (CLI::App* command : program.get_subcommands(nullptr)) {
    // A parent's flag would stand for its subcommands, too.
    OptionGroup group(*command);
    const auto add = [&](std::string_view name, bool& flag) {
      const CommonOption& option = common_option(name);
      return group.add_flag(std::string(option.names), flag, std::string(option.meaning));
    };
    auto* quiet = add("--quiet", g_verbosity.quiet);
    add("--verbose", g_verbosity.verbose)->excludes(quiet);
    add_verbosity(*command);
  }
}

std::span<const OldOption> old_options() { return kOldOptions; }

}  // namespace lobelia::cli

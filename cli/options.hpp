// What the options of several subcommands share.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia::cli {

/// Adds options under one heading of a command's help.
class OptionGroup {
 public:
  OptionGroup(CLI::App& command, std::string heading) : command_(command), heading_(heading) {}

  /// `type` stands for the value in the help; empty: as CLI11 names the variable's type.
  template <class T>
  CLI::Option* add(const std::string& name, T& value, const std::string& type,
                   const std::string& help) {
    CLI::Option* const option = command_.add_option(name, value, help)->group(heading_);
    return type.empty() ? option : option->type_name(type);
  }
  CLI::Option* add_flag(const std::string& name, bool& value, const std::string& help) {
    return command_.add_flag(name, value, help)->group(heading_);
  }

 private:
  CLI::App& command_;
  std::string heading_;
};

/// Checks that an option's number lies in a range. CLI::Range lets a NaN pass, which is neither below `min` nor
/// above `max`.
CLI::Validator between(double min, double max);

/// --any-format, for the commands that take pictures of others.
void add_any_format(CLI::App& command);

/// Looks up `value` with `find`. Throws Error(kUsage) that says what is `allowed`, and which of the `names` may have
/// been meant.
template <class Find>
auto chosen(const std::string& value, std::string_view option,
            std::span<const std::string_view> names, const std::string& allowed, Find find) {
  const auto found = find(value);
  if (!found)
    throw Error(ExitCode::kUsage,
                fmt::format("{} '{}' is unknown; allowed: {}{}", option, printable(value), allowed,
                            did_you_mean(value, names)));
  return *found;
}

/// Throws Error(kUsage) unless `image` ends in .exr, Error(kOutput) unless it and the record beside
/// it can be written; returns the record's path (OUT.exr -> OUT.json).
std::filesystem::path checked_record_path(const std::filesystem::path& image);

}  // namespace lobelia::cli

// Options that several subcommands share.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/error.hpp"
#include "base/words/choice.hpp"
#include "base/words/text.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::cli {

/// Checks that an option's number lies in a range. CLI::Range accepts a NaN.
CLI::Validator between(double min, double max);
/// Refuses an empty text, which a script gives whose variable is not set, and an option in place of a name.
CLI::Validator not_empty();

/// Adds options under one heading of a command's help.
class OptionGroup {
 public:
  explicit OptionGroup(CLI::App& command, std::string heading = "Options")
      : command_(command), heading_(std::move(heading)) {}

  /// `type` names the value in the help; empty: CLI11's name for the variable's type.
  template <class T>
  CLI::Option* add(const std::string& name, T& value, const std::string& type,
                   const std::string& help) {
    CLI::Option* const option = command_.add_option(name, value, help)->group(heading_);
    if (type.starts_with("FILE") || type.starts_with("DIR") || type.find(".") != type.npos)
      option->check(not_empty());
    return type.empty() ? option : option->type_name(type);
  }
  /// A number from `min` to `max`. The help shows its default.
  template <class T>
  CLI::Option* add_number(const std::string& name, T& value, double min, double max,
                          const std::string& help) {
    return add(name, value, "", help)->check(between(min, max))->capture_default_str();
  }
  /// One of `words`. The help shows its default.
  CLI::Option* add_choice(const std::string& name, std::string& value,
                          const std::vector<std::string>& words, const std::string& help) {
    return add(name, value, "", help)->check(CLI::IsMember(words))->capture_default_str();
  }
  CLI::Option* add_flag(const std::string& name, bool& value, const std::string& help) {
    return command_.add_flag(name, value, help)->group(heading_);
  }

 private:
  CLI::App& command_;
  std::string heading_;
};

/// --any-format, for commands that read pictures from other programs.
void add_reading_options(CLI::App& command);

/// The position of `value` in `names`. Throws as chosen().
std::size_t chosen_place(const std::string& value, std::string_view option,
                         std::span<const std::string_view> names);

/// Throws Error(kUsage) unless `image` ends in .exr, Error(kOutput) unless it and the record beside
/// it can be written; returns the record's path (OUT.exr -> OUT.json).
std::filesystem::path checked_record_path(const std::filesystem::path& image);

/// --povray PATH and --blender PATH: an option for every engine of the catalogue.
class EnginePrograms {
 public:
  /// This object has to live as long as `command`.
  void add_to(CLI::App& command);
  /// By engine, without those that the user left out.
  std::map<std::string, std::filesystem::path> given() const;
  /// Empty if the user left it out: the one in $PATH.
  std::filesystem::path of(std::string_view engine) const;

 private:
  std::map<std::string, std::filesystem::path, std::less<>> typed_;
};

/// --lobe NAME, and --formula TEXT for a lobe by its formula.
class LobeOption {
 public:
  /// This object has to live as long as the command.
  void add_to(OptionGroup& group, const std::string& usual = "");
  /// A formula without a name will do. None if the user left both out and there is no usual one. Throws Error(kUsage).
  std::optional<LobeId> lobe() const;
  bool is_given() const { return name_ || formula_; }

 private:
  std::optional<std::string> name_, formula_;
  std::string usual_;
};

/// Throws Error(kUsage) if the highlight's formula is no lobe at its exponent.
void require_lobe(const Highlight& highlight);

/// Sets the model, and with "ggx" the lobe. Throws Error(kUsage) for a name that is none.
void set_chosen_model(Highlight& highlight, const std::string& name, std::string_view option);

/// The options that change a scene, the same for every subcommand that takes one.
class SceneOverrides {
 public:
  /// This object has to live as long as `command`.
  void add_to(CLI::App& command);
  /// Changes every material of the scene. Throws Error(kUsage) naming the value and what is allowed.
  void apply(Scene& scene) const;
  /// --seed, if it is given.
  std::optional<std::uint64_t> seed() const { return seed_; }

 private:
  std::optional<std::string> model_, normalisation_;
  LobeOption lobe_;
  std::optional<double> exponent_, roughness_;
  std::optional<int> width_, height_, samples_;
  std::optional<std::uint64_t> seed_;
};

/// --filter NAME[,RADIUS]: the filter with which pictures of a scene were averaged over their pixels.
class FilterOption {
 public:
  /// This object has to live as long as the command.
  CLI::Option* add_to(OptionGroup& group);
  /// Sets the film's filter, and tells whether pixels are means; nothing if the option was left out. Throws Error(kUsage).
  std::optional<bool> apply(Film& film) const;

 private:
  std::string text_;
};

}  // namespace lobelia::cli

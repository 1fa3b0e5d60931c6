#include "program/command/compare/compare_options.hpp"

#include <algorithm>
#include <type_traits>

#include "program/command/common_options.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

CLI::Option* add_flag(OptionGroup& group, const CompareOption& option, bool& value) {
  return group.add_flag(fmt::format("--{}", option.name), value, option.meaning);
}

template <class T>
CLI::Option* add_value(OptionGroup& group, const CompareOption& option, T& value) {
  const std::string name = fmt::format("--{}", option.name);
  const bool is_common = std::ranges::any_of(
      common_options(), [&](const CommonOption& one) { return one.names == name; });
  auto* const added = is_common ? add_common(group, name, value, option.meaning)
                                : group.add(name, value, std::string(option.value), option.meaning);
  if constexpr (std::is_arithmetic_v<T>) {
    added->check(between(option.least, option.most));
    // Outside of the range it stands for a file's own number.
    if (double(value) >= option.least && double(value) <= option.most) added->capture_default_str();
  } else if (!option.words.empty()) {
    added->check(CLI::IsMember(option.words))->capture_default_str();
  }
  if constexpr (std::is_same_v<T, std::vector<std::string>>) added->expected(1)->take_all();
  if (!option.usual.empty()) added->default_str(std::string(option.usual));
  if (!option.value.empty()) added->type_name(std::string(option.value));
  return added;
}

}  // namespace

void add_compare_options(CLI::App& command, CompareChoice& choice, std::string_view heading) {
  OptionGroup group(command, std::string(heading));
  for (const CompareOption& option : compare_options()) {
    if (option.heading != heading) continue;
    auto* const added = std::visit(
        [&](auto member) {
          if constexpr (std::is_same_v<decltype(member), bool CompareChoice::*>)
            return add_flag(group, option, choice.*member);
          else
            return add_value(group, option, choice.*member);
        },
        option.place);
    for (const std::string_view other : option.excludes)
      added->excludes(command.get_option(fmt::format("--{}", other)));
    for (const std::string_view other : option.needs)
      added->needs(command.get_option(fmt::format("--{}", other)));
  }
}

std::string usual_project() {
  constexpr char kFile[] = "lobelia.toml";
  std::error_code unknown;
  return std::filesystem::exists(kFile, unknown) ? kFile : "";
}

SceneParts scene_parts(const std::string& file, bool with_edges) {
  const Scene scene = read_scene(file);
  return {truth::surface_mask(scene), with_edges ? truth::edge_ring(scene) : PixelFlags{}};
}

}  // namespace lobelia::cli

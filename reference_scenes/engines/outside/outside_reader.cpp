#include "reference_scenes/engines/outside/outside_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/formats/catalogue.hpp"
#include "renderer/plan/effects/catalogue.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;
using records::OutsideEngine;

constexpr std::size_t kMostArguments = 1000, kMostName = 32;
// Nobody sees an error of 1e-3 of a value. Near black, the share of the peak allows for rounding.
constexpr double kUsualOfValue = 1e-3, kUsualOfPeak = 1e-6;

/// Names that would be a cell's own files.
constexpr std::string_view kTaken[] = {"lobelia", "profile", "cell", "scene", "farm"};

std::vector<std::string_view> form_names() {
  std::vector<std::string_view> names;
  for (const SceneFormat& format : scene_formats()) names.push_back(format.name);
  return names;
}

XmlAttribute text(std::string_view name, std::string_view default_value, std::string_view meaning) {
  return {{name, ParameterType::kString, default_value, 0, 0, "", meaning}};
}

class Reader {
 public:
  Reader(XmlSource& source, pugi::xml_node node, const fs::path& directory)
      : source_(source), node_(node) {
    engine_.directory = directory.string();
  }

  std::optional<OutsideEngine> read() {
    const bool is_pictures = std::string_view(node_.name()) == "pictures";
    source_.check_attributes(node_,
                             find_element(outside_elements(), node_.name()).attribute_names());
    read_name();
    constexpr std::size_t kMostTitle = 100;
    engine_.title = node_.attribute("title").as_string(engine_.name.c_str());
    if (engine_.title.empty() || engine_.title.size() > kMostTitle)
      error("title", fmt::format("the title has {} bytes; allowed: 1 to {}", engine_.title.size(),
                                 kMostTitle));
    read_tolerance();
    if (is_pictures) {
      engine_.files = source_.required(node_, "files");
    } else {
      engine_.command = arguments("command");
      engine_.version_command = arguments("version-command");
      if (engine_.command.empty()) error("command", "the command is empty; expected a program");
      require_places();
      read_scene_form();
      read_effects();
      read_environment();
    }
    return ok_ && !source_.has_errors() ? std::optional(engine_) : std::nullopt;
  }

 private:
  void error(const char* attribute, const std::string& what) {
    ok_ = false;
    if (node_.attribute(attribute))
      source_.error(node_.attribute(attribute), node_, what);
    else
      source_.error(node_, what);
  }

  void read_name() {
    engine_.name = source_.required(node_, "name");
    const std::string& name = engine_.name;
    const bool is_plain = !name.empty() && name.size() <= kMostName && name[0] >= 'a' &&
                          name[0] <= 'z' && std::ranges::all_of(name, [](char c) {
                            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
                          });
    if (!is_plain)
      error("name", fmt::format("engine name '{}'; allowed: up to {} small letters, digits and "
                                "'_', a letter first",
                                printable(name), kMostName));
    else if (std::ranges::find(kTaken, name) != std::end(kTaken) ||
             std::ranges::find(engine_infos(), name, &EngineInfo::name) != engine_infos().end())
      error("name", fmt::format("the name '{}' is taken; choose another one", name));
  }

  void read_tolerance() {
    engine_.of_value = kUsualOfValue;
    engine_.of_peak = kUsualOfPeak;
    const auto attribute = node_.attribute("tolerance");
    if (!attribute) return;
    const std::vector<std::string> parts = split(attribute.value(), ", ");
    const auto is_share = [](double share) { return share >= 0 && share <= 1; };
    if (parts.size() != 2 || !parse_number(parts[0], engine_.of_value) ||
        !parse_number(parts[1], engine_.of_peak) || !is_share(engine_.of_value) ||
        !is_share(engine_.of_peak))
      error("tolerance", fmt::format("tolerance '{}'; expected a share of the value and one of the "
                                     "peak, each from 0 to 1, such as 1e-3,1e-6",
                                     printable(attribute.value())));
  }

  std::vector<std::string> arguments(const char* attribute) {
    try {
      std::vector<std::string> list = arguments_of(node_.attribute(attribute).value());
      if (list.size() <= kMostArguments) return list;
      error(attribute, fmt::format("{} arguments; allowed: {}", list.size(), kMostArguments));
    } catch (const std::runtime_error& problem) {
      error(attribute, problem.what());
    }
    return {};
  }

  void require_places() {
    if (engine_.command.empty()) return;
    const std::string all = fmt::format("{}", fmt::join(engine_.command, " "));
    if (all.find("{out}") == all.npos)
      error("command", "the command has no {out}, the place of the picture that it has to write");
    for (const std::string& argument : engine_.version_command)
      if (argument.find('{') != argument.npos)
        return error("version-command", "it has braces, and is the same for every cell");
  }

  void read_scene_form() {
    engine_.scene = node_.attribute("scene").as_string("lobelia");
    const std::vector<std::string_view> names = form_names();
    if (std::ranges::find(names, engine_.scene) == names.end())
      error("scene", fmt::format("form of scene '{}'; allowed: {}{}", printable(engine_.scene),
                                 join(names), did_you_mean(engine_.scene, names)));
  }

  void read_effects() {
    const auto attribute = node_.attribute("effects");
    if (!attribute) return;
    constexpr auto kNames =
        map_types<std::string_view>(Effects{}, []<class Effect>() { return Effect::kName; });
    engine_.effects.emplace();
    for (const std::string& name : split(attribute.value(), ",")) {
      if (std::ranges::find(kNames, name) == kNames.end())
        return error("effects", fmt::format("unknown effect '{}'; allowed: {}{}", printable(name),
                                            join(kNames), did_you_mean(name, kNames)));
      engine_.effects->push_back(name);
    }
  }

  void read_environment() {
    for (const std::string& name : split(node_.attribute("environment").value(), ", ")) {
      const bool is_name = std::ranges::all_of(name, [](unsigned char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_';
      });
      if (!is_name)
        return error("environment",
                     fmt::format("'{}' is no name of an environment variable", printable(name)));
      engine_.environment.push_back(name);
    }
  }

  XmlSource& source_;
  const pugi::xml_node node_;
  OutsideEngine engine_;
  bool ok_ = true;
};

}  // namespace

std::span<const XmlElement> outside_elements() {
  constexpr std::string_view none = "none";
  static const XmlAttribute name = text("name", "", "of its files: small letters, digits, _"),
                            title = text("title", "the name", "of its column"),
                            tolerance = text("tolerance", "1e-3, 1e-6",
                                             "a share of each value, and a share of the peak");
  static const std::vector<XmlElement> elements{
      {"engine",
       "an engine to compare with: one that Lobelia knows, by its name, or your own",
       {name,
        title,
        text("command", none, "program and arguments, with {scene} and {out}"),
        text("version-command", none, "prints the version on its first line"),
        {{"scene", ParameterType::kString, "lobelia", 0, 0, "", "the form of the scene's file"},
         form_names()},
        tolerance,
        text("effects", "all", "the effects of light that it can show"),
        text("environment", none, "names of environment variables that it gets")}},
      {"pictures",
       "pictures that are there already",
       {name, title, text("files", "", "their paths; {axis} is the cell's value"), tolerance}},
  };
  return elements;
}

bool is_outside_engine(pugi::xml_node node) { return bool(node.attribute("command")); }

std::optional<records::OutsideEngine> read_outside_engine(XmlSource& source, pugi::xml_node node,
                                                          const fs::path& directory) {
  return Reader(source, node, directory).read();
}

records::OutsideEngine read_engine_file(const fs::path& path) {
  constexpr std::size_t kMostBytes = 1 << 20;
  const InputFile file(path);
  XmlSource source(read_file(file, kMostBytes), path.string(), kMostBytes);
  const pugi::xml_node root = source.root();
  std::optional<records::OutsideEngine> engine;
  if (std::string_view(root.name()) == "engine")
    engine = read_outside_engine(source, root, file.real_path().parent_path());
  else
    source.error(root, fmt::format("the root element is <{}>; an engine file is one <engine>",
                                   printable(root.name())));
  source.throw_if_errors();
  if (!engine) throw Error(ExitCode::kInput, "{}: describes no engine", path.string());
  return *engine;
}

std::string filled_in(std::string_view text,
                      const std::function<std::string(std::string_view name)>& value_of) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c != '{' && c != '}') {
      result += c;
    } else if (text.substr(i + 1).starts_with(c)) {
      result += c;
      ++i;
    } else {
      const std::size_t end = text.find('}', i);
      if (c == '}' || end == text.npos)
        throw std::runtime_error(fmt::format(
            "'{}' has a brace without its other; {{{{ stands for a brace", printable(text, 200)));
      result += value_of(text.substr(i + 1, end - i - 1));
      i = end;
    }
  }
  return result;
}

std::vector<std::string> arguments_of(std::string_view line) {
  std::vector<std::string> arguments;
  bool in_argument = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      in_argument = false;
      continue;
    }
    if (!in_argument) arguments.emplace_back();
    in_argument = true;
    if (c != '"' && c != '\'') {
      arguments.back() += c;
      continue;
    }
    const std::size_t end = line.find(c, i + 1);
    if (end == line.npos)
      throw std::runtime_error(fmt::format("the quotation mark {} is not closed", c));
    arguments.back() += line.substr(i + 1, end - i - 1);
    i = end;
  }
  constexpr std::string_view kOfShells[] = {"|", "||", "&", "&&", ";", ">", ">>", "<", "2>&1"};
  for (const std::string& argument : arguments)
    if (std::ranges::find(kOfShells, argument) != std::end(kOfShells))
      throw std::runtime_error(fmt::format(
          "'{}' means something to a shell, and no shell reads it; write a script", argument));
  return arguments;
}

}  // namespace lobelia

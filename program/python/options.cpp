#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "program/python/module.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::python {
namespace {

/// A number of Python or numpy. An array has the methods of one, too.
bool is_number(const py::handle& value) {
  return PyNumber_Check(value.ptr()) != 0 && !py::isinstance<py::bool_>(value) &&
         !py::isinstance<py::array>(value);
}

/// The texts of one option: of a list one for each, but numbers become one text. True has none; None and
/// False are not given.
std::optional<std::vector<std::string>> texts_of(const py::handle& value) {
  if (value.is_none()) return std::nullopt;
  if (py::isinstance<py::bool_>(value))
    return value.cast<bool>() ? std::optional(std::vector<std::string>()) : std::nullopt;
  if (py::isinstance<py::array>(value) && value.attr("ndim").cast<int>() == 1)
    return texts_of(value.attr("tolist")());
  if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value))
    return std::vector{path_of(py::reinterpret_borrow<py::object>(value))};
  std::vector<std::string> texts;
  bool are_numbers = true;
  for (const py::handle one : value) {
    if (one.is_none()) continue;
    are_numbers = are_numbers && is_number(one);
    texts.push_back(path_of(py::reinterpret_borrow<py::object>(one)));
  }
  if (texts.empty()) return std::nullopt;
  if (are_numbers) texts = {fmt::format("{}", fmt::join(texts, ","))};
  return texts;
}

}  // namespace

bool is_path(const py::object& object) {
  return py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__");
}

std::string path_of(const py::object& path) {
  // Bytes, because a file's name need not be UTF-8.
  return py::bytes(is_path(path) ? py::module_::import("os").attr("fsencode")(path)
                                 : py::str(path).attr("encode")());
}

void parse_options(const py::dict& options, const std::function<void(CLI::App&)>& add) {
  CLI::App app;
  app.set_help_flag();
  add(app);
  std::vector<std::string> words;
  for (const auto& [key, value] : options) {
    std::string name = py::str(key);
    std::ranges::replace(name, '_', '-');
    if (!app.get_option_no_throw("--" + name)) {
      std::vector<std::string> known;
      for (const CLI::Option* option : app.get_options()) {
        std::string text = option->get_single_name();
        std::ranges::replace(text, '-', '_');
        known.push_back(text);
      }
      const std::vector<std::string_view> names(known.begin(), known.end());
      throw Error(ExitCode::kUsage, "option '{}' is unknown; allowed: {}{}",
                  printable(std::string(py::str(key))), join(names),
                  did_you_mean(std::string(py::str(key)), names));
    }
    const auto texts = texts_of(value);
    if (texts && texts->empty()) words.push_back("--" + name);
    // With '=', so that a negative number is no option.
    if (texts)
      for (const std::string& text : *texts) words.push_back(fmt::format("--{}={}", name, text));
  }
  std::ranges::reverse(words);  // as CLI11 takes them
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    throw Error(ExitCode::kUsage, error.what());
  }
}

std::vector<GivenOption> given_options(const py::dict& options) {
  std::vector<GivenOption> given;
  for (const auto& [key, value] : options)
    given.push_back({std::string(py::str(key)), texts_of(value)});
  return given;
}

Scene scene_of(const py::object& scene) {
  if (!is_path(scene))
    throw Error(ExitCode::kUsage, "a scene is a path, a text of XML, or a dict with both");
  const std::string text = path_of(scene);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != text.npos && text[first] == '<') return parse_scene(text, "scene", ".");
  return read_scene(text);
}

std::vector<std::string> warnings_of(const Scene& scene) {
  std::vector<std::string> lines;
  for (const Material& material : scene.materials)
    if (std::string line = warning(material.highlight);
        !line.empty() && std::ranges::count(lines, line) == 0)
      lines.push_back(std::move(line));
  for (const std::string& line : remarks(scene)) lines.push_back(line);
  return lines;
}

}  // namespace lobelia::python

// Only an engine's own folder knows its name and starts it, and only the files of renderer/scene/lights/ ask which light a
// light is: a new one is its folder or file, and a line of the catalogue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"

namespace house {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The names and titles that the files of engines give them.
std::vector<std::string> names_of_engines(const fs::path& root) {
  static const std::regex name(R"re(\.(name|title|transport) = "([^"]+)")re");
  std::vector<std::string> names;
  for (const fs::path& file : project_files(root)) {
    if (!file.generic_string().starts_with("reference_scenes/engines/") || !is_cpp(file)) continue;
    const std::string text = read(root / file);
    for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it)
      names.push_back((*it)[2]);
  }
  return names;
}

/// Outside of the engines' folders: a text that is an engine's name, and what starts an engine.
std::vector<std::string> knowledge_of_engines(const fs::path& root) {
  static const std::regex text(R"re("([^"\\]+)")re"),
      start(R"re(\b(run_engine|probe_engine|engine_environment|open_simple|ProgramEngine)\b)re");
  const std::vector<std::string> names = names_of_engines(root);
  std::vector<std::string> found;
  for (const fs::path& file : project_files(root)) {
    const std::string name = file.generic_string(), room = file.begin()->string();
    // Tests and benchmarks say which engine they mean; a shading language and a record's word have the same name; the
    // fuzzed programs have engines of their own.
    if (!is_cpp(file) || room == "tests" || room == "bench" || room == "shaders" ||
        room == "records" || room == "fuzz" || name.starts_with("reference_scenes/engines/"))
      continue;
    // What all engines share.
    const bool shared = room == "reference_scenes" && file.parent_path() == "reference_scenes";
    std::size_t number = 0;
    for (const std::string& line : lines(read(root / file))) {
      ++number;
      if (std::smatch match; !shared && std::regex_search(line, match, start))
        found.push_back(place(file, number) + match.str());
      if (line.find_first_not_of(' ') == line.find("//")) continue;
      const std::string code = line.substr(0, line.find(" //"));
      for (std::sregex_iterator it(code.begin(), code.end(), text), end; it != end; ++it)
        if (std::ranges::find(names, (*it)[1].str()) != names.end())
          found.push_back(place(file, number) + it->str());
    }
  }
  return found;
}

TEST(Engines, are_known_to_their_own_folders_only) {
  EXPECT_GE(names_of_engines(LOBELIA_SOURCE_DIR).size(), 6u);
  EXPECT_THAT(knowledge_of_engines(LOBELIA_SOURCE_DIR), IsEmpty());
}

TEST(Engines, that_others_name_or_start_are_found) {
  Scratch tree;
  write(
      tree / "reference_scenes/engines/tracer/tracer.hpp",
      ".name = \"tracer\",\n.title = \"The Tracer\",\nrun_engine(kInfo);\nif (x == \"tracer\") f();\n");
  write(tree / "reference_scenes/engine_program.cpp", "Failure run_engine(a);\n");
  write(tree / "tests/a.cpp", "make_engine(\"tracer\", {});\n");
  write(tree / "cli/a.cpp",
        "// the \"tracer\"\nf(\"--engine tracer\");  // \"tracer\"\nrun_engines(x);\n");
  ASSERT_THAT(knowledge_of_engines(tree.path()), IsEmpty());

  write(tree / "farm/b.cpp", "if (engine == \"tracer\") return 1;\n");
  write(tree / "gallery/b.cpp", "\nf(\"x\", \"The Tracer\");\n");
  write(tree / "reference_scenes/session.cpp", "f(\"tracer\");\n");
  write(tree / "compare/b.cpp", "lobelia::run_engine(a);\nprobe_engine(b);\n");
  EXPECT_THAT(knowledge_of_engines(tree.path()),
              ElementsAre("compare/b.cpp:1: run_engine", "compare/b.cpp:2: probe_engine",
                          "farm/b.cpp:1: \"tracer\"", "gallery/b.cpp:2: \"The Tracer\"",
                          "reference_scenes/session.cpp:1: \"tracer\""));
}

/// The arguments of a call, from behind its bracket.
std::string arguments(const std::string& text, std::size_t begin) {
  int depth = 1;
  std::size_t end = begin;
  for (; end < text.size() && depth > 0; ++end) depth += (text[end] == '(') - (text[end] == ')');
  return text.substr(begin, end - begin);
}

/// Places that ask for the type of a light. Tests may: they say what a reader has read.
std::vector<std::string> questions_of_type(const fs::path& root) {
  static const std::regex by_type(
      R"re(\b(get|get_if|holds_alternative)\s*<\s*(const\s+)?(\w+::)*\w*Light\s*>|)re"
      R"re(\binfo\([^()]*\)\.type\s*[!=]=)re");
  static const std::regex by_visit(R"re(\bvisit\s*\()re"),
      of_light(R"re((\b|_)[lL]ights?(\b|_))re");
  std::vector<std::string> found;
  for (const fs::path& file : project_files(root)) {
    const std::string name = file.generic_string();
    if (!is_cpp(file) || name.starts_with("renderer/scene/lights/") || *file.begin() == "tests")
      continue;
    const std::string text = read(root / file);
    const auto note = [&](const std::smatch& match) {
      const auto line = 1 + std::count(text.begin(), match[0].first, '\n');
      found.push_back(name + ":" + std::to_string(line) + ": " + match.str());
    };
    for (std::sregex_iterator it(text.begin(), text.end(), by_type), end; it != end; ++it)
      note(*it);
    for (std::sregex_iterator it(text.begin(), text.end(), by_visit), end; it != end; ++it)
      if (std::regex_search(arguments(text, std::size_t(it->position() + it->length())), of_light))
        note(*it);
  }
  return found;
}

TEST(Lights, only_their_own_files_ask_which_light_it_is) {
  EXPECT_THAT(questions_of_type(LOBELIA_SOURCE_DIR), IsEmpty());
}

TEST(Lights, every_way_to_ask_is_found) {
  Scratch tree;
  write(tree / "renderer/scene/lights/disc.hpp", "std::get_if<DiscLight>(&light);\n");
  write(tree / "tests/a.cpp", "std::get<DiscLight>(light);\n");
  write(tree / "farm/a.cpp",
        "Light l = DiscLight{};\nstd::get<Vec3>(value_of(light, name));\n"
        "std::visit(Print{}, highlight);\nf(light);\nif (format.type == x) return;\n");
  ASSERT_THAT(questions_of_type(tree.path()), IsEmpty());

  write(tree / "bench/b.cpp", "\nauto& l = std::get< lobelia::DiscLight >(light);\n");
  write(tree / "compare/b.cpp", "if (get_if<const SphereLight>(&light)) return;\n");
  write(tree / "studies/b.hpp", "std::holds_alternative<PointLight>(l);\n");
  write(tree / "fuzz/b.cpp", "std::visit(\n    [](const auto& l) { return f(l); },\n    light);\n");
  write(tree / "cli/b.cpp",
        "visit(Print{}, scene.lights[0]);\nif (info(l).type != \"disc\") f();\n");
  EXPECT_THAT(questions_of_type(tree.path()),
              ElementsAre("bench/b.cpp:2: get< lobelia::DiscLight >",
                          "cli/b.cpp:2: info(l).type !=", "cli/b.cpp:1: visit(",
                          "compare/b.cpp:1: get_if<const SphereLight>", "fuzz/b.cpp:1: visit(",
                          "studies/b.hpp:1: holds_alternative<PointLight>"));
}

}  // namespace
}  // namespace house

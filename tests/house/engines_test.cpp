// Only an engine's own folder knows its name and starts it, so that a new one is its folder and a line of the catalogue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

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

}  // namespace
}  // namespace house

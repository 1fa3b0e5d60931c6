// Only the files of renderer/scene/lights/ ask which light a light is, so that a new one is its file and a line of
// their catalogue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"

namespace house {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

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

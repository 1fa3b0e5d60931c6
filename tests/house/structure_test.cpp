// Rules of the house that no compiler checks. Each check is a function of a tree and returns what
// is wrong with it.
#include <regex>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"
#include "tests/test.hpp"

namespace house {
namespace {

using Problems = std::vector<std::string>;

// ---- arrows between rooms

/// The rooms that each room may see besides itself. tests/ may see everything.
const std::map<std::string, std::set<std::string>> kMaySee = {
    {"base", {}},
    {"renderer", {"base"}},
    {"profile", {"base"}},
    {"compare", {"base", "profile"}},
    {"reference_scenes", {"base", "renderer"}},
    {"farm", {"base", "renderer", "profile", "compare", "reference_scenes"}},
    {"studies", {"base", "renderer", "profile", "compare", "reference_scenes"}},
    {"shader_check", {"base", "renderer", "compare", "studies"}},
    {"gallery", {"base"}},
    {"program",
     {"base", "renderer", "profile", "compare", "reference_scenes", "farm", "studies",
      "shader_check", "gallery"}},
};

/// The room of a file or a folder of sources.
std::string room_of(const fs::path& path) {
  return path.generic_string().starts_with("studies/shader_check/") ? "shader_check"
                                                                    : path.begin()->string();
}

/// The room of one of our CMake targets.
std::string room_of_target(const std::string& target) {
  static const std::map<std::string, std::string> others{
      {"accuracy", "studies"},          {"api", "program"},
      {"command", "program"},           {"export", "renderer"},
      {"formulas", "reference_scenes"}, {"python", "program"}};
  const auto found = others.find(target);
  return found == others.end() ? target : found->second;
}

/// Who alone may include a heavy library.
bool may_include_library(const std::string& header, const std::string& file) {
  if (header.starts_with("OpenImageIO/")) return file.starts_with("base/pictures/image_io_module");
  if (header.starts_with("OpenColorIO/")) return file == "base/pictures/colour_module.cpp";
  for (const char* of_program : {"CLI/", "pybind11/"})
    if (header.starts_with(of_program))
      return file.starts_with("program/") || file.starts_with("tests/");
  for (const char* graphics : {"EGL/", "GL/", "vulkan/"})
    if (header.starts_with(graphics))
      return file.starts_with("studies/shader_check/runner/") ||
             file == "reference_scenes/engines/opengl/engine_opengl.cpp";
  return true;
}

Problems forbidden_arrows(const fs::path& root) {
  static const std::regex include(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  static const std::regex link(R"re(\blobelia(?:::|_)([a-z_]+))re");
  static const std::regex tests_and_examples("^(tests|docs)/.*");
  Problems problems;
  const auto check = [&](const fs::path& file, std::size_t line, const std::string& target) {
    const std::string room = room_of(file);
    if (room == target || !kMaySee.contains(target)) return;
    if (!kMaySee.at(room).contains(target))
      problems.push_back(place(file, line) + room + " may not see " + target);
  };
  for (const fs::path& file : project_files(root)) {
    const std::string name = file.generic_string(), room = room_of(file);
    const bool free = std::regex_match(name, tests_and_examples);
    const bool cmake = file.filename() == "CMakeLists.txt" && kMaySee.contains(room);
    if (!is_cpp(file) && !cmake) continue;
    if (!free && !kMaySee.contains(room)) {
      problems.push_back(name + ": " + room + " is no room that kMaySee of this test knows");
      continue;
    }
    std::size_t number = 0;
    for (const std::string& line : lines(read(root / file))) {
      ++number;
      std::smatch match;
      if (cmake) {
        for (std::sregex_iterator it(line.begin(), line.end(), link), end; it != end; ++it)
          check(file, number, room_of_target((*it)[1]));
        continue;
      }
      if (!std::regex_search(line, match, include)) continue;
      std::string header = match[1];
      if (header.starts_with("."))
        header = (file.parent_path() / header).lexically_normal().generic_string();
      if (!may_include_library(header, name))
        problems.push_back(place(file, number) + "may not include " + header);
      if (!free) check(file, number, room_of(header));
    }
  }
  return problems;
}

TEST(Rooms, HaveArrowsThatPointDownOnly) { EXPECT_THAT(forbidden_arrows(kRoot), IsEmpty()); }

TEST(Rooms, ShowEveryKindOfForbiddenArrow) {
  Scratch tree;
  write(tree / "base/up.hpp", "\n#include \"renderer/highlight.hpp\"\n");
  write(tree / "farm/CMakeLists.txt", "lobelia_room(farm LINK lobelia::core lobelia::gallery)\n");
  write(tree / "compare/read.cpp", "#include <OpenImageIO/imageio.h>\n");
  write(tree / "attic/new_room.cpp", "int x;\n");
  EXPECT_THAT(forbidden_arrows(tree.path()),
              ElementsAre("attic/new_room.cpp: attic is no room that kMaySee of this test knows",
                          "base/up.hpp:2: base may not see renderer",
                          "compare/read.cpp:1: may not include OpenImageIO/imageio.h",
                          "farm/CMakeLists.txt:1: farm may not see gallery"));
}

// ---- lines that may not stand anywhere

/// Lines of files that `applies` admits which match `pattern`.
template <class Applies>
Problems lines_with(const fs::path& root, const std::regex& pattern, Applies applies) {
  Problems problems;
  for (const fs::path& file : project_files(root)) {
    if (!applies(file)) continue;
    std::size_t number = 0;
    for (const std::string& line : lines(read(root / file))) {
      ++number;
      std::smatch match;
      if (std::regex_search(line, match, pattern))
        problems.push_back(place(file, number) + match.str());
    }
  }
  return problems;
}

Problems paths_of_a_machine(const fs::path& root) {
  // Spelled so that this file does not match itself. A path inside a URL is none of a machine.
  static const std::regex pattern("(^|[^A-Za-z0-9_.~-])/(w[o]rk|h[o]me|r[o]ot|U[s]ers)/");
  return lines_with(root, pattern, [](const fs::path&) { return true; });
}

/// Keys of JSON outside of base/records/: by the library, in the text of a string, or in a table.
Problems loose_keys(const fs::path& root) {
  static const std::regex pattern(R"re(#\s*include\s*<nlohmann/|\\"[A-Za-z_]+\\"\s*:|\bdefine<)re");
  return lines_with(root, pattern, [](const fs::path& file) {
    const std::string name = file.generic_string();
    if (!is_cpp(file) || name.starts_with("base/records/") || !kMaySee.contains(room_of(file)))
      return false;
    // The JSON for Blender's script and for a browser's page belongs to these engines.
    return !name.starts_with("reference_scenes/engines/blender/blender.") &&
           name != "reference_scenes/engines/browser/engine_browser.cpp";
  });
}

TEST(Records, AloneSpellTheirKeys) { EXPECT_THAT(loose_keys(kRoot), IsEmpty()); }

TEST(Records, ShowKeysThatAreSpeltElsewhere) {
  Scratch tree;
  write(tree / "farm/a.cpp", "#include <nlohmann/json.hpp>\ntext = \"{\\\"name\\\": 1}\";\n");
  EXPECT_EQ(loose_keys(tree.path()).size(), 2u);
}

/// Sources that are not generated and that nobody reads at one sitting.
Problems long_files(const fs::path& root) {
  constexpr int kMostLines = 500;
  static const std::set<std::string> written = {".cpp", ".hpp", ".ts", ".mjs", ".css", ".py"};
  Problems problems;
  for (const fs::path& file : project_files(root)) {
    const bool bundled = file.parent_path() == "gallery/web/dist";
    if (bundled || !written.contains(file.extension().string())) continue;
    const std::string text = read(root / file);
    const auto count = std::count(text.begin(), text.end(), '\n');
    if (count > kMostLines)
      problems.push_back(file.generic_string() + ": " + std::to_string(count) + " lines");
  }
  return problems;
}

TEST(Files, HaveAtMost500Lines) { EXPECT_THAT(long_files(kRoot), IsEmpty()); }

TEST(Words, NameNoPathOfADevelopersMachine) { EXPECT_THAT(paths_of_a_machine(kRoot), IsEmpty()); }

// ---- what the pages promise

/// The targets of make that a page names, in a line or a span of code.
std::set<std::string> named_targets(const std::string& page) {
  static const std::regex command("(?:^ *|`)make ([a-z][a-z_-]*)");
  std::set<std::string> result;
  for (const std::string& line : lines(page))
    for (std::sregex_iterator it(line.begin(), line.end(), command), end; it != end; ++it)
      result.insert((*it)[1]);
  return result;
}

std::set<std::string> make_targets(const std::string& makefile) {
  std::set<std::string> result;
  static const std::regex target("^([a-z][a-z_-]*):");
  std::smatch match;
  for (const std::string& line : lines(makefile))
    if (std::regex_search(line, match, target)) result.insert(match[1]);
  return result;
}

const std::vector<std::string> kPages = {"README.md", "CONTRIBUTING.md"};

TEST(Pages, NameOnlyTargetsOfMake) {
  const auto targets = make_targets(read(kRoot / "Makefile"));
  for (const std::string& page : kPages)
    for (const std::string& target : named_targets(read(kRoot / page)))
      EXPECT_TRUE(targets.contains(target)) << page << " says make " << target;
  const auto promised = named_targets(read(kRoot / "README.md"));
  for (const char* target : {"gallery", "test", "build", "bench", "lint", "clean"})
    EXPECT_TRUE(promised.contains(target)) << "README.md does not mention make " << target;
}

}  // namespace
}  // namespace house

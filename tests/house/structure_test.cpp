// Rules of the house that no compiler checks. Each check is a function of a tree and returns what
// is wrong with it, and each is shown to fail on a small tree made for that.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"

namespace house {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Problems = std::vector<std::string>;

// ---- arrows between rooms

/// What each room may see besides itself. tests, bench and fuzz may see everything.
const std::map<std::string, std::set<std::string>> kMaySee = {
    {"core", {}},
    {"records", {"core"}},
    {"renderer", {"core", "records"}},
    {"compare", {"core", "records"}},
    {"shaders", {"core", "renderer"}},
    {"reference_scenes", {"core", "records", "renderer", "shaders"}},
    {"accuracy", {"core", "records", "renderer", "compare", "reference_scenes"}},
    {"farm", {"core", "records", "renderer", "compare", "reference_scenes"}},
    {"studies",
     {"core", "records", "renderer", "shaders", "compare", "reference_scenes", "accuracy"}},
    {"gallery", {"core", "records"}},
    {"include", {}},
    {"library", {"core", "records", "renderer", "compare", "include"}},
    {"cli",
     {"core", "records", "renderer", "shaders", "compare", "reference_scenes", "accuracy", "farm",
      "studies", "gallery"}},
    {"python",
     {"core", "records", "renderer", "shaders", "compare", "reference_scenes", "accuracy", "farm",
      "studies", "gallery", "cli"}},
};

/// Who alone may include a heavy library.
bool may_include_library(const std::string& header, const std::string& file) {
  if (header.starts_with("OpenImageIO/")) return file.starts_with("core/image_io_module");
  if (header.starts_with("OpenColorIO/")) return file == "core/colour_module.cpp";
  for (const char* graphics : {"EGL/", "GL/", "vulkan/"})
    if (header.starts_with(graphics))
      return file.starts_with("shaders/runner/") ||
             file == "reference_scenes/engines/opengl/engine_opengl.cpp";
  return true;
}

Problems forbidden_arrows(const fs::path& root) {
  static const std::regex include(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  static const std::regex link(R"re(\blobelia(?:::|_)([a-z_]+))re");
  static const std::regex tests_and_bench("^(tests|bench|fuzz|examples)/.*");
  Problems problems;
  const auto check = [&](const fs::path& file, std::size_t line, const std::string& target) {
    const std::string room = file.begin()->string();
    if (room == target || !kMaySee.contains(target)) return;
    if (!kMaySee.at(room).contains(target))
      problems.push_back(place(file, line) + room + " may not see " + target);
  };
  for (const fs::path& file : project_files(root)) {
    const std::string name = file.generic_string(), room = file.begin()->string();
    const bool free = std::regex_match(name, tests_and_bench);
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
          check(file, number, (*it)[1]);
        continue;
      }
      if (!std::regex_search(line, match, include)) continue;
      std::string header = match[1];
      if (header.starts_with("."))
        header = (file.parent_path() / header).lexically_normal().generic_string();
      if (!may_include_library(header, name))
        problems.push_back(place(file, number) + "may not include " + header);
      if (!free) check(file, number, fs::path(header).begin()->string());
    }
  }
  return problems;
}

TEST(Rooms, arrows_between_rooms_point_down_only) {
  EXPECT_THAT(forbidden_arrows(kRoot), IsEmpty());
}

TEST(Rooms, every_kind_of_forbidden_arrow_is_found) {
  Scratch tree;
  write(tree / "core/a.cpp", "#include \"core/a.hpp\"\n#include <vector>\n");        // fine
  write(tree / "renderer/a.cpp", "#include \"core/a.hpp\"\n#include \"a.hpp\"\n");   // fine
  write(tree / "tests/core/a.cpp", "#include \"cli/commands.hpp\"\n");               // fine
  write(tree / "core/colour_module.cpp", "#include <OpenColorIO/OpenColorIO.h>\n");  // fine
  write(tree / "build/core/a.cpp", "#include \"cli/made.hpp\"\n");  // made, not ours
  write(tree / "cli/CMakeLists.txt", "target_link_libraries(lobelia PRIVATE lobelia::farm)\n");
  ASSERT_THAT(forbidden_arrows(tree.path()), IsEmpty());

  write(tree / "core/up.hpp", "\n#include \"renderer/highlight.hpp\"\n");
  write(tree / "compare/sideways.cpp", "#  include <renderer/render.hpp>\n");
  write(tree / "renderer/plan/dots.cpp", "#include \"../../compare/verdict.hpp\"\n");
  write(tree / "gallery/deep.cpp", "#include \"farm/farm.hpp\"\n");
  write(tree / "farm/CMakeLists.txt",
        "lobelia_room(farm SOURCES a.cpp LINK lobelia::core lobelia::gallery)\n");
  write(tree / "compare/read.cpp", "#include <OpenImageIO/imageio.h>\n");
  write(tree / "tests/core/ocio.cpp", "#include <OpenColorIO/OpenColorIO.h>\n");
  write(tree / "attic/new_room.cpp", "int x;\n");
  EXPECT_THAT(forbidden_arrows(tree.path()),
              ElementsAre("attic/new_room.cpp: attic is no room that kMaySee of this test knows",
                          "compare/read.cpp:1: may not include OpenImageIO/imageio.h",
                          "compare/sideways.cpp:1: compare may not see renderer",
                          "core/up.hpp:2: core may not see renderer",
                          "farm/CMakeLists.txt:1: farm may not see gallery",
                          "gallery/deep.cpp:1: gallery may not see farm",
                          "renderer/plan/dots.cpp:1: renderer may not see compare",
                          "tests/core/ocio.cpp:1: may not include OpenColorIO/OpenColorIO.h"));
}

// ---- words that may not stand anywhere

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

Problems loose_arithmetic(const fs::path& root) {
  static const std::regex pattern(
      "-ffast-"
      "math|-O"
      "fast|-funsafe-"
      "math|-fassociative-"
      "math|#\\s*pragma\\s+STD"
      "C|"
      "#\\s*pragma\\s+GCC\\s+opti"
      "mize|__attribute__\\s*\\(\\(\\s*opti"
      "mize");
  return lines_with(root, pattern, [](const fs::path& file) {
    // Pages may say that we do without.
    return file.extension() != ".md";
  });
}

/// Writing to stderr by what throws, or sets a stream's state, where it is closed or full.
Problems stderr_by_hand(const fs::path& root) {
  static const std::regex pattern(R"((^|[(,])\s*stderr\s*[,)]|std::c(err|log)\b|\bperror\()");
  return lines_with(root, pattern, [](const fs::path& file) {
    // The rooms alone. The programs beside engines do not link core/; tsan_tbb.cpp is before main().
    const std::string name = file.generic_string();
    return is_cpp(file) && kMaySee.contains(file.begin()->string()) &&
           name != "reference_scenes/engines/programs/scene_program.cpp" &&
           name != "reference_scenes/engines/browser/engine_browser.cpp" &&
           name != "core/tsan_tbb.cpp";
  });
}

/// Keys of JSON outside of records/: by the library, in the text of a string, or in a table.
Problems loose_keys(const fs::path& root) {
  static const std::regex pattern(R"re(#\s*include\s*<nlohmann/|\\"[A-Za-z_]+\\"\s*:|\bdefine<)re");
  return lines_with(root, pattern, [](const fs::path& file) {
    const std::string room = file.begin()->string(), name = file.generic_string();
    if (!is_cpp(file) || room == "records" || !kMaySee.contains(room)) return false;
    // The JSON for Blender's script and for a browser's page belongs to these engines.
    return !name.starts_with("reference_scenes/engines/blender/blender_input") &&
           name != "reference_scenes/engines/browser/engine_browser.cpp";
  });
}

TEST(Records, alone_spell_their_keys) { EXPECT_THAT(loose_keys(kRoot), IsEmpty()); }

TEST(Records, keys_that_others_spell_are_found) {
  Scratch tree;
  write(tree / "records/a.cpp", "#include <nlohmann/json.hpp>\nreturn define<A>(\"A part.\");\n");
  write(tree / "tests/a.cpp", "#include <nlohmann/json.hpp>\n");
  write(tree / "farm/a.cpp", "record.status = \"pass\";\nfmt::print(\"\\\"{}\\\": x\", y);\n");
  ASSERT_THAT(loose_keys(tree.path()), IsEmpty());
  write(
      tree / "farm/b.cpp",
      "#include <nlohmann/json_fwd.hpp>\ntext += \"\\\"status\\\": \";\nreturn define<A>(\"A part.\");\n");
  EXPECT_EQ(loose_keys(tree.path()).size(), 3u);
}

/// Whoever asks a cache for the result of a job, but in the one place that says what is missing.
Problems loose_looks_at_results(const fs::path& root) {
  static const std::regex pattern(R"(\b\w*cache\w*(\(\))?(\.|->)(find|has|list)\()");
  return lines_with(root, pattern, [](const fs::path& file) {
    const std::string name = file.generic_string();
    // Maintenance and explanations go by the keys that they find written down.
    return is_cpp(file) && kMaySee.contains(file.begin()->string()) &&
           name != "farm/job_states.cpp" && name != "farm/explain.cpp" &&
           !name.starts_with("farm/upkeep");
  });
}

TEST(Farm, job_states_alone_say_what_is_missing) {
  EXPECT_THAT(loose_looks_at_results(kRoot), IsEmpty());
}

TEST(Farm, others_that_say_what_is_missing_are_found) {
  Scratch tree;
  write(tree / "farm/job_states.cpp", "record = cache.find(graph[job].key, look);\n");
  write(tree / "farm/upkeep.cpp", "for (const ResultKey& key : cache.list()) {\n");
  write(tree / "tests/farm/a.cpp", "EXPECT_TRUE(cache.has(key));\n");
  write(tree / "farm/a.cpp", "cache.publish(draft, key, record);\ncache_names.size();\n");
  ASSERT_THAT(loose_looks_at_results(tree.path()), IsEmpty());
  write(tree / "farm/b.cpp",
        "if (cache.has(key)) return;\nsession.cache().find(key);\ncache_->list();\n"
        "const auto record = result_cache->find(graph[job].key);\n");
  EXPECT_EQ(loose_looks_at_results(tree.path()).size(), 4u);
}

/// Lines of studies that lay out a table themselves: as text, as CSV, as Markdown.
Problems tables_of_their_own(const fs::path& root) {
  static const std::regex pattern(R"re(csv_field|\|---|\{:<|\{:>?\{|<t[dhr]>)re");
  return lines_with(root, pattern, [](const fs::path& file) {
    return is_cpp(file) && *file.begin() == "studies" && file != "studies/table.cpp";
  });
}

TEST(Studies, are_rendered_by_the_one_table) { EXPECT_THAT(tables_of_their_own(kRoot), IsEmpty()); }

TEST(Studies, tables_of_their_own_are_found) {
  Scratch tree;
  write(tree / "studies/table.cpp", "text += csv_field(cell);\n");
  write(tree / "cli/models.cpp", "fmt::print(\"{:<24}{}\", name, title);\n");
  write(tree / "studies/cost/a.cpp", "fmt::format(\"{:.2f} ({})\", median, spread);\n");
  ASSERT_THAT(tables_of_their_own(tree.path()), IsEmpty());
  write(tree / "studies/paper/b.cpp",
        "text += fmt::format(\"{:<{}}\", word, width);\ntext += \"|---|\";\n"
        "line += csv_field(name) + \",\";\nfmt::format(\"{:>{}}\", value, 8);\n"
        "fmt::format(\"{:<20}\", name);\n");
  EXPECT_EQ(tables_of_their_own(tree.path()).size(), 5u);
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

TEST(Files, have_at_most_500_lines) { EXPECT_THAT(long_files(kRoot), IsEmpty()); }

TEST(Files, that_are_longer_are_found) {
  Scratch tree;
  std::string text;
  for (int i = 0; i < 500; ++i) text += "int x;\n";
  write(tree / "core/a.cpp", text);
  write(tree / "gallery/web/dist/gallery.css", text + text);
  ASSERT_THAT(long_files(tree.path()), IsEmpty());
  write(tree / "core/b.cpp", text + "int y;\n");
  write(tree / "gallery/web/src/b.ts", text + text);
  EXPECT_THAT(long_files(tree.path()),
              ElementsAre("core/b.cpp: 501 lines", "gallery/web/src/b.ts: 1000 lines"));
}

TEST(Words, no_file_names_a_path_of_a_developers_machine) {
  EXPECT_THAT(paths_of_a_machine(kRoot), IsEmpty());
}

TEST(Words, nothing_lets_the_compiler_change_the_arithmetic) {
  EXPECT_THAT(loose_arithmetic(kRoot), IsEmpty());
}

TEST(Words, messages_go_through_core_standard_streams) {
  EXPECT_THAT(stderr_by_hand(kRoot), IsEmpty());
}

TEST(Words, messages_that_do_not_are_found) {
  Scratch tree;
  write(tree / "cli/a.cpp", "say(\"stderr\");  // to stderr, and stderr alone\n");
  write(tree / "bench/a.cpp", "fmt::print(stderr, \"x\");\n");
  ASSERT_THAT(stderr_by_hand(tree.path()), IsEmpty());
  write(tree / "cli/b.cpp", "fmt::print(stderr, \"x\");\nfmt::print(\n    stderr,\n\"x\");\n");
  write(tree / "core/b.cpp", "std::fputs(\"x\", stderr);\nstd::cerr << 1;\nperror(\"x\");\n");
  EXPECT_EQ(stderr_by_hand(tree.path()).size(), 5u);
}

TEST(Words, forbidden_words_are_found) {
  Scratch tree;
  write(tree / "docs/a.md",
        "see https://example.org/ho"
        "me/x; we use no -ffast-"
        "math\n");
  ASSERT_THAT(paths_of_a_machine(tree.path()), IsEmpty());
  ASSERT_THAT(loose_arithmetic(tree.path()), IsEmpty());
  write(tree / "docs/b.md",
        "\ncd /ho"
        "me/me/x\n");
  write(tree / ".ci/run",
        "cd /wo"
        "rk/main\n");
  write(tree / "CMakeLists.txt",
        "add_compile_options(-ffast-"
        "math)\n");
  write(tree / "core/a.cpp",
        "#pragma STD"
        "C FP_CONTRACT ON\n");
  EXPECT_EQ(paths_of_a_machine(tree.path()).size(), 2u);
  EXPECT_EQ(loose_arithmetic(tree.path()).size(), 2u);
}

// ---- what the pages promise

/// Commands in a page: lines of ``` blocks, without a leading "$ ", and `...` spans.
std::vector<std::string> commands(const std::string& page) {
  std::vector<std::string> result;
  bool block = false;
  static const std::regex span("`([^`]+)`");
  for (std::string line : lines(page)) {
    if (line.starts_with("```")) {
      block = !block;
    } else if (block || line.starts_with("    ")) {
      line.erase(0, line.find_first_not_of(" $"));
      result.push_back(line);
    } else {
      for (std::sregex_iterator it(line.begin(), line.end(), span), end; it != end; ++it)
        result.push_back((*it)[1]);
    }
  }
  return result;
}

/// The words after `program` in its commands, up to the first that is no plain word.
std::set<std::string> words_after(const std::string& program, const std::string& page) {
  std::set<std::string> result;
  static const std::regex word("[a-z][a-z_-]*");
  for (const std::string& command : commands(page)) {
    std::istringstream in(command);
    std::string first, next;
    in >> first;
    if (first != program) continue;
    while (in >> next && std::regex_match(next, word)) {
      result.insert(next);
      if (program != "make") break;
    }
  }
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

TEST(Pages, commands_are_found_in_blocks_and_spans) {
  const std::string page =
      "Type `make gallery` or\n\n    make test PRESET=ci\n\n```\n$ lobelia render x\n```\n";
  EXPECT_THAT(words_after("make", page), ElementsAre("gallery", "test"));
  EXPECT_THAT(words_after("lobelia", page), ElementsAre("render"));
  EXPECT_THAT(make_targets("PRESET ?= x\nall: a ## b\n\tmake c:\n"), ElementsAre("all"));
}

TEST(Pages, every_make_command_is_a_target) {
  const auto targets = make_targets(read(kRoot / "Makefile"));
  for (const std::string& page : kPages)
    for (const std::string& target : words_after("make", read(kRoot / page)))
      EXPECT_TRUE(targets.contains(target)) << page << " says make " << target;
  const auto promised = words_after("make", read(kRoot / "README.md"));
  for (const char* target : {"gallery", "test", "build", "bench", "lint", "clean"})
    EXPECT_TRUE(promised.contains(target)) << "README.md does not mention make " << target;
}

TEST(Pages, every_lobelia_command_is_a_subcommand) {
  const auto subcommands = words_after("lobelia", read(kRoot / "README.md"));
  EXPECT_FALSE(subcommands.empty());
  Scratch scratch;
  for (const std::string& name : subcommands) {
    const fs::path help = scratch / "help";
    const std::string command = quoted(LOBELIA_PROGRAM) + " " + name + " --help > " + quoted(help);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    // An unknown word before --help gets the program's own help.
    EXPECT_THAT(read(help), HasSubstr("Usage: lobelia " + name + " "))
        << "README.md says lobelia " << name;
  }
}

TEST(Pages, ci_runs_only_what_the_readme_says) {
  const auto said = commands(read(kRoot / "README.md"));
  static const std::regex command("^ *(make .*)$");
  std::smatch match;
  int found = 0;
  for (const std::string& line : lines(read(kRoot / ".ci/run"))) {
    if (!std::regex_match(line, match, command)) continue;
    ++found;
    EXPECT_NE(std::find(said.begin(), said.end(), match[1].str()), said.end())
        << "README.md does not say: " << match[1];
  }
  EXPECT_EQ(found, 4);
}

}  // namespace
}  // namespace house

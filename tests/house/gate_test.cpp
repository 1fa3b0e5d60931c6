// base/system/leave.hpp is the gate for what files of others say. Whoever gives leave, or opens a file where names may
// come from such a file, is in a list here, with the reason why it needs no gate or has passed it. security_test.cpp holds who
// starts programs.
#include <regex>

#include "tests/house/tree.hpp"
#include "tests/test.hpp"

namespace house {
namespace {

using Problems = std::vector<std::string>;

/// The lines by which a file may pass the gate.
struct Allowed {
  std::string file, because;
  std::vector<std::string> code;  ///< a part of each line, in their order
};

const std::vector<Allowed>& allowed_places() {
  static const std::vector<Allowed> all{
      {"farm/axes.cpp",
       "a scene may be any file; it is told from others by its first element",
       {"read_scene(directory / text)"}},
      {"farm/cache_layout.cpp", "the marker of a cache", {"std::ifstream stream(file)"}},
      {"farm/cell_directory.cpp", "what the farm wrote", {"read_file(cached, ", "kCellRecordFile"}},
      {"farm/chunk.cpp",
       "the chunk itself; what it asks for passes the gate",
       {"const InputFile opened(file)", "read_file(opened, "}},
      {"farm/explain.cpp",
       "what the farm wrote",
       {"read_file(directory_ / \"scene.xml\"", "kCellRecordFile"}},
      {"farm/farm_engines.cpp", "the farm's own farm.json", {"read_file(file, "}},
      {"farm/grid_reader.cpp",
       "the grid itself, and its scene, which may be any file",
       {"read_scene(directory_ / file)", "const InputFile file(path)",
        "read_file(file, kMaxGridBytes)"}},
      {"farm/group_flush.cpp",
       "files and folders that were just written",
       {"directory(::open(path.c_str()", "file(::open(path.c_str()"}},
      {"farm/result_cache.cpp",
       "files of the cache, by names of ours",
       {"sha256_of_file(path)", "sha256_of_file(file)", "kManifestFile", "failure_file(key",
        "\"contents\""}},
      {"farm/slurm/doctor.cpp",
       "its own directory, and /bin/true",
       {"\"renamed\"", "kAnswer", "kToken"}},
      {"farm/slurm/element_request.hpp", "logs, by names of ours", {"O_NOFOLLOW"}},
      {"farm/slurm/run_parts.hpp",
       "the record of the run, by a name of ours",
       {"records::SlurmRun>(path)"}},
      {"farm/slurm/slurm_farm.cpp",
       "the run's record; what it asks for passes the gate",
       {"InputFile file(slurm_run_directory(directory)", "read_file(file, "}},
      {"farm/upkeep.cpp",
       "what the farm wrote",
       {"read_file(file, ", "sha256_of_file(cell.path()", "records::Cell>(file)"}},
      {"base/records/farm_file.cpp", "the farm's own farm.json", {"read_file(path, "}},
      {"base/records/project.cpp", "a project that the user names", {"read_file(path, "}},
      {"base/records/record.hpp", "is how records are read", {"read_file(path, "}},
      {"reference_scenes/content.cpp",
       "hashes files that were found or opened by others",
       {"KnownHashes>(file_)", "hash(InputFile(path))", "sha256_of_file(file, ",
        "InputFile opened(file)"}},
      {"reference_scenes/engine_content.cpp",
       "the loader's log in our directory",
       {"read_file(trace, "}},
      {"reference_scenes/engine_program.cpp",
       "engines' pictures in our directory",
       {"PictureFile(file)", "read_picture(open()"}},
      {"reference_scenes/engines/browser/engine_browser.cpp",
       "an engine of the catalogue and its page",
       {"\"/dev/null\", O_RDWR", "page(page_file())"}},
      {"reference_scenes/engines/outside/outside.cpp",
       "pictures are opened by open_named()",
       {"PictureFile(engine_.open_picture("}},
      {"reference_scenes/engines/outside/outside_reader.cpp",
       "the engine file itself, which the user or the grid names",
       {"const InputFile file(path)", "read_file(file, kMostBytes)"}},
      {"reference_scenes/engines/programs/scene_program.cpp",
       "a program that gets its files from us",
       {"std::ifstream in(file)", "read_scene(file)"}},
      {"renderer/scene/lights/light_reader.cpp",
       "a picture below the scene, which is checked once it is open",
       {"InputFile opened(path)", "read_picture(PictureFile(std::move(opened)"}},
      {"renderer/scene/scene_reader.cpp", "the scene itself", {"read_file(path, kMaxSceneBytes)"}},
      {"studies/convert/assets/assets.cpp",
       "the file of materials itself, which the user names",
       {"return read_file(path, kMost", "json_of_glb(InputFile(path))"}},
      {"studies/measured/merl.cpp",
       "the measured material itself, which the user names",
       {"read_file(path, kMostBytes)"}},
      {"studies/shader_check/run_shaders.cpp",
       "our runner's answer in our directory",
       {"read_file(file, kMostInvocations"}},
      {"studies/shader_check/runner/runner.cpp",
       "our runner reads what we gave it",
       {"std::ifstream in(file"}},
      {"studies/shader_check/spirv.cpp",
       "a compiler's answer in our directory",
       {"read_file(scratch.path()"}},
  };
  return all;
}

/// A line without its comment; empty for one of the preprocessor.
std::string code_in(const std::string& line) {
  static const std::regex comment(R"re(//.*$|^\s*#.*$)re");
  return std::regex_replace(line, comment, "");
}

/// Calls, and declarations of objects that open what they are given, also as members and in templates. Parameters of
/// functions that are declared begin with "const".
bool opens(const std::string& code) {
  static const std::regex objects(
      R"re(\b(InputFile|PictureFile)\b(?!\s*[&:;]|\(\)|\s+[\w:]+\((const\b|\))))re"),
      calls(R"re(\b(read_file|read_picture|read_image|read_record|read_scene|layer_names|)re"
            R"re(sha256_of_file)\b(?!\s*\(const\b)|\bw?i?fstream\b|\bfilebuf\b|)re"
            R"re(\bf(d|re)?open\b|(^|[^\w>])::(openat2?|open)\s*\(|\bSYS_openat2?\b)re");
  return std::regex_search(code, objects) || std::regex_search(code, calls);
}

/// Ways around the gate: leave that no user gave, and what opens a file without being allowed.
Problems ways_around_the_gate(const fs::path& root, const std::vector<Allowed>& allowed) {
  // Where no names come from the user himself.
  static const std::set<std::string> gated{"farm", "renderer", "reference_scenes", "studies"};
  static const std::set<std::string> not_installed{"tests", "docs"};
  std::map<std::string, std::vector<std::string>> left;
  for (const Allowed& one : allowed) left[one.file] = one.code;
  Problems problems;
  for (const fs::path& file : project_files(root)) {
    const std::string name = file.generic_string(), room = file.begin()->string();
    if (!is_cpp(file) || not_installed.contains(room)) continue;
    const bool may_give = name.starts_with("program/command/") ||
                          name.starts_with("program/python/") ||
                          name.starts_with("base/system/leave.");
    const bool is_gated = gated.contains(room) || name.starts_with("base/records/");
    std::size_t number = 0;
    for (const std::string& line : lines(read(root / file))) {
      ++number;
      const std::string code = code_in(line);
      const auto has = [&](const std::string& text) { return code.find(text) != code.npos; };
      if (!may_give && (has("Leave::of_user(") || has("LOBELIA_ALLOW_COMMANDS_IN\"")))
        problems.push_back(place(file, number) + "gives leave");
      if (!is_gated || !opens(code)) continue;
      auto& parts = left[name];
      const auto part = std::find_if(parts.begin(), parts.end(), has);
      if (part != parts.end())
        parts.erase(part);
      else
        problems.push_back(place(file, number) + "opens: " +
                           code.substr(std::min(code.find_first_not_of(' '), code.size())));
    }
  }
  for (const auto& [file, parts] : left)
    for (const std::string& part : parts) problems.push_back(file + ": has no more: " + part);
  return problems;
}

/// A pattern that finds nothing more leaves lines of the list over.
TEST(Gate, AloneGivesLeave) {
  EXPECT_THAT(ways_around_the_gate(kRoot, allowed_places()), IsEmpty())
      << "If it needs no leave or has it, add a line to allowed_places(), with the reason.";
  for (const Allowed& one : allowed_places()) EXPECT_NE(one.because, "") << one.file;
}

TEST(Gate, FindsLeaveThatNoUserGave) {
  Scratch tree;
  write(tree / "program/command/a.cpp", "farm.leave = Leave::of_user(options.allow_commands);\n");
  write(tree / "base/system/leave.cpp", "std::getenv(\"LOBELIA_ALLOW_COMMANDS_IN\");\n");
  ASSERT_THAT(ways_around_the_gate(tree.path(), {}), IsEmpty());
  write(tree / "farm/a.cpp", "make_outside_engine(one, Leave::of_user(true));\n");
  EXPECT_THAT(ways_around_the_gate(tree.path(), {}), ElementsAre("farm/a.cpp:1: gives leave"));
}

TEST(Gate, AllowsAPlaceOnceAndOnlyWhileItIsThere) {
  Scratch tree;
  const std::vector<Allowed> allowed{{"farm/a.cpp", "it is the grid", {"InputFile file(path)"}}};
  write(tree / "farm/a.cpp", "const InputFile file(path);\n");
  EXPECT_THAT(ways_around_the_gate(tree.path(), allowed), IsEmpty());
  write(tree / "farm/a.cpp", "const InputFile file(path);\nconst InputFile file(path);\n");
  EXPECT_THAT(ways_around_the_gate(tree.path(), allowed),
              ElementsAre("farm/a.cpp:2: opens: const InputFile file(path);"));
  write(tree / "farm/a.cpp", "const InputFile file(evil);\n");
  EXPECT_THAT(ways_around_the_gate(tree.path(), allowed),
              ElementsAre("farm/a.cpp:1: opens: const InputFile file(evil);",
                          "farm/a.cpp: has no more: InputFile file(path)"));
}

}  // namespace
}  // namespace house

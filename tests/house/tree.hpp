// Reading the source tree, and running programs in folders made for that.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <iterator>

#include "lobelia_paths.hpp"
#include "tests/test.hpp"

namespace house {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

inline const fs::path kRoot = LOBELIA_SOURCE_DIR;

inline std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

/// As a word of a POSIX shell, whatever is in it.
inline std::string quoted(const fs::path& path) {
  std::string word = "'";
  for (const char c : path.string()) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

struct Ran {
  int exit_code;
  std::string output;  ///< stdout and stderr
};

inline Ran run(const std::string& command) {
  std::string output;
  FILE* const pipe = ::popen(("exec 2>&1; " + command).c_str(), "r");
  if (!pipe) return {-1, "no pipe"};
  char part[4096];
  while (const std::size_t size = std::fread(part, 1, sizeof part, pipe)) output.append(part, size);
  const int status = ::pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, std::move(output)};
}

/// An empty directory that goes with this object.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "lobelia-house-XXXXXX").string();
    if (!::mkdtemp(name.data())) ADD_FAILURE() << "no temporary directory " << name;
    path_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path operator/(const fs::path& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Every text file of the project, relative to `root`, sorted. What is built or made is left out:
/// hidden directories (but .ci), build trees, farms, and what .gitignore names.
inline std::vector<fs::path> project_files(const fs::path& root) {
  std::vector<fs::path> files;
  for (auto it = fs::recursive_directory_iterator(root); it != fs::recursive_directory_iterator();
       ++it) {
    const fs::path name = it->path().filename();
    if (it->is_directory()) {
      const bool hidden = name.string().starts_with('.') && name != ".ci" && name != ".github";
      const bool top = it.depth() == 0;
      if (hidden || name == "node_modules" || (top && (name == "build" || name == "out")) ||
          fs::exists(it->path() / "CMakeCache.txt") || fs::exists(it->path() / "farm.json"))
        it.disable_recursion_pending();
      continue;
    }
    if (name == ".git") continue;  // a file, in a linked work tree
    if (!it->is_regular_file() || read(it->path()).find('\0') != std::string::npos) continue;
    files.push_back(it->path().lexically_relative(root));
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline bool is_cpp(const fs::path& file) {
  return file.extension() == ".cpp" || file.extension() == ".hpp" || file.extension() == ".h";
}

/// "farm/farm.cpp:12: "
inline std::string place(const fs::path& file, std::size_t line) {
  return file.string() + ":" + std::to_string(line) + ": ";
}

/// Lines of `text`, numbered from 1.
inline std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result(1);
  for (const char c : text) {
    if (c == '\n')
      result.emplace_back();
    else
      result.back() += c;
  }
  return result;
}

}  // namespace house

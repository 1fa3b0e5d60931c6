// The built tree, installed in a directory with a blank and then moved, as a user may do.
#pragma once

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"

namespace packages {

namespace fs = std::filesystem;
/// The build directory of the tree that is tested.
const fs::path kBuild = fs::path(LOBELIA_PROGRAM).parent_path().parent_path();

using house::Ran;
using house::read;
using house::run;
using house::Scratch;
using house::write;

inline bool has_program(const std::string& name) {
  return run("command -v " + name).exit_code == 0;
}

/// The files and links below `directory`, relative to it and sorted.
inline std::vector<std::string> files_below(const fs::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (!entry.is_directory() || entry.is_symlink())
      names.push_back(entry.path().lexically_relative(directory).string());
  std::sort(names.begin(), names.end());
  return names;
}

class InstalledTree {
 public:
  InstalledTree() {
    // Packagers set it; here it would lead elsewhere.
    ::unsetenv("DESTDIR");
    const fs::path first = scratch_ / "at first";
    installed_ =
        run("cmake --install " + house::quoted(kBuild) + " --prefix " + house::quoted(first));
    EXPECT_EQ(installed_.exit_code, 0) << installed_.output;
    fs::rename(first, prefix());
    fs::create_directory(work());
  }
  fs::path prefix() const { return scratch_ / "moved für später"; }
  fs::path work() const { return scratch_ / "work"; }

  /// In an empty directory, with nothing of our environment.
  Ran shell(const std::string& script) const {
    return run("cd " + house::quoted(work()) + " && exec env -i HOME=" + house::quoted(work()) +
               " LC_ALL=C.UTF-8 PREFIX=" + house::quoted(prefix()) +
               " PATH=" + house::quoted(prefix() / "bin") + ":/usr/bin:/bin /bin/sh -c " +
               house::quoted(script));
  }

 private:
  Scratch scratch_;
  Ran installed_;
};

inline const InstalledTree& installed_tree() {
  static const InstalledTree tree;
  return tree;
}

}  // namespace packages

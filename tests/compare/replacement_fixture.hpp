// A folder whose files are replaced, and faults in the calls that change files.
#pragma once

#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "compare/accept/replacement.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

/// replacement_faults.cpp stands between this program and the C library, and counts the calls that change files.

namespace lobelia::faults {

enum class Kind {
  kOnce,        ///< one call fails
  kFromThenOn,  ///< and all after it
  kKill,        ///< one ends the process
  kMeanwhile    ///< before one, but no rename, somebody else does something
};

inline Kind kind = Kind::kOnce;
inline int at = 0, calls = 0;  ///< the call that is meant, 0 for none; and how many there were
inline bool no_hard_links = false;
inline std::function<void()> meanwhile;

/// While it lives, the fault is there.
class Fault {
 public:
  Fault(Kind wanted, int call) {
    kind = wanted;
    calls = 0;
    at = call;
  }
  ~Fault() { at = 0; }
  Fault(const Fault&) = delete;
  Fault& operator=(const Fault&) = delete;
};

}  // namespace lobelia::faults

namespace lobelia::fixtures {

using faults::Fault;
using faults::Kind;

using Texts = std::map<std::string, std::string>;  ///< by path

inline const Texts kOld{{"a.exr", "old a"}, {"sub/b.exr", "old b"}};
inline const Texts kNew{{"a.exr", "new a"}, {"made/here/c.exr", "new c"}, {"sub/b.exr", "new b"}};

/// No loop over the calls of a replacement is longer.
inline constexpr int kMostCalls = 300;

class Replacements : public testing::Test {
 protected:
  Replacements() {
    for (const char* letter : {"a", "b", "c"})
      put(fmt::format("mine/{}.exr", letter), fmt::format("new {}", letter));
    begin_anew();
  }
  ~Replacements() override { faults::no_hard_links = false; }

  fs::path path(const std::string& name) const { return directory_.path() / name; }
  fs::path refs() const { return path("refs"); }
  fs::path ours(const std::string& name) const { return refs() / kReplacedName / name; }
  void put(const std::string& name, const std::string& text) const {
    fs::create_directories(path(name).parent_path());
    write_file(path(name), text);
  }
  void begin_anew() const {
    fs::remove_all(refs());
    for (const auto& [name, text] : kOld) put("refs/" + name, text);
    fs::permissions(refs() / "a.exr", fs::perms(0600));
  }
  Replacement replacement(const std::string& letter, const std::string& to,
                          const std::optional<std::string>& before) const {
    Replacement one{path("mine/" + letter + ".exr"), sha256("new " + letter), to, {}};
    if (before) one.before = sha256(*before);
    return one;
  }
  std::vector<Replacement> three() const {
    return {replacement("a", "a.exr", "old a"), replacement("b", "sub/b.exr", "old b"),
            replacement("c", "made/here/c.exr", std::nullopt)};
  }
  /// As if a process was killed before the last of `files` had its place. It has an old file.
  void interrupt(const std::vector<Replacement>& files) const {
    replace(files);
    fs::rename(ours("last"), ours("now"));
    const fs::path place = refs() / files.back().to;
    const std::string last = std::to_string(files.size() - 1);
    fs::rename(place, ours("now/new-" + last));
    fs::create_hard_link(ours("now/old-" + last), place);
  }
  /// All files but ours.
  Texts texts() const {
    Texts found;
    for (fs::recursive_directory_iterator entry(refs()), end; entry != end; ++entry)
      if (entry->path().filename() == kReplacedName)
        entry.disable_recursion_pending();
      else if (entry->is_regular_file())
        found[entry->path().lexically_relative(refs()).string()] = read_file(entry->path(), 1000);
    return found;
  }
  unsigned mode(const std::string& name) const {
    struct stat status {};
    EXPECT_EQ(::lstat((refs() / name).c_str(), &status), 0);
    return status.st_mode & 07777u;
  }
  /// All are old or all are new, and no stage is left but the last one.
  void expect_all_or_none() const {
    EXPECT_THAT(texts(), testing::AnyOf(testing::Eq(kOld), testing::Eq(kNew)));
    EXPECT_EQ(mode("a.exr"), 0600u);
    for (const char* stage : {"now", "back"}) EXPECT_FALSE(fs::exists(ours(stage))) << stage;
  }
  /// The same command again.
  void expect_replaced_by_the_next_try() const {
    if (texts() == kOld) replace(three());
    EXPECT_EQ(texts(), kNew);
    EXPECT_FALSE(fs::exists(ours("next")));
    undo_replacement(refs());
    EXPECT_EQ(texts(), kOld);
  }
  /// In a process of its own, which may be killed. Whether it ended by itself.
  template <class Work>
  static bool ends(int call, Work work) {
    const pid_t child = ::fork();
    if (child == 0) {
      const Fault fault(Kind::kKill, call);
      try {
        work();
      } catch (const Error&) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
    return WIFEXITED(status);
  }
  void replace(const std::vector<Replacement>& files) const {
    replace_files(HeldDirectory(refs()), files);
  }
  Error error_of_replacing(const std::vector<Replacement>& files) const {
    return thrown_by([&] { replace(files); });
  }

  TemporaryDirectory directory_;
};

}  // namespace lobelia::fixtures

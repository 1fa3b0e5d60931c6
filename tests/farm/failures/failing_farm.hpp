// A small farm that is run as a user runs it and disturbed, and what must come out of it all the same.
#pragma once

#include <fmt/format.h>

#include <chrono>

#include "base/system/files.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {

/// A farm's results by file: every picture and figure byte for byte; records without the time, place and cost of their
/// making. Logs only by name.
using Results = std::map<std::string, std::string>;
Results results_of(const fs::path& farm_directory);

/// Names of files that are not the same in both.
std::vector<std::string> differences(const Results& a, const Results& b);

/// Everything below a directory, by its path there: its kind, its inode, when it was changed, and its content.
Results everything_in(const fs::path& directory);

/// The program at work.
class RunningFarm {
 public:
  /// Its output goes to a file, or to `output`.
  RunningFarm(std::vector<std::string> arguments, const fs::path& directory,
              const std::vector<std::string>& environment = {}, const fs::path& output = {});
  ~RunningFarm();
  RunningFarm(const RunningFarm&) = delete;
  RunningFarm& operator=(const RunningFarm&) = delete;
  int pid() const { return pid_; }
  void signal(int number) const;
  /// Until it has ended: its exit code, or 128 + signal. At most 120 s.
  int wait();
  bool has_ended();
  /// Processes of that name that come of it; not those that are only asked their version.
  std::vector<int> engines(const std::string& name) const;
  std::string output() const;  ///< so far; empty unless it goes to a file

 private:
  fs::path output_;
  int pid_ = 0;
  int exit_code_ = -1;
};

/// The words of a process in /proc, with zeros between them. Empty if it is gone.
std::string command_line_of(const std::filesystem::path& process);

/// Whether these processes are gone within 20 s.
bool end_soon(const std::vector<int>& processes);

struct FarmRun {
  int exit_code = 0;
  std::string output;
  std::size_t rendered = 0, kept = 0;  ///< pictures, as its last line says
};

class FailingFarm : public testing::Test {
 protected:
  FailingFarm();

  fs::path root() const { return directory_.path(); }
  fs::path out() const { return root() / "out"; }
  fs::path cache() const { return root() / "cache"; }
  /// Four cells, n8 to n64, with POV-Ray's pictures, until this makes it another.
  fs::path grid(const std::vector<std::string>& exponents,
                const std::string& engines = "<engine name=\"povray\"/>", int size = 32);
  std::size_t pictures() const { return pictures_; }  ///< of that grid

  /// "farm GRID -o out --cache cache" and then `more`.
  std::vector<std::string> command(const std::vector<std::string>& more = {}) const;
  FarmRun run(const std::vector<std::string>& more = {}) const {
    return run_command(command(more));
  }
  FarmRun run_command(const std::vector<std::string>& arguments,
                      const std::vector<std::string>& environment = {}) const;

  /// A program that answers as POV-Ray does and has every picture of grid() ready. `misdeeds` is shell that runs
  /// before each picture: $cell is the cell's id, $stem.exr what is to be written. Returns its path.
  fs::path fake_povray(const std::string& misdeeds = "") const;
  /// A misdeed: to wait for let_go_on().
  std::string waits() const {
    return fmt::format("until [ -e '{}' ]; do sleep 0.1; done", (root() / "go").string());
  }
  void let_go_on() const { write_file(root() / "go", ""); }
  /// A script that is no test's own.
  fs::path script(const std::string& name, const std::string& text) const;
  /// Shell words that are true so many times: the engine may write nothing that would count.
  std::string first_times(const std::string& name, int times);

  /// The results of the farm of grid() when nothing happens to it; made once.
  const Results& undisturbed();

  /// After a second run: it ended well, with the undisturbed farm's results, and nothing half-written lies anywhere.
  void expect_mended(const FarmRun& second, std::size_t lost_pictures);
  /// Without the count.
  void expect_mended(const FarmRun& second);
  void expect_nothing_half_written() const;

  std::size_t cached_pictures() const;
  fs::path result_of(const std::string& cell, const std::string& job) const;
  Json failure_of(const std::string& cell) const;

 private:
  const TemporaryDirectory directory_;
  std::size_t pictures_ = 0;
  Results undisturbed_;
  std::vector<int> held_open_;
};

}  // namespace lobelia

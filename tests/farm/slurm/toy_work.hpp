// Work for a run whose elements are a shell script: a job sleeps and publishes one line, by link(2).
#pragma once

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <iterator>
#include <thread>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"
#include "farm/slurm/slurm_run.hpp"
#include "tests/test.hpp"

namespace lobelia {

class ToyWork {
 public:
  /// Jobs "job000", ... of phase 0, each `seconds` long.
  ToyWork(const fs::path& directory, int jobs, double seconds) : directory_(directory) {
    for (const char* sub : {"results", "run/chunks", "it's a $program"})
      fs::create_directories(directory / sub);
    for (int i = 0; i < jobs; ++i) add({fmt::format("job{:03}", i), 0, seconds, "toy"});
    // Its directory has what a shell would trip over. Its own name may have no blank: by proctrack/linuxproc of
    // Slurm 22.05 such a process gets no signal.
    write_file(program(), R"sh(#!/bin/sh
# farm exec-chunk RUN NUMBER --sha256 HASH, or farm finish RUN
results=$(dirname "$3")/results
[ "$2" = finish ] && { ls "$results" | wc -l > "$results/../finished"; exit; }
[ "$(sha256sum < "$3/chunks/$4")" = "$6  -" ] || { echo "chunk $4 is another"; exit 9; }
part=
trap 'rm -f "$part"; exit 143' TERM
while read -r name seconds; do
  [ -e "$results/$name" ] && continue
  case $name in broken*) failed=7; continue;; esac
  echo "$name" >> "$results/../started"
  sleep "$seconds"
  part=$(mktemp "$results/.part.XXXXXX")
  echo "result of $name" > "$part"
  ln "$part" "$results/$name" 2> /dev/null
  rm -f "$part"
done < "$3/chunks/$4"
exit ${failed:-0}
)sh");
    fs::permissions(program(), fs::perms::owner_all);
  }

  void add(const SlurmJob& job) { jobs_.push_back(job); }
  fs::path program() const { return directory_ / "it's a $program" / "toy"; }
  fs::path run_directory() const { return directory_ / "run"; }

  SlurmWork work() {
    return {run_directory(), program(),
            [this] {
              missing_.clear();
              for (const auto& job : jobs_)
                if (!fs::exists(directory_ / "results" / job.name) && !given_up_.contains(job.name))
                  missing_.push_back(job);
              return missing_;
            },
            [this](std::size_t number, std::span<const std::size_t> jobs) {
              const fs::path path = run_directory() / "chunks" / std::to_string(number);
              EXPECT_FALSE(fs::exists(path)) << "number " << number << " is given away twice";
              std::string text;
              for (const std::size_t job : jobs)
                text += fmt::format("{} {}\n", missing_[job].name, missing_[job].seconds);
              write_file(path, text);
              return sha256(text);
            },
            [this](std::span<const std::size_t> jobs, const std::string& why) {
              for (const std::size_t job : jobs) given_up_[missing_[job].name] = why;
            }};
  }
  /// Why, by name.
  const std::map<std::string, std::string>& given_up() const { return given_up_; }

  /// Names in results/, hidden files too. One may go while we look.
  std::map<std::string, std::string> results() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(directory_ / "results"))
      if (std::ifstream file(entry.path()); file)
        all[entry.path().filename()] = {std::istreambuf_iterator<char>(file), {}};
    return all;
  }
  std::map<std::string, std::string> wanted() const {
    std::map<std::string, std::string> all;
    for (const auto& job : jobs_) all[job.name] = "result of " + job.name + "\n";
    return all;
  }
  /// Jobs that an element began, again if it began them again.
  std::vector<std::string> started() const {
    if (!fs::exists(directory_ / "started")) return {};
    return split(read_file(directory_ / "started", 1 << 20), "\n");
  }
  /// The count of `farm finish`; empty if it has not run.
  std::string finished() const {
    const fs::path path = directory_ / "finished";
    return fs::exists(path) ? read_file(path, 100) : "";
  }

 private:
  fs::path directory_;
  std::vector<SlurmJob> jobs_, missing_;
  std::map<std::string, std::string> given_up_;
};

/// Options for tests: fast polls, small chunks, and what is said goes to `said`.
inline SlurmRunOptions quick(std::string& said) {
  SlurmRunOptions options;
  options.first_poll = options.last_poll = std::chrono::milliseconds(200);
  options.settle = std::chrono::seconds(0);
  options.call_limit = std::chrono::minutes(10);
  options.chunks.least_seconds = 0;
  options.say = [&said](const std::string& sentence) { said += sentence + "\n"; };
  return options;
}

/// Whether it becomes true before only a hang can be the reason.
inline bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(30);
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return condition();
}

/// A client in a process of its own, to be killed and interrupted.
class ClientProcess {
 public:
  /// Its output and its end go to `log`.
  ClientProcess(const SlurmWork& work, const SlurmRunOptions& options, const fs::path& log) {
    pid_ = ::fork();
    if (pid_ != 0) return;
    catch_interrupts();
    std::ofstream out(log, std::ios::app);
    SlurmRunOptions ours = options;
    ours.say = [&](const std::string& sentence) { out << sentence << std::endl; };
    int code = 0;
    try {
      const SlurmOutcome outcome = run_on_slurm(work, ours);
      out << "missing: " << outcome.missing.size() << std::endl;
    } catch (const Error& error) {
      out << error.what() << std::endl;
      code = int(error.code());
    }
    ::_exit(code);
  }
  ~ClientProcess() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  ClientProcess(const ClientProcess&) = delete;
  ClientProcess& operator=(const ClientProcess&) = delete;

  void signal(int number) const { ::kill(pid_, number); }
  /// Its exit code, or 128 + signal; 0 is also that it did not end, which fails the test.
  int wait() {
    int status = 0;
    const bool ended = eventually([&] { return ::waitpid(pid_, &status, WNOHANG) == pid_; });
    EXPECT_TRUE(ended) << "the client does not end";
    if (!ended) return 0;
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t pid_ = 0;
};

}  // namespace lobelia

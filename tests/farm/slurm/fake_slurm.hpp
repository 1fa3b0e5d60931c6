// Slurm's programs, pretended by shell scripts.
#pragma once

#include <fmt/format.h>

#include "tests/farm/slurm/toy_work.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {

/// A $PATH that begins with fakes. fake sbatch runs every element at once and gives out ids from 100; squeue then
/// knows no such job.
class FakeSlurm : public testing::Test {
 protected:
  FakeSlurm() : toy(directory_.path() / "toy", 0, 0) {
    fs::create_directories(bin());
    ::setenv("PATH", fmt::format("{}:/usr/bin:/bin", bin().string()).c_str(), 1);
    ::setenv("DIR", "not handed on", 1);
    fake("sbatch", R"(
n=$(cat "$d/id" 2>/dev/null || echo 100); echo $((n + 1)) > "$d/id"
printf '%s\n' "$*" >> "$d/submitted"
last=; for a; do case $a in --array=*) last=${a#--array=0-};; esac; script=$a; done
if [ -n "$last" ]; then
  for i in $(seq 0 ${last%\%*}); do SLURM_ARRAY_TASK_ID=$i sh "$script"; done > "$d/output" 2>&1
else sh "$script" > "$d/output" 2>&1; fi
echo $n)");
    fake("squeue", R"(
case "$*" in *--me*) exit 0;; esac
echo "slurm_load_jobs error: Invalid job id specified" >&2; exit 1)");
    fake("scancel", "echo \"$*\" >> \"$d/cancelled\"");
    fake("sinfo", "for n in n1 n2; do echo \"$n|render*|up|idle|8000|0/2/0/2\"; done");
    fake("scontrol", "echo 'MaxArraySize = 1001'; echo 'KillWait = 1 sec'");
  }
  ~FakeSlurm() override {
    ::setenv("PATH", path_.c_str(), 1);
    ::unsetenv("DIR");
  }

  fs::path bin() const { return directory_.path() / "bin"; }
  fs::path in(const std::string& name) const { return directory_.path() / name; }
  void fake(const std::string& name, const std::string& body) {
    write_file(bin() / name,
               fmt::format("#!/bin/sh\nd='{}'\n{}\n", directory_.path().string(), body));
    fs::permissions(bin() / name, fs::perms::owner_all);
  }
  /// Elements of an array do nothing, and squeue has `line` of each array, unless sbatch is given `needed`.
  void elements_end(const std::string& line, const std::string& needed) {
    if (!fs::exists(bin() / "sbatch.good")) fs::rename(bin() / "sbatch", bin() / "sbatch.good");
    fake("sbatch", fmt::format(R"(
case "$*" in *--array=*) ;; *) exec "$d/bin/sbatch.good" "$@";; esac
case "$*" in *{0}*) exec "$d/bin/sbatch.good" "$@";; esac
n=$(cat "$d/id" 2>/dev/null || echo 100); echo $((n + 1)) > "$d/id"
printf '%s\n' "$*" >> "$d/submitted"
echo '{1}' > "$d/ended-$n"
echo $n)",
                               shell_quote(needed), line));
    fake("squeue", R"(
case "$*" in *--me*) exit 0;; esac
[ -e "$d/ended-$6" ] && exec cat "$d/ended-$6"
echo "slurm_load_jobs error: Invalid job id specified" >&2; exit 1)");
  }
  /// sbatch's arguments for arrays, one line for each.
  std::vector<std::string> arrays() const {
    auto all = lines("submitted");
    std::erase_if(all, [](const std::string& line) { return line.find("--array") == line.npos; });
    return all;
  }
  std::vector<std::string> lines(const std::string& name) const {
    return fs::exists(in(name)) ? split(read_file(in(name), 1 << 20), "\n")
                                : std::vector<std::string>();
  }
  /// The error that the run ends with.
  std::pair<ExitCode, std::string> failure() {
    const Error error = thrown_by([&] { run_on_slurm(toy.work(), options); });
    return {error.code(), error.what()};
  }
  void jobs(int count) {
    for (int i = 0; i < count; ++i) toy.add({fmt::format("job{:03}", i), 0, 0, "toy"});
  }

  TemporaryDirectory directory_;
  ToyWork toy;
  std::string said;
  SlurmRunOptions options = quick(said);

 private:
  std::string path_ = std::getenv("PATH");
};

}  // namespace lobelia

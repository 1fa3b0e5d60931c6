// Exit codes, environment variables and files, for man pages and the documentation.
#include "base/system/error.hpp"
#include "program/command/manual/manual_tables.hpp"

namespace lobelia::cli {
namespace {

Fact exit_code(ExitCode code, std::string meaning) {
  return {std::to_string(int(code)), std::move(meaning)};
}

/// A test looks for every enumerator of ExitCode here.
const std::vector<Fact> kExitCodes = {
    exit_code(ExitCode::kSuccess, "done; for a question, the answer is yes"),
    exit_code(
        ExitCode::kDiffers,
        "done, and the answer is no: over a limit, pixels that are not finite, cells that differ"),
    exit_code(ExitCode::kUsage, "the command line is wrong"),
    exit_code(ExitCode::kInput,
              "an input cannot be read, is invalid, or does not match the other one"),
    exit_code(ExitCode::kOutput, "an output cannot be written, or a job of a farm failed"),
    exit_code(ExitCode::kEngine, "a reference engine is missing or failed"),
    exit_code(ExitCode::kUndecided, "noise leaves open whether a limit holds"),
    exit_code(ExitCode::kInternal, "a bug in Lobelia; please report it"),
    exit_code(ExitCode::kNoResources,
              "the system gives no more memory, threads, processes or open files"),
    exit_code(ExitCode::kTimedOut, "the time of --time-limit is over"),
    exit_code(ExitCode::kHungUp, "SIGHUP: the terminal was closed"),
    exit_code(ExitCode::kInterrupted, "SIGINT: Ctrl-C"),
    exit_code(ExitCode::kBrokenPipe,
              "nobody reads the output any more, as in lobelia models | head"),
    exit_code(ExitCode::kTerminated, "SIGTERM"),
};

/// A test looks for every variable that the program reads here.
const std::vector<Fact> kEnvironment = {
    {"LOBELIA_CACHE", "where farms keep results without --cache; otherwise it is DIR/cache"},
    {"LOBELIA_ALLOW_COMMANDS_IN",
     "folders, separated by colons; what a grid, its engine files and a run's records in them say is done "
     "without --allow-commands"},
    {"LOBELIA_NO_NAMESPACE", "if set, engines run without a PID namespace, for a debugger"},
    {"OCIO", "OpenColorIO configuration of lobelia compare without --ocio"},
    {"NO_COLOR", "if set and not empty, verdicts have no colours, unless compare --color always"},
    {"CI, JENKINS_URL, TEAMCITY_VERSION, TF_BUILD",
     "if one is set, and not to false, lobelia compare --accept refuses to replace references"},
    {"TMPDIR",
     "parent of temporary directories, and of the files without a name in which `compare` keeps large pictures; "
     "otherwise it is /tmp"},
    {"XDG_CACHE_HOME", "parent of lobelia/file-hashes-HOST.json; otherwise it is ~/.cache"},
    {"HOME", "where ~/.cache is"},
    {"USER, LOGNAME", "a sentence with such a name is left out by lobelia gallery publish"},
    {"XDG_CONFIG_HOME, TMP, TEMP",
     "not read; in an engine they name a directory of its own, as HOME, XDG_CACHE_HOME and TMPDIR do"},
    {"PATH", "where engines are looked for; engines get it"},
    {"LD_LIBRARY_PATH", "where libraries are looked for; engines and the picture reader get it"},
    {"SLURMD_NODENAME", "on a cluster, set by Slurm: the name of the node"},
    {"SLURM_CPUS_PER_TASK", "on a cluster, set by Slurm: the number of threads"},
    {"ASAN_OPTIONS, TSAN_OPTIONS, UBSAN_OPTIONS, LSAN_OPTIONS",
     "options of sanitizers, for builds with them; the picture reader gets them"},
};

const std::vector<Fact> kFiles = {
    {"OUT.exr, OUT.json", "a picture, and beside it the record that says how it was made"},
    {"lobelia.toml", "what lobelia compare does in this folder without arguments"},
    {"REFERENCES/.lobelia-accepted/",
     "what the last lobelia compare --accept replaced, for lobelia accept --undo; may be removed"},
    {"DIR/cache/", "results of farms; may be lost, and is made again"},
    {"DIR/farm.json, DIR/cells/, DIR/failed/", "a farm: its cells, and what failed"},
    {"~/.cache/lobelia/file-hashes-HOST.json",
     "hashes of large files, so that they are not read again; may be removed"},
    {"/tmp/lobelia-temporary-XXXXXX/",
     "work in progress; the next farm removes what a killed one left"},
    {"PREFIX/bin/lobelia", "the installed program"},
    {"PREFIX/lib/lobelia/", "parts that it loads, and programs that it starts"},
    {"PREFIX/share/lobelia/", "scenes, grids and schemas"},
    {"PREFIX/share/doc/lobelia/", "this documentation"},
    {"PREFIX/share/man/man1/lobelia*.1.gz", "man pages"},
};

}  // namespace

std::span<const FactTable> fact_tables() {
  static const FactTable tables[] = {
      {"Exit status", "exit code", "", kExitCodes},
      {"Environment", "variable", "", kEnvironment},
      {"Files", "path", "DIR is a farm's directory, PREFIX the place where Lobelia is installed.",
       kFiles},
  };
  return tables;
}

}  // namespace lobelia::cli

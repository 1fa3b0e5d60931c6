#include "farm/slurm/doctor.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <random>
#include <thread>

#include "base/records/cluster.hpp"
#include "base/records/record.hpp"
#include "base/system/byte_locks.hpp"
#include "base/system/files.hpp"
#include "base/system/host.hpp"
#include "base/system/process.hpp"
#include "base/system/version.hpp"
#include "base/words/text.hpp"
#include "farm/slurm/slurm_client.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

using CheckVerdict = DoctorCheck::Verdict;

constexpr char kToken[] = "token";       // written here, read on the node
constexpr char kLock[] = "lock";         // held here, tried on the node
constexpr char kAnswer[] = "node.json";  // written on the node

/// Returns what does not work; empty if all does.
std::string try_rename(const fs::path& directory) {
  try {
    write_file(directory / "renamed", "old");
    write_file(directory / "renamed", "new");  // by a temporary name beside it
    return read_file(directory / "renamed", 10) == "new" ? "" : "the old file is still seen";
  } catch (const Error& error) {
    return error.what();
  }
}

std::string try_link(const fs::path& directory) {
  const fs::path from = directory / "link-from", to = directory / "link-to";
  try {
    write_file(from, "linked");
  } catch (const Error& error) {
    return error.what();
  }
  if (::link(from.c_str(), to.c_str()) != 0) return std::strerror(errno);
  if (::link(from.c_str(), to.c_str()) == 0)
    return "a second link to the same name was let through";
  if (errno != EEXIST) return std::strerror(errno);
  struct stat info {};
  if (::stat(from.c_str(), &info) != 0 || info.st_nlink != 2)
    return "the number of links is not told";
  return "";
}

/// The client holds this lock, so it must not be granted here.
std::string try_lock(const fs::path& directory) {
  const ByteLocks locks(HeldDirectory(directory), kLock);
  if (!locks.works()) return "the file system has no locks there";
  return locks.try_claim(0) ? "a lock that another machine holds was given away again" : "";
}

DoctorCheck machine_check(const char* name, bool ok, const char* if_ok, const char* otherwise,
                          const char* advice) {
  if (ok) return {name, CheckVerdict::kOk, if_ok, ""};
  return {name, CheckVerdict::kWarning, otherwise, advice};
}

DoctorCheck processes() {
  ProcessLimits limits;
  ProcessOptions options;
  options.on_start = [&](const ProcessLimits& found) { limits = found; };
  run_process({"/bin/true"}, options);
  return machine_check(
      "engines' processes", limits.contained == Containment::kPidNamespace,
      "a PID namespace for each: none can outlive its farm",
      "no PID namespace: a subreaper ends them, unless one kills that first",
      "allow user namespaces (kernel.unprivileged_userns_clone, user.max_user_namespaces)");
}

DoctorCheck writes() {
  const TemporaryDirectory directory;
  return machine_check("engines' writing", WriteLimit(directory.path()).ruleset() >= 0,
                       "Landlock holds each to a directory of its own",
                       "no Landlock: they write wherever you may",
                       "Linux 5.13 or later has it, if 'landlock' is among the kernel's lsm=");
}

DoctorCheck memory() {
  constexpr char kName[] = "engines' memory";
  if (memory_of_tree(::getpid()) == 0)
    return machine_check(kName, false, "",
                         "/proc is not there, or another PID namespace's: --memory has no effect",
                         "mount /proc");
  return machine_check(
      kName, count_of_oom_kills().has_value(),
      "held to --memory, and the kernel's own kills are known",
      "held to --memory; an engine that the kernel kills for want of memory counts as a crash",
      "Linux 4.13 or later tells oom_kill in /proc/vmstat");
}

class Doctor {
 public:
  explicit Doctor(const DoctorOptions& options) : options_(options), client_(options.call_limit) {}

  std::vector<DoctorCheck> operator()() {
    if (programs() && controller()) {
      configuration();
      if (partition()) node();
    }
    return std::move(checks_);
  }

 private:
  bool add(std::string name, CheckVerdict verdict, std::string found, std::string advice = "") {
    checks_.push_back({std::move(name), verdict, std::move(found), std::move(advice)});
    return verdict != CheckVerdict::kFailed;
  }

  /// Adds a check, with advice unless it is ok.
  void check(std::string name, bool ok, CheckVerdict otherwise, std::string found,
             std::string advice) {
    add(std::move(name), ok ? CheckVerdict::kOk : otherwise, std::move(found), ok ? "" : advice);
  }

  bool programs() {
    const auto absent = SlurmClient::absent_programs();
    if (absent.empty())
      return add("Slurm's programs", CheckVerdict::kOk, "sbatch and the others are in $PATH");
    return add("Slurm's programs", CheckVerdict::kFailed,
               fmt::format("not in $PATH: {}", fmt::join(absent, ", ")),
               "start it on a login node of the cluster, or 'module load slurm'");
  }

  bool controller() {
    const std::string why = client_.ping();
    if (why.empty()) return add("controller", CheckVerdict::kOk, "it answers");
    return add("controller", CheckVerdict::kFailed, why,
               "look whether 'scontrol ping' works and whether $SLURM_CONF names the right file");
  }

  void configuration() {
    const auto config = client_.config();
    if (!config) {
      add("configuration", CheckVerdict::kWarning, config.why,
          "array limits are taken to be Slurm's defaults");
      return;
    }
    const auto size = config_number(*config, "MaxArraySize", -1);
    check("MaxArraySize", size > 100, size > 1 ? CheckVerdict::kWarning : CheckVerdict::kFailed,
          size > 100
              ? fmt::format("{}: arrays of up to {} elements", size, std::min(size - 1, 1000LL))
              : fmt::format("{}: {}", size,
                            size > 1 ? "few and long elements" : "there are no job arrays"),
          "ask an administrator for 1001, Slurm's default");
    const auto kill_wait = config_number(*config, "KillWait", -1);
    check("KillWait", kill_wait < 0 || kill_wait >= 5, CheckVerdict::kWarning,
          fmt::format("{} s between TERM and KILL", kill_wait),
          "an element that is cancelled may leave a temporary file");
    const auto timeout = config_number(*config, "SlurmdTimeout", -1);
    check("SlurmdTimeout", timeout != 0, CheckVerdict::kWarning,
          timeout == 0 ? "0: a lost node is never noticed"
                       : fmt::format("{} s until a lost node's elements go elsewhere", timeout),
          "ask an administrator for 300, Slurm's default");
  }

  bool partition() {
    const std::string name =
        options_.slurm.partition.empty() ? "default" : options_.slurm.partition;
    const auto nodes = client_.node_list(options_.slurm.partition);
    if (!nodes) return add("partition", CheckVerdict::kWarning, nodes.why);
    if (nodes->empty())
      return add("partition", CheckVerdict::kFailed, fmt::format("'{}': there is none", name),
                 "'sinfo -s' lists them; name one with --partition");
    std::size_t usable = 0, processors = 0;
    for (const SlurmNode& node : *nodes) {
      if (!node.usable) continue;
      ++usable;
      processors += node.processors;
    }
    const std::string found =
        fmt::format("'{}': {} of {} nodes can run jobs, with {} processors",
                    nodes->front().partition, usable, nodes->size(), processors);
    if (usable == 0)
      return add("partition", CheckVerdict::kFailed, found,
                 "'sinfo -R' says why; ask an administrator");
    return add("partition", CheckVerdict::kOk, found);
  }

  void node() {
    const fs::path base = fs::absolute(options_.directory).lexically_normal();
    std::random_device random;
    const std::string token = fmt::format("{:08x}{:08x}", random(), random());
    const fs::path directory = base / fmt::format(".doctor-{}", token);
    make_directories(base);
    struct Remover {
      const HeldDirectory base, made;
      ~Remover() {
        const fs::path name = made.path().filename();
        try {
          Removal(base.path(), {[&](const HeldDirectory& root) {
                                  return root.below(name.string()).is_same_as(made);
                                },
                                [&](const fs::path& relative) {
                                  return relative == name ? Owned::kTree : Owned::kNo;
                                }})
              .remove(name);
        } catch (const Error&) {  // the check has been done
        }
      }
    };
    HeldDirectory held(base);
    HeldDirectory made = held.make_below(directory.filename().string());
    const Remover remover{std::move(held), std::move(made)};
    write_file(directory / kToken, token);
    const ByteLocks locks(remover.made, kLock);
    const auto lock = locks.try_claim(0);
    const fs::path script = directory / "doctor.sh";
    write_file(script, fmt::format("#!/bin/sh\nexec {} farm doctor-on-node {}\n",
                                   shell_quote(fs::absolute(options_.program).string()),
                                   shell_quote(directory.string())));
    const std::string name = "lobelia-doctor-" + token;
    auto arguments = sbatch_arguments(options_.slurm);
    // The answer comes through a file, which shows whether the directory is shared.
    arguments.insert(arguments.end(),
                     {"--job-name=" + name, "--ntasks=1", "--output=/dev/null", "--chdir=/"});
    const auto submission = client_.submit(arguments, script);
    if (!submission.job) {
      client_.cancel(name);
      add("a job", CheckVerdict::kFailed, submission.why,
          "see the options for partition, account and QOS");
      return;
    }
    const std::string why = wait_for_job(*submission.job, name, directory);
    if (!why.empty()) client_.cancel(name);
    throw_if_interrupted();
    std::error_code unknown;  // an answer that cannot be looked at is none
    if (!fs::exists(directory / kAnswer, unknown)) {
      add("a job", CheckVerdict::kFailed,
          why.empty() ? "it ended and nothing of it is seen here" : why,
          fmt::format("is {} the same on the nodes, and does {} run there?", base.string(),
                      options_.program.string()));
      return;
    }
    judge(directory, token);
  }

  /// Waits for the answer. Returns why there is none; empty if there is.
  std::string wait_for_job(SlurmJobId job, const std::string& name, const fs::path& directory) {
    const auto start = std::chrono::steady_clock::now();
    std::string reason = "nothing is known of it";
    int ended = 0;
    while (std::chrono::steady_clock::now() - start < options_.node_limit) {
      if (interrupted()) return "interrupted";
      std::error_code unknown;
      if (fs::exists(directory / kAnswer, unknown)) return "";
      const auto elements = client_.elements(job, name);
      const bool lives =
          !elements || std::any_of(elements->begin(), elements->end(), [](const auto& element) {
            return element.state != SlurmElement::State::kEnded;
          });
      if (elements && !elements->empty())
        reason = fmt::format("{} ({})", elements->front().state_name, elements->front().reason);
      // A network file system may show the answer a little after the job's end.
      if (!lives && ++ended > 5) return fmt::format("it ended as {} and left no answer", reason);
      std::this_thread::sleep_for(options_.poll);
    }
    return fmt::format("it gave no answer in {:g} s: {}", options_.node_limit.count(), reason);
  }

  void judge(const fs::path& directory, const std::string& token) {
    records::SlurmDoctor answer;
    try {
      answer = records::read_record<records::SlurmDoctor>(directory / kAnswer);
    } catch (const Error& error) {
      add("a job", CheckVerdict::kFailed, error.what());
      return;
    }
    const auto shown = [](const std::string& text) { return printable(text, 300); };
    add("a job", CheckVerdict::kOk, fmt::format("it ran on {}", shown(answer.host)));
    const bool same = answer.token == token;
    check("directory on a node", same, CheckVerdict::kFailed,
          same ? "what one writes the other reads" : "the node reads another file of the same name",
          "results have to be on a file system that the nodes share");
    check("program on a node", answer.version == kNameAndVersion, CheckVerdict::kFailed,
          fmt::format("{} there, {} here", shown(answer.version), kNameAndVersion),
          "let both be the same file, or build it the same on all");
    const auto try_on_node = [&](const char* name, const std::string& problem,
                                 CheckVerdict otherwise, const char* advice) {
      check(name, problem.empty(), otherwise, problem.empty() ? "they work" : shown(problem),
            advice);
    };
    try_on_node("renaming on a node", answer.rename, CheckVerdict::kFailed,
                "take another file system for the results");
    try_on_node("hard links on a node", answer.link, CheckVerdict::kFailed,
                "take another file system for the results");
    try_on_node(
        "locks across machines", answer.lock, CheckVerdict::kWarning,
        "start one client for a directory at a time, or have lockd (NFS) or -o flock (Lustre) turned on");
  }

  const DoctorOptions& options_;
  SlurmClient client_;
  std::vector<DoctorCheck> checks_;
};

}  // namespace

std::vector<DoctorCheck> look_at_machine() { return {processes(), writes(), memory()}; }

std::vector<DoctorCheck> doctor(const DoctorOptions& options) { return Doctor(options)(); }

void doctor_on_node(const fs::path& directory) {
  records::write_record(
      directory / kAnswer,
      records::SlurmDoctor{host_name(), kNameAndVersion, read_file(directory / kToken, 100),
                           try_rename(directory), try_link(directory), try_lock(directory)});
}

DoctorCheck::Verdict worst_of(const std::vector<DoctorCheck>& checks) {
  CheckVerdict worst = CheckVerdict::kOk;
  for (const auto& check : checks) worst = std::max(worst, check.verdict);
  return worst;
}

std::string doctor_text(const std::vector<DoctorCheck>& checks) {
  std::string text;
  for (const auto& check : checks) {
    const char* verdict = check.verdict == CheckVerdict::kOk        ? "ok"
                          : check.verdict == CheckVerdict::kWarning ? "warning"
                                                                    : "failed";
    text += fmt::format("{:8} {}: {}\n", verdict, check.name, check.found);
    if (!check.advice.empty()) text += fmt::format("{:8} -> {}\n", "", check.advice);
  }
  return text;
}

}  // namespace lobelia

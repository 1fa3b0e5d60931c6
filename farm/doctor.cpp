#include "farm/doctor.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "base/system/files.hpp"
#include "base/system/host.hpp"
#include "base/system/process.hpp"
#include "base/system/write_limit.hpp"

namespace lobelia {
namespace {

std::string line(const char* name, bool ok, const char* if_ok, const char* otherwise,
                 const char* advice) {
  if (ok) return fmt::format("{:8} {}: {}\n", "ok", name, if_ok);
  return fmt::format("{:8} {}: {}\n{:8} -> {}\n", "warning", name, otherwise, "", advice);
}

std::string processes() {
  ProcessLimits limits;
  ProcessOptions options;
  options.on_start = [&](const ProcessLimits& found) { limits = found; };
  run_process({"/bin/true"}, options);
  return line("engines' processes", limits.contained == Containment::kPidNamespace,
              "a PID namespace for each: none can outlive its farm",
              "no PID namespace: a subreaper ends them, unless one kills that first",
              "allow user namespaces (kernel.unprivileged_userns_clone, user.max_user_namespaces)");
}

std::string writes() {
  const TemporaryDirectory directory;
  return line("engines' writing", WriteLimit(directory.path()).ruleset() >= 0,
              "Landlock holds each to a directory of its own",
              "no Landlock: they write wherever you may",
              "Linux 5.13 or later has it, if 'landlock' is among the kernel's lsm=");
}

std::string memory() {
  constexpr char kName[] = "engines' memory";
  if (memory_of_tree(::getpid()) == 0)
    return line(kName, false, "",
                "/proc is not there, or another PID namespace's: --memory has no effect",
                "mount /proc");
  return line(
      kName, count_of_oom_kills().has_value(),
      "held to --memory, and the kernel's own kills are known",
      "held to --memory; an engine that the kernel kills for want of memory counts as a crash",
      "Linux 4.13 or later tells oom_kill in /proc/vmstat");
}

}  // namespace

std::string doctor_text() { return processes() + writes() + memory(); }

}  // namespace lobelia

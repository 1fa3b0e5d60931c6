#include "farm/machine_doctor.hpp"

#include <unistd.h>

#include "core/files.hpp"
#include "core/host.hpp"
#include "core/process.hpp"

namespace lobelia {
namespace {

DoctorCheck check(const char* name, bool ok, const char* if_ok, const char* otherwise,
                  const char* advice) {
  if (ok) return {name, DoctorCheck::Verdict::kOk, if_ok, ""};
  return {name, DoctorCheck::Verdict::kWarning, otherwise, advice};
}

DoctorCheck processes() {
  ProcessLimits limits;
  ProcessOptions options;
  options.on_start = [&](const ProcessLimits& found) { limits = found; };
  run_process({"/bin/true"}, options);
  return check(
      "engines' processes", limits.contained == Containment::kPidNamespace,
      "a PID namespace for each: none can outlive its farm",
      "no PID namespace: a subreaper ends them, unless one kills that first",
      "allow user namespaces (kernel.unprivileged_userns_clone, user.max_user_namespaces)");
}

DoctorCheck writes() {
  const TemporaryDirectory directory;
  return check("engines' writing", WriteLimit(directory.path()).ruleset() >= 0,
               "Landlock holds each to a directory of its own",
               "no Landlock: they write wherever you may",
               "Linux 5.13 or later has it, if 'landlock' is among the kernel's lsm=");
}

DoctorCheck memory() {
  constexpr char kName[] = "engines' memory";
  if (memory_of_tree(::getpid()) == 0)
    return check(kName, false, "",
                 "/proc is not there, or another PID namespace's: --memory has no effect",
                 "mount /proc");
  return check(
      kName, count_of_oom_kills().has_value(),
      "held to --memory, and the kernel's own kills are known",
      "held to --memory; an engine that the kernel kills for want of memory counts as a crash",
      "Linux 4.13 or later tells oom_kill in /proc/vmstat");
}

}  // namespace

std::vector<DoctorCheck> look_at_machine() { return {processes(), writes(), memory()}; }

}  // namespace lobelia

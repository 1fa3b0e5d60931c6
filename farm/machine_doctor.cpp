#include "farm/machine_doctor.hpp"

#include <unistd.h>

#include "core/files.hpp"
#include "core/process.hpp"
#include "core/process_memory.hpp"

namespace lobelia {
namespace {

DoctorCheck processes() {
  ProcessLimits limits;
  ProcessOptions options;
  options.on_start = [&](const ProcessLimits& found) { limits = found; };
  run_process({"/bin/true"}, options);
  if (limits.contained == Containment::kPidNamespace)
    return {"engines' processes", DoctorCheck::Verdict::kOk,
            "a PID namespace for each: none can outlive its farm", ""};
  return {"engines' processes", DoctorCheck::Verdict::kWarning,
          "no PID namespace: a subreaper ends them, unless one kills that first",
          "allow user namespaces (kernel.unprivileged_userns_clone, user.max_user_namespaces)"};
}

DoctorCheck writes() {
  const TemporaryDirectory directory;
  if (WriteLimit(directory.path()).ruleset() >= 0)
    return {"engines' writing", DoctorCheck::Verdict::kOk,
            "Landlock holds each to a directory of its own", ""};
  return {"engines' writing", DoctorCheck::Verdict::kWarning,
          "no Landlock: they write wherever you may",
          "Linux 5.13 or later has it, if 'landlock' is among the kernel's lsm="};
}

DoctorCheck memory() {
  if (memory_of_tree(::getpid()) == 0)
    return {"engines' memory", DoctorCheck::Verdict::kWarning,
            "/proc is not there, or another PID namespace's: --memory has no effect",
            "mount /proc"};
  if (!count_of_oom_kills())
    return {
        "engines' memory", DoctorCheck::Verdict::kWarning,
        "held to --memory; an engine that the kernel kills for want of memory counts as a crash",
        "Linux 4.13 or later tells oom_kill in /proc/vmstat"};
  return {"engines' memory", DoctorCheck::Verdict::kOk,
          "held to --memory, and the kernel's own kills are known", ""};
}

}  // namespace

std::vector<DoctorCheck> look_at_machine() { return {processes(), writes(), memory()}; }

}  // namespace lobelia

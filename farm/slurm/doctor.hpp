// Checks of this machine and of a cluster, before the first run.
#pragma once

#include <chrono>
#include <filesystem>

#include "farm/slurm/slurm_options.hpp"

namespace lobelia {

struct DoctorCheck {
  enum class Verdict { kOk, kWarning, kFailed };
  std::string name;  ///< "hard links on a node"
  Verdict verdict = Verdict::kOk;
  std::string found;   ///< a sentence
  std::string advice;  ///< what to do; empty if nothing
};

struct DoctorOptions {
  SlurmOptions slurm;               ///< where the element on a node goes
  std::filesystem::path directory;  ///< where results would be put; made if it is not there
  std::filesystem::path program;    ///< run on the node as `PROGRAM farm doctor-on-node DIR`
  std::chrono::duration<double> call_limit = std::chrono::seconds(15);
  std::chrono::duration<double> node_limit = std::chrono::minutes(2);  ///< queue included
  std::chrono::duration<double> poll = std::chrono::seconds(1);
};

/// Tries the limits for engines on this machine: their processes, writing and memory. One that does not work is a warning.
std::vector<DoctorCheck> look_at_machine();

/// Asks Slurm, then lets a one-element job look at `directory` from a node; leaves out what cannot be asked after a
/// failure. Throws Error(kOutput) if the directory cannot be written, kInterrupted.
std::vector<DoctorCheck> doctor(const DoctorOptions& options);

/// The job's side, in a directory that doctor() made: writes what it finds to DIR/node.json.
void doctor_on_node(const std::filesystem::path& directory);

/// A line each, "ok", "warning" or "failed" first, and advice below.
std::string doctor_text(const std::vector<DoctorCheck>& checks);

/// The worst of all.
DoctorCheck::Verdict worst_of(const std::vector<DoctorCheck>& checks);

}  // namespace lobelia

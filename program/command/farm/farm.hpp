// The parts of `lobelia farm`: its options for Slurm, and its subcommands.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "base/system/error.hpp"
#include "base/system/leave.hpp"
#include "farm/slurm/slurm_farm.hpp"

namespace lobelia::cli {

/// Options of `lobelia farm` that are for Slurm alone.
class SlurmSettings {
 public:
  /// This object has to live as long as `command`.
  void add_to(CLI::App& command);
  bool is_wanted() const { return executor_ == "slurm"; }
  SlurmRunOptions run_options() const;

 private:
  std::string executor_ = "local";
  SlurmRunOptions run_;
  double poll_seconds_ = 1;
};

/// Follows a run on a cluster to its end, with its progress on stderr.
SlurmFarmSummary follow(SlurmRunOptions options,
                        const std::function<SlurmFarmSummary(const SlurmRunOptions&)>& run);

/// doctor, and the hidden exec-chunk, finish and doctor-on-node, which the elements of a run call.
void add_farm_slurm(CLI::App& farm, ExitCode& exit_code);
/// status, verify, gc, clean and explain.
void add_farm_upkeep(CLI::App& farm, ExitCode& exit_code);

/// The user's leave, by --allow-commands. Without that, warns once of doubtful folders that give it.
Leave leave_of_user(bool given);

}  // namespace lobelia::cli

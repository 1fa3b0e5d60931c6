// lobelia farm --executor slurm, doctor, and what the elements of a run call.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "core/error.hpp"
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
  SlurmOptions slurm_;
  double chunk_seconds_ = 60, poll_seconds_ = 1;
  int rounds_ = 3;
  bool detach_ = false;
};

/// Follows a run on a cluster to its end, with its progress on stderr.
SlurmFarmSummary follow(SlurmRunOptions options, bool quiet,
                        const std::function<SlurmFarmSummary(const SlurmRunOptions&)>& run);

/// doctor, and the hidden exec-chunk, finish and doctor-on-node.
void add_farm_slurm(CLI::App& farm, ExitCode& exit_code);

}  // namespace lobelia::cli

// A run on a Slurm cluster: missing jobs go out as arrays of elements. A job is done when its result is there; Slurm's
// answers are hints. An element may run twice, also at the same time: publishing has to allow for that.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "farm/slurm/chunks.hpp"
#include "farm/slurm/slurm_answers.hpp"
#include "farm/slurm/slurm_options.hpp"

namespace lobelia {

struct SlurmWork {
  /// The same for the same work, so that another client finds the run again. Holds slurm.json (its jobs), log/ and
  /// submit/ (scripts). On a file system that the nodes share.
  std::filesystem::path run_directory;
  /// Runs as `PROGRAM farm exec-chunk RUN_DIR NUMBER` for an element and `PROGRAM farm finish RUN_DIR` at the end.
  std::filesystem::path program;
  /// Jobs without a result that are still to be tried. Called before each round; empty ends the run.
  std::function<std::vector<SlurmJob>()> missing;
  /// Writes the jobs of element NUMBER: positions in the last answer of missing(). No number is used twice.
  std::function<void(std::size_t number, std::span<const std::size_t> jobs)> write_chunk;
  /// No node is left for these positions; missing() names them no more from now on.
  std::function<void(std::span<const std::size_t> jobs, const std::string& why)> give_up;
};

struct SlurmProgress {
  int round = 0;
  std::size_t pending = 0, running = 0, ended = 0;  ///< elements of the array that is waited for
  std::string reason;                               ///< why the first pending one waits
};

struct SlurmRunOptions {
  SlurmOptions slurm;
  ChunkRule chunks;     ///< slots and most_chunks are asked of Slurm
  int rounds = 3;       ///< times that missing jobs are submitted
  bool finish = true;   ///< a last element that runs `farm finish`
  bool detach = false;  ///< returns after submission; an interruption cancels nothing
  std::chrono::duration<double> call_limit = std::chrono::seconds(15);  ///< of Slurm's programs
  std::chrono::duration<double> first_poll = std::chrono::seconds(1);
  std::chrono::duration<double> last_poll = std::chrono::seconds(15);
  std::chrono::duration<double> stall = std::chrono::seconds(60);
  /// Time for a network file system to show what a node wrote, before it counts as missing.
  std::chrono::duration<double> settle = std::chrono::seconds(10);
  /// Asked on Ctrl-C: true cancels, false leaves the jobs running. Not set: cancels.
  std::function<bool()> cancel_on_interrupt;
  std::function<void(const std::string&)> say;            ///< a sentence now and then
  std::function<void(const SlurmProgress&)> on_progress;  ///< after each poll
};

struct SlurmOutcome {
  bool detached = false;              ///< jobs run on; nothing is known of the end
  int rounds = 0;                     ///< submitted by this call
  bool attached = false;              ///< it found jobs of an earlier client and waited for them
  std::vector<SlurmJobId> jobs;       ///< all that it submitted or found
  std::vector<std::string> missing;   ///< names without a result after the last round
  std::vector<std::string> given_up;  ///< names of those that no node is left for; not in `missing`
};

/// Runs until nothing is missing or the rounds are used up. Elements that ran out of time or memory get twice as much in
/// the next round. Nodes that handed work back (farm/chunk_report.hpp) get no more of it. If somebody cancelled elements
/// nothing more is submitted. Throws Error: kUsage (an option), kOutput (another client has the run, or the directory
/// cannot be written), kEngine (Slurm is absent or refuses, or the jobs stall), kInterrupted.
SlurmOutcome run_on_slurm(const SlurmWork& work, const SlurmRunOptions& options);

/// For cancel_on_interrupt: asks on the terminal. Without one, and at the end of input, true.
bool ask_whether_to_cancel();

/// A run as slurm.json and Slurm show it, without disturbing its client.
struct SlurmStatus {
  std::string name;  ///< of its jobs; empty: never submitted
  int round = 0;
  std::vector<SlurmLivingJob> living;
  SlurmProgress elements;  ///< of all that live
  std::string problem;     ///< Slurm did not answer: why
};
SlurmStatus slurm_status(const std::filesystem::path& run_directory,
                         std::chrono::duration<double> call_limit = std::chrono::seconds(15));

}  // namespace lobelia

// A run on a Slurm cluster: missing jobs go out as arrays of elements. A job is done when its result is there; Slurm's
// answers are hints. An element may run twice, also at the same time: publishing has to allow for that.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <span>

#include "base/system/sha256.hpp"
#include "farm/slurm/slurm_answers.hpp"
#include "farm/slurm/slurm_options.hpp"

namespace lobelia {

struct SlurmJob {
  std::string name;  ///< for messages
  int phase = 0;     ///< 0: pictures; 1: jobs that read them, which start after the last of phase 0
  double seconds = 1;  ///< estimate for one slot; at least a millisecond is assumed
  std::string
      batch;  ///< jobs of one batch, such as an engine's, are cheaper together; nodes hand back batches
};

struct ChunkRule {
  double target_seconds = 60;  ///< work in a chunk
  double least_seconds = 10;   ///< least work, unless all jobs have less: a start costs seconds
  std::size_t slots = 1;       ///< chunks that run at once
  std::size_t chunks_per_slot = 4;  ///< at least: then a slow or lost chunk delays the end little
  std::size_t most_chunks = 1000;   ///< with more work the chunks grow
};

/// Divides jobs into chunks, the costliest first: positions in `jobs`. A batch is spread over no more chunks than it
/// fills, and small batches share one. The same jobs give the same chunks; phases do not matter.
std::vector<std::vector<std::size_t>> make_chunks(std::span<const SlurmJob> jobs,
                                                  const ChunkRule& rule);

/// The cost of a chunk by the same rule.
double cost_of(std::span<const SlurmJob> jobs, std::span<const std::size_t> chunk);

struct SlurmWork {
  /// The same for the same work, so that another client finds the run again. Holds slurm.json (its jobs), log/ and submit/
  /// (scripts), on a file system that the nodes share.
  std::filesystem::path run_directory;
  /// Called as `PROGRAM farm exec-chunk RUN_DIR NUMBER --sha256 HASH --allow-commands` for an element and
  /// `PROGRAM farm finish RUN_DIR --sha256 HASH --allow-commands` at the end.
  std::filesystem::path program;
  /// Jobs without a result that are still to be tried. Called before each round; an empty list ends the run.
  std::function<std::vector<SlurmJob>()> missing;
  /// Writes the jobs of element NUMBER: positions in the last list of missing(). No number is used twice. Returns the
  /// hash of what it wrote: the element does nothing else, whoever may write into the directory meanwhile.
  std::function<Sha256Digest(std::size_t number, std::span<const std::size_t> jobs)> write_chunk;
  /// No node is left for these positions; from now on missing() omits them.
  std::function<void(std::span<const std::size_t> jobs, const std::string& why)> give_up;
  Sha256Digest run_record = {};  ///< of what the last element may be told; it gets this hash
};

struct SlurmProgress {
  int round = 0;
  std::size_t pending = 0, running = 0, ended = 0;  ///< elements of the array at hand
  std::string reason;                               ///< why the first pending one waits
};

struct SlurmRunOptions {
  SlurmOptions slurm;
  ChunkRule chunks;     ///< without slots and most_chunks, which Slurm is asked for
  int rounds = 3;       ///< how often missing jobs are submitted
  bool finish = true;   ///< submits a last element that runs `farm finish`
  bool detach = false;  ///< returns after submission; an interruption cancels nothing
  std::chrono::duration<double> call_limit = std::chrono::seconds(15);  ///< for Slurm's programs
  std::chrono::duration<double> first_poll = std::chrono::seconds(1);
  std::chrono::duration<double> last_poll = std::chrono::seconds(15);
  std::chrono::duration<double> stall = std::chrono::seconds(60);
  /// Time that a network file system gets to show results before they count as missing.
  std::chrono::duration<double> settle = std::chrono::seconds(10);
  /// Called on Ctrl-C: true cancels, false leaves the jobs running. Null: cancels.
  std::function<bool()> cancel_on_interrupt;
  std::function<void(const std::string&)> say;            ///< gets a sentence now and then
  std::function<void(const SlurmProgress&)> on_progress;  ///< after each poll
};

struct SlurmOutcome {
  bool detached = false;              ///< jobs run on, with an unknown end
  int rounds = 0;                     ///< submitted by this call
  bool attached = false;              ///< it found jobs of an earlier client and waited for them
  std::vector<SlurmJobId> jobs;       ///< submitted or found
  std::vector<std::string> missing;   ///< jobs without a result after the last round
  std::vector<std::string> given_up;  ///< jobs without a node; not in `missing`
};

/// Runs until nothing is missing or the rounds are used up. Elements that ran out of time or memory get twice as much in
/// the next round. Nodes that handed work back (farm/chunk.hpp) get no more of it. Once somebody cancels elements,
/// submits nothing more. Throws Error: kUsage (an option), kOutput (another client has the run, or the directory cannot
/// be written), kEngine (Slurm is absent or refuses, or the jobs stall), kInterrupted.
SlurmOutcome run_on_slurm(const SlurmWork& work, const SlurmRunOptions& options);

/// For cancel_on_interrupt: asks on the terminal. True without one, and at the end of input.
bool ask_whether_to_cancel();

/// A run according to slurm.json and Slurm; does not disturb its client.
struct SlurmStatus {
  std::string name;     ///< of its jobs; empty: never submitted
  std::string foreign;  ///< a sentence, if slurm.json names jobs that are not this directory's
  int round = 0;
  std::vector<SlurmLivingJob> living;
  SlurmProgress elements;  ///< of all living jobs
  std::string problem;     ///< why Slurm did not answer; empty if it did
};
SlurmStatus slurm_status(const std::filesystem::path& run_directory,
                         std::chrono::duration<double> call_limit = std::chrono::seconds(15));

}  // namespace lobelia

// Jobs of unequal cost into the elements of an array job.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lobelia {

struct SlurmJob {
  std::string name;  ///< for messages
  int phase = 0;     ///< 0 pictures; 1 what reads them: starts when every job of phase 0 has ended
  double seconds =
      1;  ///< estimated on one slot; what is no positive number counts as a millisecond
  /// Jobs of one batch are cheaper together: an engine that starts slowly. An engine's name where there is one,
  /// because a node may hand back one engine's jobs.
  std::string batch;
};

struct ChunkRule {
  double target_seconds = 60;  ///< of work in a chunk
  double least_seconds = 10;   ///< none has less, unless all have: starting one costs seconds
  std::size_t slots = 1;       ///< chunks that run at once
  std::size_t chunks_per_slot =
      4;  ///< at least, where work allows: a slow or lost one makes no long tail
  std::size_t most_chunks = 1000;  ///< then they grow
};

/// Positions in `jobs`, chunk by chunk, the costliest chunk first and in a chunk as they came; each job is in
/// one chunk. A batch is spread over no more chunks than its cost fills, and small batches share one.
/// Longest first onto the lightest; the same jobs give the same chunks. Phases are not looked at.
std::vector<std::vector<std::size_t>> make_chunks(std::span<const SlurmJob> jobs,
                                                  const ChunkRule& rule);

/// What a chunk is taken to cost, by the same reading of `seconds`.
double cost_of(std::span<const SlurmJob> jobs, std::span<const std::size_t> chunk);

}  // namespace lobelia

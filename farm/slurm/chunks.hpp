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
  double seconds = 1;  ///< estimated on one slot; no positive number counts as a millisecond
  /// Jobs of one batch are cheaper together, such as those of an engine that starts slowly. The engine's name where there
  /// is one, because a node may hand back one engine's jobs.
  std::string batch;
};

struct ChunkRule {
  double target_seconds = 60;       ///< of work in a chunk
  double least_seconds = 10;        ///< none has less, unless all have: starting one costs seconds
  std::size_t slots = 1;            ///< chunks that run at once
  std::size_t chunks_per_slot = 4;  ///< at least, so that a slow or lost one makes no long tail
  std::size_t most_chunks = 1000;   ///< then they grow
};

/// Positions in `jobs`, chunk by chunk, the costliest chunk first. A batch is spread over no more chunks than its cost
/// fills, and small batches share one. The same jobs give the same chunks, whatever their phases.
std::vector<std::vector<std::size_t>> make_chunks(std::span<const SlurmJob> jobs,
                                                  const ChunkRule& rule);

/// The cost of a chunk by the same rule.
double cost_of(std::span<const SlurmJob> jobs, std::span<const std::size_t> chunk);

}  // namespace lobelia

#include "farm/slurm/slurm_run.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

namespace lobelia {
namespace {

struct Chunk {
  std::vector<std::size_t> jobs;
  double seconds = 0;
};
using Chunks = std::vector<Chunk>;

double seconds_of(const SlurmJob& job) {
  // fmax: a NaN is the lower bound.
  return std::fmin(std::fmax(job.seconds, 1e-3), 1e7);
}

bool costs_more(const Chunk& a, const Chunk& b) { return a.seconds > b.seconds; }

/// The jobs of each batch, longest first; the costliest batch first.
Chunks batches_of(std::span<const SlurmJob> jobs) {
  std::map<std::string_view, std::size_t> index;
  Chunks batches;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto [at, added] = index.try_emplace(jobs[i].batch, batches.size());
    if (added) batches.emplace_back();
    batches[at->second].jobs.push_back(i);
    batches[at->second].seconds += seconds_of(jobs[i]);
  }
  for (Chunk& batch : batches)
    std::ranges::stable_sort(batch.jobs, std::greater<>(),
                             [&](std::size_t job) { return seconds_of(jobs[job]); });
  std::ranges::stable_sort(batches, costs_more);
  return batches;
}

/// Spreads a batch over `count` chunks: longest job first, onto the lightest chunk.
Chunks spread(const Chunk& batch, std::size_t count, std::span<const SlurmJob> jobs) {
  using Load = std::pair<double, std::size_t>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> lightest;
  for (std::size_t i = 0; i < count; ++i) lightest.emplace(0.0, i);
  Chunks chunks(count);
  for (const std::size_t job : batch.jobs) {
    const std::size_t i = lightest.top().second;
    lightest.pop();
    chunks[i].jobs.push_back(job);
    chunks[i].seconds += seconds_of(jobs[job]);
    lightest.emplace(chunks[i].seconds, i);
  }
  return chunks;
}

void merge(Chunk& into, const Chunk& from) {
  into.jobs.insert(into.jobs.end(), from.jobs.begin(), from.jobs.end());
  into.seconds += from.seconds;
}

/// Merges the lightest chunk into the next until none is below `least`, or one is left.
void merge_light(Chunks& chunks, double least) {
  std::ranges::stable_sort(chunks, costs_more);
  while (chunks.size() > 1 && chunks.back().seconds < least) {
    const Chunk light = std::move(chunks.back());
    chunks.pop_back();
    Chunk next = std::move(chunks.back());
    chunks.pop_back();
    merge(next, light);
    chunks.insert(std::ranges::upper_bound(chunks, next, costs_more), std::move(next));
  }
}

Chunks chunks_of_size(const Chunks& batches, double size, double least,
                      std::span<const SlurmJob> jobs) {
  Chunks chunks, shared;
  for (const Chunk& batch : batches) {
    if (batch.seconds >= size) {
      const auto count = std::min(std::size_t(batch.seconds / size + 1e-9), batch.jobs.size());
      Chunks own = spread(batch, std::max<std::size_t>(count, 1), jobs);
      merge_light(own, least);
      std::ranges::move(own, std::back_inserter(chunks));
      continue;
    }
    const auto room = std::ranges::find_if(
        shared, [&](const Chunk& chunk) { return chunk.seconds + batch.seconds <= size; });
    if (room == shared.end())
      shared.push_back(batch);
    else
      merge(*room, batch);
  }
  std::ranges::move(shared, std::back_inserter(chunks));
  merge_light(chunks, least);
  return chunks;
}

}  // namespace

double cost_of(std::span<const SlurmJob> jobs, std::span<const std::size_t> chunk) {
  double seconds = 0;
  for (const std::size_t job : chunk) seconds += seconds_of(jobs[job]);
  return seconds;
}

std::vector<std::vector<std::size_t>> make_chunks(std::span<const SlurmJob> jobs,
                                                  const ChunkRule& rule) {
  if (jobs.empty()) return {};
  const Chunks batches = batches_of(jobs);
  double total = 0;
  for (const Chunk& batch : batches) total += batch.seconds;
  const std::size_t most = std::max<std::size_t>(rule.most_chunks, 1);
  const double wanted = double(std::max<std::size_t>(rule.slots * rule.chunks_per_slot, 1));
  double size = std::max(
      {std::min(rule.target_seconds, total / wanted), rule.least_seconds, total / double(most)});
  Chunks chunks = chunks_of_size(batches, size, rule.least_seconds, jobs);
  while (chunks.size() > most) {  // many batches may each leave a chunk that is not full
    size *= 1.25;
    chunks = chunks_of_size(batches, size, rule.least_seconds, jobs);
  }
  std::vector<std::vector<std::size_t>> result;
  for (Chunk& chunk : chunks) {
    std::ranges::sort(chunk.jobs);
    result.push_back(std::move(chunk.jobs));
  }
  return result;
}

}  // namespace lobelia

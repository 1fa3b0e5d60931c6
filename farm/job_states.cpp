#include "farm/job_states.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "base/system/interrupt.hpp"
#include "farm/make_result.hpp"

namespace lobelia {
namespace {

using Failures = JobStateFilter::Failures;

/// Whether a result was made from the cell's pictures in the cache. `find` returns a picture's record, or null.
template <class Find>
bool is_of_these_pictures(const records::Result& record, const JobGraph& graph, std::size_t cell,
                          Find find) {
  if (!record.from) return true;
  return std::ranges::all_of(*record.from, [&](const auto& picture) {
    const auto& [whose, hash] = picture;
    for (const JobIndex job : graph.jobs(cell)) {
      if (!is_picture(graph[job].kind) || graph.whose(job) != whose) continue;
      const auto& found = find(job);
      return found && found->hash_of(picture_file(whose)) == hash;
    }
    return false;
  });
}

/// Drops waiting jobs that need a result which is neither there nor to be made.
void drop_unreachable_jobs(const JobGraph& graph, std::size_t cell, std::vector<JobState>& states) {
  for (const JobIndex job : graph.jobs(cell)) {
    if (states[graph.place(job)] != JobState::kWaiting) continue;
    for (const JobIndex input : graph.inputs(job))
      if (const JobState state = states[graph.place(input)];
          state == JobState::kAbsent || (state == JobState::kFailed && !graph.may_lack(job, input)))
        states[graph.place(job)] = JobState::kAbsent;
  }
}

}  // namespace

CellRecords find_records(const JobGraph& graph, const ResultCache& cache, std::size_t cell,
                         ResultCache::Look look) {
  CellRecords records(graph.stride());
  for (const JobIndex job : graph.jobs(cell)) {
    auto& record = records[graph.place(job)];
    record = cache.find(graph[job].key, look);
    if (record && !is_of_these_pictures(
                      *record, graph, cell, [&](JobIndex picture) -> const auto& {
                        return records[graph.place(picture)];
                      }))
      record.reset();
  }
  return records;
}

std::optional<records::Result> find_result(const JobGraph& graph, const ResultCache& cache,
                                           JobIndex job, ResultCache::Look look) {
  auto record = cache.find(graph[job].key, look);
  if (record && !is_of_these_pictures(*record, graph, graph.cell_of(job), [&](JobIndex picture) {
        return cache.find(graph[picture].key);
      }))
    record.reset();
  return record;
}

CellStates cell_states(JobGraph& graph, const ResultCache* cache, const JobStateFilter& filter,
                       std::size_t cell) {
  CellStates found{std::vector<JobState>(graph.stride()), CellRecords(graph.stride())};
  const auto look = [&] {
    if (cache) found.records = find_records(graph, *cache, cell, filter.look);
  };
  const auto is_there = [&](JobIndex job) { return found.records[graph.place(job)].has_value(); };
  const auto has_failed = [&](JobIndex job) {
    return cache && !is_there(job) && cache->failure(graph[job].key).has_value();
  };
  look();
  // Without the pictures of absent engines the profile is another result.
  bool is_narrower = false;
  for (std::size_t e = 0; e < graph.engines().size(); ++e) {
    const JobIndex reference = graph.reference(cell, e);
    if (graph.engines()[e].is_here() || !graph[reference].exists || is_there(reference)) continue;
    graph.leave_out(cell, e);
    is_narrower = true;
  }
  if (filter.failures == Failures::kCount && graph[graph.profile(cell)].exists) {
    graph.narrow_profile(cell, [&](JobIndex picture) { return !has_failed(picture); });
    is_narrower = true;
  }
  if (is_narrower) look();
  for (const JobIndex job : graph.jobs(cell)) {
    const bool wanted = !filter.wanted || filter.wanted(job);
    const bool failure_counts = filter.failures == Failures::kCount ||
                                (filter.failures == Failures::kOfOthersCount && !wanted);
    JobState& state = found.states[graph.place(job)];
    if (is_there(job) && !(wanted && filter.again && filter.again(job)))
      state = JobState::kDone;
    else if (failure_counts && has_failed(job))
      state = JobState::kFailed;
    else if (wanted)
      state = JobState::kWaiting;
  }
  drop_unreachable_jobs(graph, cell, found.states);
  return found;
}

std::vector<JobState> job_states(
    JobGraph& graph, const ResultCache* cache, const JobStateFilter& filter,
    const std::function<void(std::size_t cell, const CellStates&)>& on_cell) {
  std::vector<JobState> states(graph.size());
  oneapi::tbb::parallel_for(std::size_t{0}, graph.cell_count(), [&](std::size_t cell) {
    throw_if_interrupted();
    const CellStates found = cell_states(graph, cache, filter, cell);
    std::ranges::copy(found.states, states.begin() + std::ptrdiff_t(graph.render(cell)));
    if (on_cell) on_cell(cell, found);
  });
  return states;
}

}  // namespace lobelia

#include "farm/job_board.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/interrupt.hpp"

namespace lobelia {

std::vector<std::vector<JobIndex>> JobBoard::plan(const std::vector<std::size_t>& order) {
  const std::scoped_lock lock(mutex_);
  rank_.assign(graph_.cell_count(), 0);
  std::vector<std::vector<JobIndex>> of_engine(graph_.engines().size());
  for (std::size_t place = 0; place < order.size(); ++place) {
    const std::size_t cell = order[place];
    rank_[cell] = std::uint32_t(place);
    for (const JobIndex job : graph_.jobs(cell)) {
      if (states_[job] != JobState::kWaiting) continue;
      ++waiting_in_cell_[cell];
      ++planned_;
      ++stage_of(job).count;
      if (!is_made_here(job)) {
        of_engine[graph_[job].engine].push_back(job);
        continue;
      }
      ++left_here_;
      if (inputs_are_settled(job)) make_ready(job);
    }
  }
  return of_engine;
}

JobState JobBoard::state(JobIndex job) const {
  const std::scoped_lock lock(mutex_);
  return states_[job];
}

bool JobBoard::is_made_here(JobIndex job) const {
  const Job& one = graph_[job];
  return one.kind != JobKind::kReference || !graph_.engines()[one.engine].engine->info().is_program;
}

std::optional<JobIndex> JobBoard::next() {
  std::unique_lock lock(mutex_);
  while (!is_over_locked() && left_here_ > 0) {
    for (const auto now = Clock::now(); !put_back_.empty() && put_back_.front().first <= now;
         put_back_.pop_front())
      make_ready(put_back_.front().second);
    if (!finished_cells_.empty()) {
      lock.unlock();
      finish_cells();
      lock.lock();
      continue;
    }
    if (!ready_.empty()) {
      const JobIndex job = ready_.top().job;
      ready_.pop();
      return job;
    }
    changed_.wait_for(lock, kLookAgain);
  }
  return std::nullopt;
}

void JobBoard::put_back(JobIndex job) {
  const std::scoped_lock lock(mutex_);
  put_back_.emplace_back(Clock::now() + kLookAgain, job);
}

void JobBoard::settle(JobIndex job, JobState state) {
  const std::scoped_lock lock(mutex_);
  settle_locked(job, state);
}

void JobBoard::settle_locked(JobIndex job, JobState state) {
  states_[job] = state;
  if (is_made_here(job)) --left_here_;
  ++settled_;
  ++stage_of(job).done;
  show_progress();
  for (const JobIndex next : graph_.dependents(job)) {
    if (states_[next] != JobState::kWaiting) continue;
    // A picture that was lost is made again, so nothing is made without it.
    const bool can_be_lacking = state == JobState::kFailed && graph_.may_lack(next, job);
    if (state == JobState::kAbsent)
      settle_locked(next, state);
    else if (state != JobState::kDone && !can_be_lacking)
      settle_locked(next, JobState::kBlocked);
    else if (inputs_are_settled(next))
      make_ready(next);
  }
  const std::size_t cell = graph_.cell_of(job);
  if (--waiting_in_cell_[cell] == 0) finished_cells_.push_back(cell);
  changed_.notify_all();
}

bool JobBoard::inputs_are_settled(JobIndex job) const {
  return std::ranges::all_of(graph_.inputs(job), [&](JobIndex input) {
    return states_[input] == JobState::kDone ||
           (graph_.may_lack(job, input) && states_[input] == JobState::kFailed);
  });
}

void JobBoard::make_ready(JobIndex job) {
  // Comparisons and profiles first: they finish cells, and few are ready at a time.
  const int urgency = is_picture(graph_[job].kind) ? 1 : 0;
  ready_.push({{urgency, rank_[graph_.cell_of(job)]}, job});
}

JobBoard::Stage& JobBoard::stage_of(JobIndex job) {
  const Job& one = graph_[job];
  const std::string name = one.kind == JobKind::kReference ? graph_.engines()[one.engine].name
                           : one.kind == JobKind::kRender  ? kOurs
                                                           : kJobKindNames[int(one.kind)].data();
  const auto found = std::ranges::find(stages_, name, &Stage::name);
  return found == stages_.end() ? stages_.emplace_back(Stage{name}) : *found;
}

void JobBoard::show_progress() {
  if (!options_.on_progress) return;
  FarmProgress progress{settled_, planned_, ""};
  for (const Stage& stage : stages_)
    if (stage.done < stage.count)
      progress.running += fmt::format("{}{} {}/{}", progress.running.empty() ? "" : ", ",
                                      stage.name, stage.done, stage.count);
  options_.on_progress(progress);
}

void JobBoard::finish_cells() {
  while (true) {
    std::size_t cell = 0;
    {
      const std::scoped_lock lock(mutex_);
      if (finished_cells_.empty()) return;
      cell = finished_cells_.front();
      finished_cells_.pop_front();
    }
    on_cell_(cell);
  }
}

void JobBoard::stop() {
  const std::scoped_lock lock(mutex_);
  stopped_ = true;
}

void JobBoard::break_off(std::exception_ptr error) {
  const std::scoped_lock lock(mutex_);
  if (!broken_) broken_ = std::move(error);
  changed_.notify_all();
}

bool JobBoard::is_over() const {
  const std::scoped_lock lock(mutex_);
  return is_over_locked();
}

bool JobBoard::is_over_locked() const { return broken_ || stopped_ || interrupted(); }

void JobBoard::finish_failed_cells() {
  if (broken_ || interrupted()) return;
  for (const auto& [cell, waiting] : waiting_in_cell_)
    if (waiting > 0 && std::ranges::any_of(graph_.jobs(cell), [&](JobIndex job) {
          return states_[job] == JobState::kFailed;
        }))
      finished_cells_.push_back(cell);
  finish_cells();
}

void JobBoard::end() const {
  if (broken_) std::rethrow_exception(broken_);
  throw_if_interrupted();
}

void JobBoard::count(const std::function<void(JobRunWork&)>& change) {
  const std::scoped_lock lock(mutex_);
  change(work_);
}

}  // namespace lobelia

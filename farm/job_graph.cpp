#include "farm/job_graph.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <mutex>
#include <numeric>

#include "base/system/interrupt.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {

JobGraph::JobGraph(const FarmCells& cells, const std::vector<FarmEngine>& engines,
                   std::chrono::duration<double> time_limit)
    : cells_(&cells),
      engines_(&engines),
      time_limit_(time_limit),
      own_(own_identity().text()),
      stride_(2 + 2 * engines.size()),
      jobs_(cells.cells.size() * stride_),
      scenes_(cells.cells.size()) {
  for (std::size_t e = 0; e < engines.size(); ++e)
    if (engines[e].name == cells.truth) truth_ = e;
  std::mutex mutex;
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, cell_count()),
                            [&](const auto& range) {
                              std::map<std::size_t, std::string> refusals;
                              for (std::size_t cell = range.begin(); cell < range.end(); ++cell)
                                plan_cell(cell, refusals);
                              const std::scoped_lock lock(mutex);
                              refusals_.merge(refusals);
                            });
}

void JobGraph::plan_cell(std::size_t cell, std::map<std::size_t, std::string>& refusals) {
  throw_if_interrupted();
  const Scene scene = cells_->scene(cell);
  scenes_[cell] = sha256(scene_to_xml(scene));
  const std::string_view scene_part(reinterpret_cast<const char*>(scenes_[cell].data()),
                                    scenes_[cell].size());
  const auto set = [&](JobIndex at, JobKind kind, std::size_t engine, const ResultKey& key) {
    jobs_[at] = {key, kind, std::uint8_t(engine), true};
  };
  const ResultKey ours = result_key({"render", own_, scene_part});
  set(render(cell), JobKind::kRender, kNoEngine, ours);
  const auto& compared_with = cells_->cells[cell].engines;
  std::vector<bool> with_engine(engines_->size());
  for (std::size_t e = 0; e < engines_->size(); ++e) {
    const FarmEngine& here = (*engines_)[e];
    if (!here.is_known() || std::ranges::find(compared_with, here.name) == compared_with.end())
      continue;
    if (std::string why = here.engine->why_not(scene, {}, axes(cell)); !why.empty()) {
      refusals.emplace(cell * engines_->size() + e, std::move(why));
      continue;
    }
    std::vector<std::string_view> parts{"reference",  own_,         here.name,
                                        here.version, here.content, scene_part};
    const std::string more = here.engine->key_part(scene.film, axes(cell), time_limit_);
    if (!more.empty()) parts.push_back(more);
    set(reference(cell, e), JobKind::kReference, e, result_key(parts));
    with_engine[e] = true;
  }
  plan_comparisons(cell);
  if (!scene.lights.empty() && !scene.spheres.empty() && beyond_single_rays(scene).empty())
    set(profile(cell), JobKind::kProfile, kNoEngine, profile_key(cell, with_engine));
}

void JobGraph::plan_comparisons(std::size_t cell) {
  for (std::size_t e = 0; e < engines_->size(); ++e) {
    const Job& theirs = jobs_[reference(cell, e)];
    if (!theirs.exists) continue;
    std::vector<std::string_view> parts{"compare", own_, as_part(jobs_[render(cell)].key),
                                        as_part(theirs.key)};
    if (is_with_truth(cell, e)) parts.push_back(as_part(jobs_[reference(cell, *truth_)].key));
    // A tolerance of the catalogue is a part of our program.
    const EngineFloor& floor = (*engines_)[e].engine->info().floor;
    const std::string judged = fmt::format("{},{}", floor.of_value, floor.of_peak);
    if ((*engines_)[e].engine->outside()) parts.push_back(judged);
    jobs_[compare(cell, e)] = {result_key(parts), JobKind::kCompare, std::uint8_t(e), true};
  }
}

ResultKey JobGraph::profile_key(std::size_t cell, const std::vector<bool>& with_engine) const {
  std::string references;
  for (std::size_t e = 0; e < engines_->size(); ++e)
    if (with_engine[e]) references += as_part(jobs_[reference(cell, e)].key);
  return result_key({cells_->ours ? "profile" : "profile without ours", own_,
                     as_part(jobs_[render(cell)].key), references});
}

void JobGraph::narrow_profile(std::size_t cell, const std::function<bool(JobIndex)>& has_picture) {
  std::vector<bool> with_engine(engines_->size());
  for (std::size_t e = 0; e < with_engine.size(); ++e)
    with_engine[e] = jobs_[reference(cell, e)].exists && has_picture(reference(cell, e));
  jobs_[profile(cell)].key = profile_key(cell, with_engine);
}

std::vector<JobIndex> JobGraph::jobs(std::size_t cell) const {
  std::vector<JobIndex> found;
  for (JobIndex job = render(cell); job <= profile(cell); ++job)
    if (jobs_[job].exists) found.push_back(job);
  return found;
}

std::vector<JobIndex> JobGraph::inputs(JobIndex job) const {
  const std::size_t cell = cell_of(job);
  const Job& one = jobs_[job];
  if (is_picture(one.kind)) return {};
  // Ours comes last where it only says at what exposure the others are shown.
  if (one.kind == JobKind::kCompare && is_with_truth(cell, one.engine))
    return {reference(cell, one.engine), reference(cell, *truth_), render(cell)};
  if (one.kind == JobKind::kCompare) return {render(cell), reference(cell, one.engine)};
  std::vector<JobIndex> pictures = jobs(cell);
  std::erase_if(pictures, [&](JobIndex picture) { return !is_picture(jobs_[picture].kind); });
  return pictures;
}

std::vector<JobIndex> JobGraph::dependents(JobIndex job) const {
  const std::size_t cell = cell_of(job);
  std::vector<JobIndex> found;
  const auto add = [&](JobIndex at) {
    if (jobs_[at].exists) found.push_back(at);
  };
  if (jobs_[job].kind == JobKind::kRender || (truth_ && job == reference(cell, *truth_)))
    for (std::size_t e = 0; e < engines_->size(); ++e) add(compare(cell, e));
  else if (jobs_[job].kind == JobKind::kReference)
    add(compare(cell, jobs_[job].engine));
  else
    return found;
  add(profile(cell));
  return found;
}

std::string JobGraph::name(JobIndex job) const {
  return cells_->cells[cell_of(job)].id + "/" + name_in_cell(job);
}

std::string JobGraph::name_in_cell(JobIndex job) const {
  const Job& one = jobs_[job];
  return job_name(one.kind, one.engine == kNoEngine ? "" : (*engines_)[one.engine].name);
}

std::string JobGraph::whose(JobIndex job) const {
  const std::uint8_t engine = jobs_[job].engine;
  return engine == kNoEngine ? kOurs : (*engines_)[engine].name;
}

std::string JobGraph::refusal(std::size_t cell, std::size_t engine) const {
  const auto found = refusals_.find(cell * engines_->size() + engine);
  return found == refusals_.end() ? "" : found->second;
}

std::vector<std::size_t> JobGraph::missing_engines(std::size_t cell) const {
  std::vector<std::size_t> missing;
  const auto& wanted = cells_->cells[cell].engines;
  for (std::size_t e = 0; e < engines_->size(); ++e)
    if (!(*engines_)[e].is_here() && !jobs_[reference(cell, e)].exists &&
        std::ranges::find(wanted, (*engines_)[e].name) != wanted.end())
      missing.push_back(e);
  return missing;
}

std::size_t JobGraph::refusals(std::size_t engine) const {
  return std::size_t(std::ranges::count_if(
      refusals_, [&](const auto& refusal) { return refusal.first % engines_->size() == engine; }));
}

void JobGraph::leave_out(std::size_t cell, std::size_t engine) {
  jobs_[reference(cell, engine)].exists = jobs_[compare(cell, engine)].exists = false;
  if (truth_ == engine)
    for (std::size_t e = 0; e < engines_->size(); ++e) jobs_[compare(cell, e)].exists = false;
  if (jobs_[profile(cell)].exists) narrow_profile(cell, [](JobIndex) { return true; });
}

std::vector<std::size_t> coarse_to_fine(const std::vector<Cell>& cells) {
  std::size_t most = 1;
  for (const auto& cell : cells)
    for (const auto index : cell.at) most = std::max<std::size_t>(most, index + 1);
  // The level of an index: how often the axis is halved until it is reached.
  const int levels = int(std::bit_width(most - 1));
  std::vector<int> level(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (const auto index : cells[i].at)
      if (index > 0) level[i] = std::max(level[i], levels - std::countr_zero(std::uint64_t(index)));
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t cell) { return level[cell]; });
  return order;
}

}  // namespace lobelia

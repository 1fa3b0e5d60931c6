// Every job of every cell, with the key of its result and what it waits for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "farm/farm_engines.hpp"
#include "farm/grid.hpp"
#include "farm/job.hpp"
#include "farm/own_identity.hpp"

namespace lobelia {

/// A grid's cells, or a part of them on another machine. Scenes are made when they are needed.
struct FarmCells {
  std::vector<Cell> cells;
  std::function<Scene(std::size_t)> scene;  ///< of a cell; from any thread
};

/// A place among all jobs.
using JobIndex = std::uint32_t;

class JobGraph {
 public:
  /// Keys of all jobs, on all processors. Both arguments must outlive the graph.
  JobGraph(const FarmCells& cells, const std::vector<FarmEngine>& engines);

  std::size_t cell_count() const { return cells_->cells.size(); }
  std::size_t size() const { return jobs_.size(); }
  const FarmCells& cells() const { return *cells_; }
  const std::vector<FarmEngine>& engines() const { return *engines_; }

  const Job& operator[](JobIndex job) const { return jobs_[job]; }
  std::size_t cell_of(JobIndex job) const { return job / stride_; }
  JobIndex render(std::size_t cell) const { return JobIndex(cell * stride_); }
  JobIndex reference(std::size_t cell, std::size_t engine) const {
    return JobIndex(cell * stride_ + 1 + engine);
  }
  JobIndex compare(std::size_t cell, std::size_t engine) const {
    return JobIndex(cell * stride_ + 1 + engines_->size() + engine);
  }
  JobIndex profile(std::size_t cell) const { return JobIndex((cell + 1) * stride_ - 1); }
  /// The jobs that a cell has.
  std::vector<JobIndex> jobs(std::size_t cell) const;
  std::size_t stride() const { return stride_; }  ///< places of a cell; some have no job
  std::size_t place(JobIndex job) const { return job % stride_; }

  /// Jobs that must have their results first.
  std::vector<JobIndex> inputs(JobIndex job) const;
  /// Jobs that have this one among their inputs.
  std::vector<JobIndex> dependents(JobIndex job) const;

  /// "n16-head_on/compare-povray", as `--filter` sees it.
  std::string name(JobIndex job) const;
  std::string name_in_cell(JobIndex job) const;  ///< "compare-povray"
  /// Whose picture a job is about: an engine's, or ours.
  std::string whose(JobIndex job) const;

  /// Why an engine cannot show the cell's scene; empty if it can.
  std::string refusal(std::size_t cell, std::size_t engine) const;

  /// Engines that the cell is to be compared with, that are absent, and of which it has no picture.
  std::vector<std::size_t> missing_engines(std::size_t cell) const;
  /// The number of cells that an engine cannot show.
  std::size_t refusals(std::size_t engine) const;
  /// The cell has no picture of this engine: it is no job, nor is its comparison.
  void leave_out(std::size_t cell, std::size_t engine);

  /// Whether a job can be done though this input has failed: a profile draws the pictures that there are.
  bool may_lack(JobIndex job, JobIndex input) const {
    return jobs_[job].kind == JobKind::kProfile && jobs_[input].kind == JobKind::kReference;
  }
  /// Makes the profile one of fewer pictures, which is another result: of ours and those for which `has_picture` holds.
  void narrow_profile(std::size_t cell, const std::function<bool(JobIndex)>& has_picture);

  /// The hash of a cell's scene file, in hexadecimal.
  std::string scene_hash(std::size_t cell) const { return hex(scenes_[cell]); }

 private:
  ResultKey profile_key(std::size_t cell, const std::vector<bool>& with_engine) const;
  void plan_cell(std::size_t cell, std::map<std::size_t, std::string>& refusals);

  const FarmCells* cells_;
  const std::vector<FarmEngine>* engines_;
  std::string own_;  ///< own_identity(), as a part of every key
  std::size_t stride_;
  std::vector<Job> jobs_;
  std::vector<Sha256Digest> scenes_;
  std::map<std::size_t, std::string> refusals_;  ///< by cell * engines + engine; few have one
};

/// Cells from coarse to fine, so that any first part is spread over the whole grid: the first value of each axis, then
/// the one in the middle, then those between.
std::vector<std::size_t> coarse_to_fine(const std::vector<Cell>& cells);

}  // namespace lobelia

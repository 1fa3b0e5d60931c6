// Every job of every cell, with the key of its result and its inputs.
#pragma once

#include <chrono>
#include <cstddef>

#include "farm/farm_engines.hpp"
#include "farm/grid.hpp"
#include "farm/job.hpp"
#include "farm/own_identity.hpp"

namespace lobelia {

/// A grid's cells, or a part of them on another machine. Scenes are made on demand.
struct FarmCells {
  std::vector<Cell> cells;
  std::function<Scene(std::size_t)> scene;  ///< of a cell; for any thread
  std::string truth = {};                   ///< Grid::truth
  bool ours = true;                         ///< Grid::ours
};

using JobIndex = std::uint32_t;

class JobGraph {
 public:
  /// Computes all keys, on all processors. Cells and engines must outlive the graph. `time_limit` is for the hash of a
  /// picture that is there.
  JobGraph(const FarmCells& cells, const std::vector<FarmEngine>& engines,
           std::chrono::duration<double> time_limit);

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
  /// The existing jobs of a cell.
  std::vector<JobIndex> jobs(std::size_t cell) const;
  std::size_t stride() const { return stride_; }  ///< places for jobs in a cell, used or not
  std::size_t place(JobIndex job) const { return job % stride_; }

  /// Jobs that have to be done first.
  std::vector<JobIndex> inputs(JobIndex job) const;
  /// Jobs that have this one among their inputs.
  std::vector<JobIndex> dependents(JobIndex job) const;

  /// "n16-head_on/compare-povray", for `--filter`.
  std::string name(JobIndex job) const;
  std::string name_in_cell(JobIndex job) const;  ///< "compare-povray"
  /// The engine of a job, or ours.
  std::string whose(JobIndex job) const;

  /// Why an engine cannot show the cell's scene; empty if it can.
  std::string refusal(std::size_t cell, std::size_t engine) const;

  /// Absent engines that the cell is to be compared with, without a picture.
  std::vector<std::size_t> missing_engines(std::size_t cell) const;
  /// The number of cells that an engine cannot show.
  std::size_t refusals(std::size_t engine) const;
  /// Drops the reference and the comparison of an engine from a cell.
  void leave_out(std::size_t cell, std::size_t engine);

  /// Whether a job can be done without this input: a profile draws the pictures that are there.
  bool may_lack(JobIndex job, JobIndex input) const {
    return jobs_[job].kind == JobKind::kProfile && jobs_[input].kind == JobKind::kReference;
  }
  /// Reduces the profile to our picture and those for which `has_picture` is true: another result, with another key.
  void narrow_profile(std::size_t cell, const std::function<bool(JobIndex)>& has_picture);

  const AxisValues& axes(std::size_t cell) const { return cells_->cells[cell].tokens; }

  /// The hash of a cell's scene file, in hexadecimal.
  std::string scene_hash(std::size_t cell) const { return hex(scenes_[cell]); }

 private:
  ResultKey profile_key(std::size_t cell, const std::vector<bool>& with_engine) const;
  /// Whether an engine is compared with the grid's reference. Otherwise ours is compared with it.
  bool is_with_truth(std::size_t cell, std::size_t engine) const {
    return truth_ && *truth_ != engine && jobs_[reference(cell, *truth_)].exists;
  }
  void plan_comparisons(std::size_t cell);
  void plan_cell(std::size_t cell, std::map<std::size_t, std::string>& refusals);

  const FarmCells* cells_;
  const std::vector<FarmEngine>* engines_;
  std::chrono::duration<double> time_limit_;
  std::string own_;  ///< own_identity(), as a part of every key
  std::size_t stride_;
  std::optional<std::size_t> truth_;  ///< index of the grid's reference
  std::vector<Job> jobs_;
  std::vector<Sha256Digest> scenes_;
  std::map<std::size_t, std::string> refusals_;  ///< by cell * engines + engine; few have one
};

/// Cells from coarse to fine, so that any first part spreads over the grid: first values, middle ones, then those between.
std::vector<std::size_t> coarse_to_fine(const std::vector<Cell>& cells);

}  // namespace lobelia

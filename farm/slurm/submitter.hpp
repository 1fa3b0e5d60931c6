// Submits rounds of a run: jobs as arrays of chunks, each with its script.
#pragma once

#include "farm/slurm/run_parts.hpp"

namespace lobelia {

class Submitter {
 public:
  Submitter(RunContext& run, const NodeReports& reports, const ElementRequest& request);

  /// Returns the arrays. Gives up jobs that no node is left for.
  std::vector<SlurmJobId> submit_round(const std::vector<SlurmJob>& jobs);
  /// Gives up jobs whose engine no usable node has any more. Whether there were any.
  bool give_up_where_no_node_is_left(const std::vector<SlurmJob>& jobs);
  /// Nodes that an array stays away from.
  NodeNames nodes_without(SlurmJobId array) const;

 private:
  ChunkRule rule() const;
  void give_up(const std::vector<SlurmJob>& jobs, const std::vector<std::size_t>& places,
               const std::string& why);
  std::filesystem::path write_script(const records::SlurmArray& array,
                                     const std::string& title) const;
  SlurmJobId submit(records::SlurmArray array, const std::vector<SlurmJobId>& after,
                    const NodeNames& without, std::string& refusal);
  std::optional<SlurmJobId> call_sbatch(const std::vector<std::string>& arguments,
                                        const std::filesystem::path& script,
                                        const std::string& comment, bool excludes,
                                        std::string& refusal) const;

  RunContext& run_;
  const NodeReports& reports_;
  const ElementRequest& request_;
  const std::vector<std::string> finish_arguments_;
  std::map<SlurmJobId, NodeNames> without_;
};

}  // namespace lobelia

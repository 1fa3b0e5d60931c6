// Nodes that handed back jobs of a run.
#pragma once

#include <map>
#include <set>

#include "farm/chunk.hpp"
#include "farm/slurm/run_parts.hpp"

namespace lobelia {

using NodeNames = std::set<std::string>;

/// They get no more jobs of that engine.
class NodeReports {
 public:
  explicit NodeReports(const RunContext& run) : run_(run) {}

  /// Reads the reports of this run's chunks, and says which are new.
  void read(const std::string& partition) {
    const ChunkReports found =
        read_chunk_reports(run_.directory, run_.record.first_report, run_.record.next_chunk);
    for (const std::string& problem : found.problems) say_once(problem);
    if (found.reports.empty()) return;
    const auto nodes = run_.client.node_list(partition);
    std::map<std::string, std::string> newly;  // by engine
    for (const ChunkReport& report : found.reports) {
      // sbatch refuses to exclude a node that Slurm does not know.
      if (nodes && !nodes->empty() &&
          std::ranges::find(*nodes, report.node, &SlurmNode::name) == nodes->end()) {
        say_once(fmt::format("Chunk {} was handed back by '{}', and Slurm has no such node",
                             report.number, report.node));
        continue;
      }
      for (const LeftUndone& left : report.left)
        if (without_engine_[left.engine].emplace(report.node, left.why).second)
          append_item(newly[left.engine], fmt::format("{} ({})", report.node, left.why));
    }
    for (const auto& [engine, list] : newly)
      run_.say(fmt::format("No more jobs{} for nodes that handed them back: {}.",
                           engine.empty() ? "" : " of " + engine, printable(list, 1000)));
  }
  /// Nodes that jobs of this batch avoid.
  NodeNames nodes_without(const std::string& batch) const {
    NodeNames names;
    for (const auto& [engine, nodes] : without_engine_)
      if (engine.empty() || engine == batch)
        for (const auto& [node, why] : nodes) names.insert(node);
    return names;
  }
  /// Why they do: "n1 handed it back (...)".
  std::string reasons(const NodeNames& nodes, const std::string& batch) const {
    std::string text;
    for (const std::string& node : nodes) {
      for (const std::string& engine : {batch, std::string()}) {
        const auto nodes_without = without_engine_.find(engine);
        if (nodes_without == without_engine_.end()) continue;
        const auto why = nodes_without->second.find(node);
        if (why == nodes_without->second.end()) continue;
        append_item(text, fmt::format("{} handed it back ({})", node, why->second));
        break;
      }
    }
    return printable(text, 1000);
  }
  /// False also if Slurm does not answer. `states` gets the states of the other nodes.
  bool no_other_node_is_usable(const std::string& partition, const NodeNames& without,
                               std::string& states) const {
    const auto nodes = run_.client.node_list(partition);
    if (!nodes || nodes->empty()) return false;
    for (const SlurmNode& node : *nodes) {
      if (without.contains(node.name)) continue;
      if (node.usable) return false;
      append_item(states, fmt::format("{} is {}", node.name, node.state));
    }
    states = printable(states, 500);
    return true;
  }

 private:
  void say_once(const std::string& problem) {
    if (told_.insert(problem).second) run_.say(problem + ".");
  }

  const RunContext& run_;
  /// By engine (empty: all), then by node: why it handed jobs back.
  std::map<std::string, std::map<std::string, std::string>> without_engine_;
  std::set<std::string> told_;  ///< problems
};

}  // namespace lobelia

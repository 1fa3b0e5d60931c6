// Submits the jobs of a run.
#pragma once

#include "farm/slurm/element_request.hpp"
#include "farm/slurm/node_reports.hpp"

namespace lobelia {

inline constexpr int kFinishPhase = -1;

/// Submits rounds of a run: jobs as arrays of chunks, each with its script.
class Submitter {
 public:
  Submitter(RunContext& run, const NodeReports& reports, const ElementRequest& request)
      : run_(run),
        reports_(reports),
        request_(request),
        finish_arguments_(sbatch_arguments(request.options())) {}

  /// Returns the arrays. Gives up jobs without a node.
  std::vector<SlurmJobId> submit_round(const std::vector<SlurmJob>& jobs) {
    const ChunkRule chunk_rule = rule();
    const SlurmOptions& asked = request_.options();
    ++run_.outcome.rounds;
    ++run_.record.round;
    // Jobs that avoid the same nodes form an array.
    std::map<std::pair<int, NodeNames>, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < jobs.size(); ++i)
      groups[{jobs[i].phase, reports_.nodes_without(jobs[i].batch)}].push_back(i);
    std::vector<SlurmJobId> ids, earlier_phases;
    int phase = groups.begin()->first.first;
    std::size_t submitted = 0;
    for (const auto& [kind, places] : groups) {
      if (kind.first != phase) earlier_phases = ids;
      phase = kind.first;
      std::vector<SlurmJob> part;
      for (const std::size_t i : places) part.push_back(jobs[i]);
      auto chunks = make_chunks(part, chunk_rule);
      const records::SlurmArray array{0,           run_.record.next_chunk, chunks.size(),
                                      phase,       run_.record.round,      asked.time,
                                      asked.memory};
      // Recorded first, so that no two elements have the same number.
      run_.record.next_chunk += chunks.size();
      run_.write_record();
      std::vector<Sha256Digest> written;
      for (std::size_t i = 0; i < chunks.size(); ++i) {
        for (std::size_t& job : chunks[i]) job = places[job];
        written.push_back(run_.work.write_chunk(array.first_chunk + i, chunks[i]));
        throw_if_interrupted();
      }
      std::string refusal;
      const SlurmJobId id = submit(array, written, earlier_phases, kind.second, refusal);
      if (!refusal.empty()) {
        give_up(jobs, places,
                fmt::format("no node is left for it: {}; Slurm says: {}",
                            reports_.reasons(kind.second, jobs[places[0]].batch), refusal));
        continue;
      }
      ids.push_back(id);
      without_[id] = kind.second;
      submitted += places.size();
    }
    if (ids.empty()) return ids;
    run_.say(fmt::format(
        "Round {}: {} in {} as {}.", run_.outcome.rounds, count_text(submitted, "job"),
        ids.size() == 1 ? "one array" : fmt::format("{} arrays", ids.size()), ids_text(ids)));
    std::string refusal;
    if (run_.options.finish)
      submit({0, 0, 1, kFinishPhase, run_.record.round, "", ""}, {}, ids, {}, refusal);
    return ids;
  }
  /// Gives up jobs if no usable node accepts their engine. Whether there were any.
  bool give_up_where_no_node_is_left(const std::vector<SlurmJob>& jobs) {
    std::map<std::string, std::vector<std::size_t>> batches;
    for (std::size_t i = 0; i < jobs.size(); ++i) batches[jobs[i].batch].push_back(i);
    bool any = false;
    for (const auto& [batch, places] : batches) {
      const NodeNames without = reports_.nodes_without(batch);
      std::string states;
      if (without.empty() ||
          !reports_.no_other_node_is_usable(request_.options().partition, without, states))
        continue;
      any = true;
      give_up(jobs, places,
              fmt::format("no node is left for it: {}{}{}", reports_.reasons(without, batch),
                          states.empty() ? "" : "; the others: ", states));
    }
    return any;
  }
  /// Nodes that an array avoids.
  NodeNames nodes_without(SlurmJobId array) const {
    const auto found = without_.find(array);
    return found == without_.end() ? NodeNames() : found->second;
  }

 private:
  ChunkRule rule() const {
    const SlurmOptions& asked = run_.options.slurm;
    ChunkRule rule = run_.options.chunks;
    std::size_t processors = 0;
    if (const auto nodes = run_.client.node_list(asked.partition))
      for (const SlurmNode& node : *nodes)
        if (node.usable) processors += node.processors;
    rule.slots = std::max<std::size_t>(processors / std::size_t(asked.processors), 1);
    if (asked.throttle > 0) rule.slots = std::min(rule.slots, std::size_t(asked.throttle));
    long long largest = 1001;  // Slurm's default
    if (const auto config = run_.client.config())
      largest = config_number(*config, "MaxArraySize", largest);
    rule.most_chunks =
        std::min(rule.most_chunks, std::size_t(std::clamp(largest - 1, 1LL, 1000LL)));
    return rule;
  }
  void give_up(const std::vector<SlurmJob>& jobs, const std::vector<std::size_t>& places,
               const std::string& why) {
    for (const std::size_t place : places) run_.outcome.given_up.push_back(jobs[place].name);
    run_.say(fmt::format("{} of {} given up: {}.", count_text(places.size(), "job"),
                         jobs[places.front()].batch, why));
    run_.work.give_up(places, why);
  }
  /// Slurm has a copy, so the hashes hold whatever becomes of the directory.
  std::string script_of(const records::SlurmArray& array,
                        const std::vector<Sha256Digest>& chunks) const {
    const std::string program = shell_quote(std::filesystem::absolute(run_.work.program).string());
    const std::string directory = shell_quote(run_.directory.string());
    // exec: Slurm's signals reach the program itself, not a shell. What the records say, this client had leave for.
    std::string text = "#!/bin/sh\n";
    if (array.phase == kFinishPhase) {
      text += fmt::format("exec {} farm finish {} --sha256 {} --allow-commands\n", program,
                          directory, hex(run_.work.run_record));
    } else {
      text += "case $SLURM_ARRAY_TASK_ID in\n";
      for (std::size_t i = 0; i < chunks.size(); ++i)
        text += fmt::format("{}) sha256={};;\n", i, hex(chunks[i]));
      text += fmt::format(
          "esac\nexec {} farm exec-chunk {} $(({} + SLURM_ARRAY_TASK_ID)) --sha256 \"$sha256\" "
          "--allow-commands\n",
          program, directory, array.first_chunk);
    }
    return text;
  }
  /// Excludes the nodes `without`; `refusal` gets Slurm's words if there are no others.
  SlurmJobId submit(records::SlurmArray array, const std::vector<Sha256Digest>& chunks,
                    const std::vector<SlurmJobId>& after, const NodeNames& without,
                    std::string& refusal) {
    const bool last = array.phase == kFinishPhase;
    const int throttle = run_.options.slurm.throttle;
    const std::string title = last ? fmt::format("{}-finish", array.round)
                                   : fmt::format("{}-{}", array.round, array.first_chunk);
    const std::string comment = fmt::format("lobelia {}", title);
    std::string log = run_.directory.string();
    for (std::size_t at = 0; (at = log.find('%', at)) != log.npos; at += 2) log.insert(at, 1, '%');
    std::vector<std::string> arguments = {
        "--job-name=" + run_.record.name,
        "--comment=" + comment,
        "--ntasks=1",
        "--requeue",
        "--open-mode=append",
        "--chdir=" + run_.directory.string(),
        fmt::format("--output={}/log/{}.log", log, last ? "%j" : "%A_%a")};
    if (!last)
      arguments.push_back(fmt::format("--array=0-{}{}", array.chunks - 1,
                                      throttle > 0 ? fmt::format("%{}", throttle) : ""));
    // afterany: a failed cell must neither cancel nor hold up later jobs.
    if (!after.empty())
      arguments.push_back(fmt::format("--dependency=afterany:{}", fmt::join(after, ":")));
    SlurmOptions asked = request_.options();
    for (const std::string& node : without)
      asked.exclude += (asked.exclude.empty() ? "" : ",") + node;
    const auto more = last ? finish_arguments_ : sbatch_arguments(asked);
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string text = script_of(array, chunks), file = title + ".sh";
    // To look at if something goes wrong. Slurm gets another copy, which nobody else can replace before it is read.
    write_file(run_.directory / "submit" / file, text, AtLink::kReplace);
    const TemporaryDirectory own;
    write_file(own.path() / file, text);
    const auto id = call_sbatch(arguments, own.path() / file, comment, !without.empty(), refusal);
    if (!id) return 0;
    array.job = *id;
    run_.record.arrays.push_back(array);
    run_.write_record();
    run_.note(*id);
    throw_if_interrupted();
    return *id;
  }
  std::optional<SlurmJobId> call_sbatch(const std::vector<std::string>& arguments,
                                        const std::filesystem::path& script,
                                        const std::string& comment, bool excludes,
                                        std::string& refusal) const {
    std::string why;
    for (int attempt = 0; attempt < 3; ++attempt) {
      if (attempt > 0) {
        wait_for(run_.options.first_poll, false);
        // Slurm may have taken the job without an answer.
        if (const auto living = run_.client.living_jobs(run_.record.name))
          for (const auto& job : *living)
            if (job.comment == comment) return job.id;
        throw_if_interrupted();
      }
      const SlurmSubmission submission = run_.client.submit(arguments, script);
      if (submission.job) return *submission.job;
      why = submission.why;
      if (!submission.unclear) break;
    }
    if (excludes && why.find("node configuration is not available") != why.npos) {
      refusal = why;
      return {};
    }
    throw Error(ExitCode::kEngine, "Slurm did not take the job: {}", why);
  }

  RunContext& run_;
  const NodeReports& reports_;
  const ElementRequest& request_;
  const std::vector<std::string> finish_arguments_;
  std::map<SlurmJobId, NodeNames> without_;
};

}  // namespace lobelia

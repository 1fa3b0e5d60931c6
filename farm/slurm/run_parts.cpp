#include "farm/slurm/run_parts.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "core/files.hpp"
#include "core/sha256.hpp"
#include "core/text.hpp"
#include "farm/chunk.hpp"
#include "records/record.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr char kRunRecordFile[] = "slurm.json";
constexpr int kFinishPhase = -1;
constexpr char kMoreTime[] = "give elements more with --time, or less to do with --chunk-seconds";
constexpr char kMoreMemory[] = "give elements more with --sbatch=--mem=SIZE";

/// Whether the end of an element's log says that it used too much memory.
bool log_tells_of_memory(const fs::path& path) {
  constexpr off_t kEnd = 8192;
  const int fd = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return false;
  struct stat status {};
  std::string text(kEnd, '\0');
  ssize_t size = 0;
  if (::fstat(fd, &status) == 0 && S_ISREG(status.st_mode))
    size = ::pread(fd, text.data(), text.size(), std::max<off_t>(0, status.st_size - kEnd));
  ::close(fd);
  text.resize(std::size_t(std::max<ssize_t>(size, 0)));
  return std::ranges::any_of(split(text, "\n"),
                             [](const std::string& line) { return tells_of_memory(line); });
}

std::string name_of_path(const fs::path& run_directory) {
  return "lobelia-" + hex(sha256(run_directory.string())).substr(0, 16);
}

}  // namespace

void RunContext::note(SlurmJobId id) {
  if (std::ranges::find(outcome.jobs, id) == outcome.jobs.end()) outcome.jobs.push_back(id);
  set_last_words(fmt::format("\nleft running: {} (scancel --me --name={})\n",
                             ids_text(outcome.jobs), record.name));
}

void RunContext::write_record() const {
  records::write_record(directory / kRunRecordFile, record, AtLink::kReplace);
}

std::string job_name(const fs::path& run_directory) {
  return name_of_path(real_path(run_directory));
}

records::SlurmRun read_run_record(const fs::path& run_directory, std::string& foreign) {
  const auto path = run_directory / kRunRecordFile;
  if (file_type_at(path) == fs::file_type::not_found) return {};
  auto record = records::read_record<records::SlurmRun>(path);
  const std::string own = job_name(run_directory);
  // Earlier versions named jobs by the path as it was given.
  if (record.name == own ||
      record.name == name_of_path(fs::absolute(run_directory).lexically_normal()))
    return record;
  foreign = fmt::format(
      "{}: it names jobs '{}', which are left alone: the jobs of this directory are '{}'.",
      printable_path(path.string()), printable(record.name), own);
  record.name = own;
  record.arrays.clear();
  return record;
}

void count_elements(const std::vector<SlurmElement>& elements, SlurmProgress& progress) {
  for (const auto& element : elements) {
    const bool pending = element.state == SlurmElement::State::kPending;
    if (pending && progress.pending == 0) progress.reason = element.reason;
    (pending                                          ? progress.pending
     : element.state == SlurmElement::State::kRunning ? progress.running
                                                      : progress.ended) += element.count;
  }
}

bool wait_for(std::chrono::duration<double> time, bool until_interrupted) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + time;
  while (Clock::now() < end) {
    if (until_interrupted && interrupted()) return false;
    std::this_thread::sleep_for(
        std::min<std::chrono::duration<double>>(std::chrono::milliseconds(50), end - Clock::now()));
  }
  return !(until_interrupted && interrupted());
}

std::string ids_text(const std::vector<SlurmJobId>& ids) {
  return fmt::format("{} {}", ids.size() == 1 ? "job" : "jobs", fmt::join(ids, ", "));
}

std::string count_text(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void append_item(std::string& list, std::string_view item) {
  if (!list.empty()) list += ", ";
  list += item;
}

void NodeReports::read(const std::string& partition) {
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

void NodeReports::say_once(const std::string& problem) {
  if (told_.insert(problem).second) run_.say(problem + ".");
}

NodeNames NodeReports::nodes_without(const std::string& batch) const {
  NodeNames names;
  for (const auto& [engine, nodes] : without_engine_)
    if (engine.empty() || engine == batch)
      for (const auto& [node, why] : nodes) names.insert(node);
  return names;
}

std::string NodeReports::reasons(const NodeNames& nodes, const std::string& batch) const {
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

bool NodeReports::no_other_node_is_usable(const std::string& partition, const NodeNames& without,
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

ElementRequest::ElementRequest(const RunContext& run)
    : run_(run), asked_(with_own_fields(run.options.slurm)) {}

void ElementRequest::take_over(const std::vector<SlurmJobId>& ids) {
  for (const auto& array : run_.record.arrays) {
    if (std::ranges::find(ids, array.job) == ids.end()) continue;
    if (parse_slurm_time(array.time) > parse_slurm_time(asked_.time)) asked_.time = array.time;
    if (parse_slurm_memory(array.memory) > parse_slurm_memory(asked_.memory))
      asked_.memory = array.memory;
  }
}

void ElementRequest::note_endings(SlurmJobId id, const std::vector<SlurmElement>& elements) {
  const fs::path logs = run_.directory / "log";
  std::map<std::string, std::size_t> states;
  int logs_to_read = 100;
  for (const auto& element : elements) {
    SlurmEnding end = end_of(element);
    if (end == SlurmEnding::kWell) continue;
    if (end == SlurmEnding::kFailed && element.task && logs_to_read-- > 0 &&
        log_tells_of_memory(logs / fmt::format("{}_{}.log", id, *element.task)))
      end = SlurmEnding::kMemory;
    endings_[end] += element.count;
    const std::string_view words = words_for(end);
    states[fmt::format("{} ({}){}{}", element.state_name, element.reason, words.empty() ? "" : ": ",
                       words)] += element.count;
  }
  for (const auto& [state, number] : states)
    run_.say(fmt::format("Job {}: {} of its elements ended as {}; logs are in {}.", id, number,
                         state, logs.string()));
}

/// "2 elements: time limit reached"; empty if none ended like this.
std::string ElementRequest::what_ended(SlurmEnding end, const char* where) const {
  const auto found = endings_.find(end);
  if (found == endings_.end()) return "";
  return fmt::format("{}{}: {}", count_text(found->second, "element"), where, words_for(end));
}

bool ElementRequest::was_ended_by_somebody() const {
  for (const SlurmEnding end : {SlurmEnding::kCancelled, SlurmEnding::kDeadline})
    if (const std::string what = what_ended(end); !what.empty()) {
      run_.say(fmt::format("Nothing more is submitted: {}. The same command goes on.", what));
      return true;
    }
  return false;
}

void ElementRequest::say_what_was_too_little() const {
  const auto tell = [&](SlurmEnding end, const std::string& asked, const char* advice) {
    if (const std::string what = what_ended(end, " of the last round"); !what.empty())
      run_.say(
          fmt::format("{}{}; {}.", what, asked.empty() ? "" : fmt::format(" ({})", asked), advice));
  };
  tell(SlurmEnding::kTime, asked_.time, kMoreTime);
  tell(SlurmEnding::kMemory, asked_.memory, kMoreMemory);
}

void ElementRequest::raise() {
  const auto raise_one = [&](SlurmEnding end, std::string& asked, const auto& parse,
                             const auto& text, const auto& most, const char* advice) {
    const std::string what = what_ended(end);
    if (what.empty()) return;
    const auto before = parse(asked);
    if (!before) return run_.say(fmt::format("{}; {}.", what, advice));
    const auto next = twice_at_most(*before, most());
    if (!next) return run_.say(fmt::format("{}; {} is the most that can be had.", what, asked));
    run_.say(
        fmt::format("{}; the next round asks for {} instead of {}.", what, text(*next), asked));
    asked = text(*next);
  };
  raise_one(
      SlurmEnding::kTime, asked_.time, parse_slurm_time, slurm_time_text,
      [&] { return partition().most_seconds; }, kMoreTime);
  raise_one(
      SlurmEnding::kMemory, asked_.memory, parse_slurm_memory, slurm_memory_text,
      [&] { return most_memory(); }, kMoreMemory);
  endings_.clear();
}

/// The limits of the requested partition, or of the default one.
SlurmPartition ElementRequest::partition() const {
  std::string name = asked_.partition;
  if (name.empty())
    if (const auto nodes = run_.client.node_list(""); nodes && !nodes->empty())
      name = nodes->front().partition;
  if (!is_node_name(name)) return {};
  const auto found = run_.client.partition(name);
  return found ? *found : SlurmPartition();
}

std::optional<long long> ElementRequest::most_memory() const {
  std::optional<long long> most = partition().most_mebibytes;
  long long largest = 0;
  if (const auto nodes = run_.client.node_list(asked_.partition))
    for (const SlurmNode& node : *nodes)
      if (node.usable) largest = std::max(largest, node.mebibytes);
  if (largest > 0) most = most ? std::min(*most, largest) : largest;
  return most;
}

Submitter::Submitter(RunContext& run, const NodeReports& reports, const ElementRequest& request)
    : run_(run),
      reports_(reports),
      request_(request),
      finish_arguments_(sbatch_arguments(request.options())) {}

ChunkRule Submitter::rule() const {
  const SlurmOptions& asked = run_.options.slurm;
  ChunkRule rule = run_.options.chunks;
  std::size_t processors = 0;
  if (const auto nodes = run_.client.nodes(asked.partition))
    for (const auto& group : *nodes)
      if (group.usable) processors += group.processors;
  rule.slots = std::max<std::size_t>(processors / std::size_t(asked.processors), 1);
  if (asked.throttle > 0) rule.slots = std::min(rule.slots, std::size_t(asked.throttle));
  long long largest = 1001;  // Slurm's default
  if (const auto config = run_.client.config())
    largest = config_number(*config, "MaxArraySize", largest);
  rule.most_chunks = std::min(rule.most_chunks, std::size_t(std::clamp(largest - 1, 1LL, 1000LL)));
  return rule;
}

std::vector<SlurmJobId> Submitter::submit_round(const std::vector<SlurmJob>& jobs) {
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

void Submitter::give_up(const std::vector<SlurmJob>& jobs, const std::vector<std::size_t>& places,
                        const std::string& why) {
  for (const std::size_t place : places) run_.outcome.given_up.push_back(jobs[place].name);
  run_.say(fmt::format("{} of {} given up: {}.", count_text(places.size(), "job"),
                       jobs[places.front()].batch, why));
  run_.work.give_up(places, why);
}

bool Submitter::give_up_where_no_node_is_left(const std::vector<SlurmJob>& jobs) {
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

/// Slurm has a copy, so the hashes hold whatever becomes of the directory.
std::string Submitter::script_of(const records::SlurmArray& array,
                                 const std::vector<Sha256Digest>& chunks) const {
  const std::string program = shell_quote(fs::absolute(run_.work.program).string());
  const std::string directory = shell_quote(run_.directory.string());
  // exec: Slurm's signals reach the program itself, not a shell. What the records say, this client had leave for.
  std::string text = "#!/bin/sh\n";
  if (array.phase == kFinishPhase) {
    text += fmt::format("exec {} farm finish {} --sha256 {} --allow-commands\n", program, directory,
                        hex(run_.work.run_record));
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
SlurmJobId Submitter::submit(records::SlurmArray array, const std::vector<Sha256Digest>& chunks,
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

std::optional<SlurmJobId> Submitter::call_sbatch(const std::vector<std::string>& arguments,
                                                 const fs::path& script, const std::string& comment,
                                                 bool excludes, std::string& refusal) const {
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

}  // namespace lobelia

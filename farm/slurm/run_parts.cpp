#include "farm/slurm/run_parts.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/text.hpp"
#include "farm/chunk_report.hpp"
#include "farm/slurm/slurm_limits.hpp"
#include "records/record.hpp"

namespace lobelia {
namespace {

constexpr char kRunRecordFile[] = "slurm.json";
constexpr char kMoreTime[] = "give elements more with --time, or less to do with --chunk-seconds";
constexpr char kMoreMemory[] = "give elements more with --sbatch=--mem=SIZE";

/// Whether slurmstepd says at the end of an element's log that it used too much memory.
bool log_tells_of_memory(const std::filesystem::path& path) {
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

}  // namespace

void RunContext::note(SlurmJobId id) {
  if (std::ranges::find(outcome.jobs, id) == outcome.jobs.end()) outcome.jobs.push_back(id);
  set_last_words(fmt::format("\nleft running: {} (scancel --me --name={})\n",
                             ids_text(outcome.jobs), record.name));
}

void RunContext::write_record() const {
  records::write_record(directory / kRunRecordFile, record, AtLink::kReplace);
}

records::SlurmRun read_run_record(const std::filesystem::path& run_directory) {
  const auto path = run_directory / kRunRecordFile;
  if (!std::filesystem::exists(path)) return {};
  auto record = records::read_record<records::SlurmRun>(path);
  if (!record.name.starts_with("lobelia-") || !std::ranges::all_of(record.name, [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
      }))
    throw Error(ExitCode::kInput, fmt::format("{}: its name is not that of a run", path.string()));
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
    // sbatch refuses everything that excludes a node that Slurm has not.
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

const std::string* NodeReports::reason_of(const std::string& engine,
                                          const std::string& node) const {
  const auto nodes = without_engine_.find(engine);
  if (nodes == without_engine_.end()) return nullptr;
  const auto why = nodes->second.find(node);
  return why == nodes->second.end() ? nullptr : &why->second;
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
    const std::string* why = reason_of(batch, node);
    if (!why) why = reason_of("", node);
    if (why) append_item(text, fmt::format("{} handed it back ({})", node, *why));
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
  const std::filesystem::path logs = run_.directory / "log";
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

std::size_t ElementRequest::ended(SlurmEnding end) const {
  const auto at = endings_.find(end);
  return at == endings_.end() ? 0 : at->second;
}

/// "2 elements: time limit reached"; empty if none ended so.
std::string ElementRequest::what_ended(SlurmEnding end, const char* where) const {
  const std::size_t count = ended(end);
  return count == 0 ? ""
                    : fmt::format("{}{}: {}", count_text(count, "element"), where, words_for(end));
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

/// The limits of the partition that is asked for, or of the default one.
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

}  // namespace lobelia

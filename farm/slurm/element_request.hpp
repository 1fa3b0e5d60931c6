// The resources that each element of a run asks Slurm for.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>

#include "base/system/descriptor.hpp"
#include "farm/slurm/run_parts.hpp"

namespace lobelia {

inline constexpr char kMoreTime[] =
    "give elements more with --time, or less to do with --chunk-seconds";
inline constexpr char kMoreMemory[] = "give elements more with --sbatch=--mem=SIZE";

/// Whether the end of an element's log says that it used too much memory.
inline bool log_tells_of_memory(const std::filesystem::path& path) {
  constexpr std::size_t kEnd = 8192;
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  const auto size = std::size_t(status.st_size);
  std::string text(kEnd, '\0');
  text.resize(read_at(file.get(), text.data(), kEnd, size - std::min(size, kEnd)));
  return std::ranges::any_of(split(text, "\n"),
                             [](const std::string& line) { return tells_of_memory(line); });
}

/// The elements' request for time and memory, which grows in the next round if they ran out of either.
class ElementRequest {
 public:
  explicit ElementRequest(const RunContext& run)
      : run_(run), asked_(with_own_fields(run.options.slurm)) {}

  const SlurmOptions& options() const { return asked_; }
  /// Takes over the larger requests of an earlier client's jobs.
  void take_over(const std::vector<SlurmJobId>& ids) {
    for (const auto& array : run_.record.arrays) {
      if (std::ranges::find(ids, array.job) == ids.end()) continue;
      if (parse_slurm_time(array.time) > parse_slurm_time(asked_.time)) asked_.time = array.time;
      if (parse_slurm_memory(array.memory) > parse_slurm_memory(asked_.memory))
        asked_.memory = array.memory;
    }
  }
  /// Notes and says how the elements of a job ended.
  void note_endings(SlurmJobId id, const std::vector<SlurmElement>& elements) {
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
      states[fmt::format("{} ({}){}{}", element.state_name, element.reason,
                         words.empty() ? "" : ": ", words)] += element.count;
    }
    for (const auto& [state, number] : states)
      run_.say(fmt::format("Job {}: {} of its elements ended as {}; logs are in {}.", id, number,
                           state, logs.string()));
  }
  /// Whether somebody cancelled elements, which is said: then nothing more is to be submitted.
  bool was_ended_by_somebody() const {
    for (const SlurmEnding end : {SlurmEnding::kCancelled, SlurmEnding::kDeadline})
      if (const std::string what = what_ended(end); !what.empty()) {
        run_.say(fmt::format("Nothing more is submitted: {}. The same command goes on.", what));
        return true;
      }
    return false;
  }
  void say_what_was_too_little() const {
    const auto tell = [&](SlurmEnding end, const std::string& asked, const char* advice) {
      if (const std::string what = what_ended(end, " of the last round"); !what.empty())
        run_.say(fmt::format("{}{}; {}.", what, asked.empty() ? "" : fmt::format(" ({})", asked),
                             advice));
    };
    tell(SlurmEnding::kTime, asked_.time, kMoreTime);
    tell(SlurmEnding::kMemory, asked_.memory, kMoreMemory);
  }
  /// Doubles the request for time or memory that was too little.
  void raise() {
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

 private:
  /// "2 elements: time limit reached"; empty if none ended like this.
  std::string what_ended(SlurmEnding end, const char* where = "") const {
    const auto found = endings_.find(end);
    if (found == endings_.end()) return "";
    return fmt::format("{}{}: {}", count_text(found->second, "element"), where, words_for(end));
  }
  /// The limits of the requested partition, or of the default one.
  SlurmPartition partition() const {
    std::string name = asked_.partition;
    if (name.empty())
      if (const auto nodes = run_.client.node_list(""); nodes && !nodes->empty())
        name = nodes->front().partition;
    if (!is_node_name(name)) return {};
    const auto found = run_.client.partition(name);
    return found ? *found : SlurmPartition();
  }
  std::optional<long long> most_memory() const {
    std::optional<long long> most = partition().most_mebibytes;
    long long largest = 0;
    if (const auto nodes = run_.client.node_list(asked_.partition))
      for (const SlurmNode& node : *nodes)
        if (node.usable) largest = std::max(largest, node.mebibytes);
    if (largest > 0) most = most ? std::min(*most, largest) : largest;
    return most;
  }

  const RunContext& run_;
  SlurmOptions asked_;
  std::map<SlurmEnding, std::size_t> endings_;  ///< of elements since the last round was submitted
};

}  // namespace lobelia

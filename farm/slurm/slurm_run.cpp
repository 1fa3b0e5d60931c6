#include "farm/slurm/slurm_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "core/byte_locks.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/sha256.hpp"
#include "core/standard_streams.hpp"
#include "core/text.hpp"
#include "farm/chunk_report.hpp"
#include "farm/slurm/slurm_client.hpp"
#include "farm/slurm/slurm_limits.hpp"
#include "records/cluster.hpp"
#include "records/record.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// False if interrupted meanwhile and that is looked at.
bool wait_for(Seconds time, bool until_interrupted = true) {
  const auto end = Clock::now() + time;
  while (Clock::now() < end) {
    if (until_interrupted && interrupted()) return false;
    std::this_thread::sleep_for(std::min<Seconds>(Seconds(0.05), end - Clock::now()));
  }
  return !(until_interrupted && interrupted());
}

std::string ids_text(const std::vector<SlurmJobId>& ids) {
  return fmt::format("{} {}", ids.size() == 1 ? "job" : "jobs", fmt::join(ids, ", "));
}

using records::SlurmArray;
using records::SlurmRun;

constexpr int kFinishPhase = -1;

fs::path record_path(const fs::path& run_directory) { return run_directory / "slurm.json"; }

/// Empty if there is none.
SlurmRun read_run_record(const fs::path& run_directory) {
  const fs::path path = record_path(run_directory);
  if (!fs::exists(path)) return {};
  auto record = records::read_record<SlurmRun>(path);
  if (!record.name.starts_with("lobelia-") || !std::ranges::all_of(record.name, [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
      }))
    throw Error(ExitCode::kInput, fmt::format("{}: its name is not that of a run", path.string()));
  return record;
}

void write_run_record(const fs::path& run_directory, const SlurmRun& record) {
  records::write_record(record_path(run_directory), record, AtLink::kReplace);
}

/// Of the directory: another client of the same run gives its jobs the same name.
std::string name_of_run(const fs::path& run_directory) {
  return "lobelia-" + hex(sha256(run_directory.string())).substr(0, 16);
}

std::string count_text(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// Whether the end of an element's log has slurmstepd's word that it used too much memory.
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
  const auto lines = split(text, "\n");
  return std::any_of(lines.begin(), lines.end(),
                     [](const std::string& line) { return tells_of_memory(line); });
}

using Nodes = std::set<std::string>;

class Run {
 public:
  Run(const SlurmWork& work, const SlurmRunOptions& options)
      : work_(work),
        options_(options),
        client_(options.call_limit),
        asked_(with_own_fields(options.slurm)),
        finish_arguments_(sbatch_arguments(asked_)) {}

  SlurmOutcome operator()() {
    const auto absent = SlurmClient::absent_programs();
    if (!absent.empty())
      throw Error(ExitCode::kEngine, fmt::format("no Slurm here: no program '{}' in $PATH",
                                                 fmt::join(absent, "', '")));
    directory_ = fs::absolute(work_.run_directory).lexically_normal();
    // In a file name sbatch's "%" can be written twice, but "\" turns all of them off.
    if (directory_.string().find_first_of("\\\n\r") != std::string::npos)
      throw Error(ExitCode::kUsage,
                  fmt::format("{}: sbatch takes no path with a backslash or a line end",
                              printable(directory_.string(), 200)));
    make_directories(directory_ / "log");  // without it an element fails and nobody is told why
    make_directories(directory_ / "submit");
    const ByteLocks locks(HeldDirectory(directory_), "client.lock");
    const auto lock = locks.try_claim(0);
    if (!locks.is_open())
      throw Error(ExitCode::kOutput, fmt::format("{}: {}", directory_.string(), locks.why_not()));
    if (!lock)
      throw Error(ExitCode::kOutput, fmt::format("{}: another client has this run ({})",
                                                 directory_.string(), locks.holder()));
    if (locks.works())
      locks.write_holder();
    else
      say("This file system has no locks: start no second client of this run.");
    record_ = read_run_record(directory_);
    if (record_.name.empty()) record_.name = name_of_run(directory_);
    struct Silence {
      ~Silence() { set_last_words(""); }
    } silence;
    try {
      rounds();
    } catch (const Error& error) {
      // An interruption can also come out of missing() or write_chunk().
      if (error.code() != ExitCode::kInterrupted || settled_) throw;
      on_interrupt();
    }
    return outcome_;
  }

 private:
  void rounds() {
    for (bool begins = true;; begins = false) {
      auto jobs = missing();
      if (jobs.empty()) return;
      if (const auto living = living_at_start(); !living.empty()) {
        outcome_.attached = true;
        note(living);
        say(fmt::format("Found {} of this run in the queue; waiting for them.",
                        ids_text(ids_of(living))));
        if (options_.detach) {
          outcome_.detached = true;
          return;
        }
        take_over_limits(ids_of(living));
        wait_until_gone(ids_of(living));
        settle();
        continue;
      }
      if (begins) record_.first_report = record_.next_chunk;
      if (outcome_.rounds == options_.rounds || somebody_ended_it()) {
        say_what_was_too_little();
        for (SlurmJob& job : jobs) outcome_.missing.push_back(std::move(job.name));
        return;
      }
      look_at_reports();
      if (give_up_where_no_node_is_left(jobs)) continue;
      ask_for_more();
      const auto ids = submit_round(jobs);
      if (options_.detach) {
        outcome_.detached = true;
        return;
      }
      wait_until_gone(ids);
      settle();
    }
  }

  void say(const std::string& sentence) const {
    if (options_.say) options_.say(sentence);
  }

  std::vector<SlurmJob> missing() const {
    auto jobs = work_.missing();
    throw_if_interrupted();
    return jobs;
  }

  static std::vector<SlurmJobId> ids_of(const std::vector<SlurmLivingJob>& jobs) {
    std::vector<SlurmJobId> ids;
    for (const auto& job : jobs) ids.push_back(job.id);
    return ids;
  }

  /// Each once, and into the words of a second Ctrl-C.
  void note(SlurmJobId id) {
    if (std::find(outcome_.jobs.begin(), outcome_.jobs.end(), id) == outcome_.jobs.end())
      outcome_.jobs.push_back(id);
    set_last_words(fmt::format("\nleft running: {} (scancel --me --name={})\n",
                               ids_text(outcome_.jobs), record_.name));
  }
  void note(const std::vector<SlurmLivingJob>& jobs) {
    for (const auto& job : jobs) note(job.id);
  }

  /// Slurm that does not answer before anything is submitted is an error; later it is waited for.
  std::vector<SlurmLivingJob> living_at_start() {
    std::string why;
    for (int attempt = 0; attempt < 3 || !outcome_.jobs.empty(); ++attempt) {
      if (attempt > 0 && !wait_for(options_.first_poll)) throw_if_interrupted();
      auto living = client_.living_jobs(record_.name);
      if (living) {
        // The last element of a round may still write its report; a new round need not wait for that.
        std::erase_if(*living.value,
                      [](const SlurmLivingJob& job) { return job.comment.ends_with("-finish"); });
        return *living;
      }
      why = living.why;
      throw_if_interrupted();
    }
    throw Error(ExitCode::kEngine, fmt::format("Slurm does not answer: {}", why));
  }

  // ---- submission

  ChunkRule rule() const {
    ChunkRule rule = options_.chunks;
    std::size_t processors = 0;
    if (const auto nodes = client_.nodes(options_.slurm.partition))
      for (const auto& group : *nodes)
        if (group.usable) processors += group.processors;
    const std::size_t room = processors / std::size_t(options_.slurm.processors);
    rule.slots = std::max<std::size_t>(room, 1);
    if (options_.slurm.throttle > 0)
      rule.slots = std::min(rule.slots, std::size_t(options_.slurm.throttle));
    long long largest = 1001;  // Slurm's default
    if (const auto config = client_.config())
      if (const auto at = config->find("MaxArraySize"); at != config->end())
        parse_integer(at->second, largest);
    rule.most_chunks =
        std::min(rule.most_chunks, std::size_t(std::clamp(largest - 1, 1LL, 1000LL)));
    return rule;
  }

  std::vector<SlurmJobId> submit_round(const std::vector<SlurmJob>& jobs) {
    const ChunkRule chunk_rule = rule();
    ++outcome_.rounds;
    ++record_.round;
    // What must not run on the same nodes is one array.
    std::map<std::pair<int, Nodes>, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < jobs.size(); ++i)
      groups[{jobs[i].phase, nodes_without(jobs[i].batch)}].push_back(i);
    std::vector<SlurmJobId> ids, earlier_phases;
    int phase = groups.begin()->first.first;
    std::size_t submitted = 0;
    for (const auto& [kind, places] : groups) {
      if (kind.first != phase) earlier_phases = ids;
      phase = kind.first;
      std::vector<SlurmJob> part;
      for (const std::size_t i : places) part.push_back(jobs[i]);
      auto chunks = make_chunks(part, chunk_rule);
      const SlurmArray array{0,           record_.next_chunk, chunks.size(), phase, record_.round,
                             asked_.time, asked_.memory};
      // Recorded first: a number that an element may have is not given away again.
      record_.next_chunk += chunks.size();
      write_run_record(directory_, record_);
      for (std::size_t i = 0; i < chunks.size(); ++i) {
        for (std::size_t& job : chunks[i]) job = places[job];
        work_.write_chunk(array.first_chunk + i, chunks[i]);
        throw_if_interrupted();
      }
      std::string refusal;
      const SlurmJobId id = submit(array, earlier_phases, kind.second, refusal);
      if (!refusal.empty()) {
        give_up(jobs, places,
                fmt::format("no node is left for it: {}; Slurm says: {}",
                            reasons_of(kind.second, jobs[places[0]].batch), refusal));
        continue;
      }
      ids.push_back(id);
      without_[id] = kind.second;
      submitted += places.size();
    }
    if (ids.empty()) return ids;
    say(fmt::format("Round {}: {} in {} as {}.", outcome_.rounds, count_text(submitted, "job"),
                    ids.size() == 1 ? "one array" : fmt::format("{} arrays", ids.size()),
                    ids_text(ids)));
    std::string refusal;
    if (options_.finish) submit({0, 0, 1, kFinishPhase, record_.round, "", ""}, ids, {}, refusal);
    return ids;
  }

  /// The script is a file, because that is what can be looked at when something is wrong.
  fs::path write_script(const SlurmArray& array, const std::string& title) const {
    const std::string program = shell_quote(fs::absolute(work_.program).string());
    const std::string directory = shell_quote(directory_.string());
    // exec: what Slurm sends reaches the program and no shell before it.
    const std::string line =
        array.phase == kFinishPhase
            ? fmt::format("exec {} farm finish {}", program, directory)
            : fmt::format("exec {} farm exec-chunk {} $(({} + SLURM_ARRAY_TASK_ID))", program,
                          directory, array.first_chunk);
    const fs::path path = directory_ / "submit" / (title + ".sh");
    write_file(path, fmt::format("#!/bin/sh\n{}\n", line));
    return path;
  }

  /// Elements run on none of the nodes `without`. `refusal` is Slurm's word where it has no others.
  SlurmJobId submit(SlurmArray array, const std::vector<SlurmJobId>& after, const Nodes& without,
                    std::string& refusal) {
    const bool last = array.phase == kFinishPhase;
    const std::string title = last ? fmt::format("{}-finish", array.round)
                                   : fmt::format("{}-{}", array.round, array.first_chunk);
    const std::string comment = fmt::format("lobelia {}", title);
    std::string log = directory_.string();
    for (std::size_t at = 0; (at = log.find('%', at)) != log.npos; at += 2) log.insert(at, 1, '%');
    std::vector<std::string> arguments = {
        "--job-name=" + record_.name,
        "--comment=" + comment,
        "--ntasks=1",
        "--requeue",
        "--open-mode=append",
        "--chdir=" + directory_.string(),
        fmt::format("--output={}/log/{}.log", log, last ? "%j" : "%A_%a")};
    if (!last)
      arguments.push_back(fmt::format(
          "--array=0-{}{}", array.chunks - 1,
          options_.slurm.throttle > 0 ? fmt::format("%{}", options_.slurm.throttle) : ""));
    // afterany: one cell that fails must not cancel or hang what comes after.
    if (!after.empty())
      arguments.push_back(fmt::format("--dependency=afterany:{}", fmt::join(after, ":")));
    SlurmOptions asked = asked_;
    for (const std::string& node : without)
      asked.exclude += (asked.exclude.empty() ? "" : ",") + node;
    const auto more = last ? finish_arguments_ : sbatch_arguments(asked);
    arguments.insert(arguments.end(), more.begin(), more.end());
    const fs::path script = write_script(array, title);
    const auto id = submit(arguments, script, comment, !without.empty(), refusal);
    if (!id) return 0;
    array.job = *id;
    record_.arrays.push_back(array);
    write_run_record(directory_, record_);
    note(*id);
    throw_if_interrupted();
    return *id;
  }

  std::optional<SlurmJobId> submit(const std::vector<std::string>& arguments,
                                   const fs::path& script, const std::string& comment,
                                   bool excludes, std::string& refusal) {
    std::string why;
    for (int attempt = 0; attempt < 3; ++attempt) {
      if (attempt > 0) {
        wait_for(options_.first_poll, false);
        // It may have been taken though nobody said so.
        if (const auto living = client_.living_jobs(record_.name))
          for (const auto& job : *living)
            if (job.comment == comment) return job.id;
        throw_if_interrupted();
      }
      const SlurmSubmission submission = client_.submit(arguments, script);
      if (submission.job) return *submission.job;
      why = submission.why;
      if (!submission.unclear) break;
    }
    if (excludes && why.find("node configuration is not available") != why.npos) {
      refusal = why;
      return {};
    }
    throw Error(ExitCode::kEngine, fmt::format("Slurm did not take the job: {}", why));
  }

  // ---- nodes that hand work back

  void look_at_reports() {
    const ChunkReports found =
        read_chunk_reports(directory_, record_.first_report, record_.next_chunk);
    for (const std::string& problem : found.problems)
      if (told_.insert(problem).second) say(problem + ".");
    if (found.reports.empty()) return;
    const auto nodes = client_.node_list(asked_.partition);
    std::map<std::string, std::string> newly;  // by engine
    for (const ChunkReport& report : found.reports) {
      // sbatch refuses everything that excludes a node that Slurm has not.
      if (nodes && !nodes->empty() &&
          std::none_of(nodes->begin(), nodes->end(),
                       [&](const SlurmNode& node) { return node.name == report.node; })) {
        const std::string problem =
            fmt::format("Chunk {} was handed back by '{}', and Slurm has no such node",
                        report.number, report.node);
        if (told_.insert(problem).second) say(problem + ".");
        continue;
      }
      for (const LeftUndone& left : report.left) {
        if (!without_engine_[left.engine].emplace(report.node, left.why).second) continue;
        std::string& list = newly[left.engine];
        list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", report.node, left.why);
      }
    }
    for (const auto& [engine, list] : newly)
      say(fmt::format("No more jobs{} for nodes that handed them back: {}.",
                      engine.empty() ? "" : " of " + engine, printable(list, 1000)));
  }

  /// Nodes that jobs of this batch stay away from.
  Nodes nodes_without(const std::string& batch) const {
    Nodes nodes;
    for (const std::string& engine : {std::string(), batch})
      if (const auto at = without_engine_.find(engine); at != without_engine_.end())
        for (const auto& [node, why] : at->second) nodes.insert(node);
    return nodes;
  }

  std::string reasons_of(const Nodes& nodes, const std::string& batch) const {
    std::string text;
    for (const std::string& node : nodes)
      for (const std::string& engine : {batch, std::string()})
        if (const auto at = without_engine_.find(engine); at != without_engine_.end())
          if (const auto why = at->second.find(node); why != at->second.end()) {
            text += fmt::format("{}{} handed it back ({})", text.empty() ? "" : ", ", node,
                                why->second);
            break;
          }
    return printable(text, 1000);
  }

  void give_up(const std::vector<SlurmJob>& jobs, const std::vector<std::size_t>& places,
               const std::string& why) {
    for (const std::size_t place : places) outcome_.given_up.push_back(jobs[place].name);
    say(fmt::format("{} of {} given up: {}.", count_text(places.size(), "job"),
                    jobs[places.front()].batch, why));
    work_.give_up(places, why);
  }

  /// Whether there are such jobs; missing() is to be asked again then.
  bool give_up_where_no_node_is_left(const std::vector<SlurmJob>& jobs) {
    std::map<std::string, std::vector<std::size_t>> batches;
    for (std::size_t i = 0; i < jobs.size(); ++i)
      if (!nodes_without(jobs[i].batch).empty()) batches[jobs[i].batch].push_back(i);
    bool any = false;
    for (const auto& [batch, places] : batches) {
      const Nodes without = nodes_without(batch);
      std::string states;
      if (!no_other_node_is_usable(without, states)) continue;
      any = true;
      give_up(jobs, places,
              fmt::format("no node is left for it: {}{}{}", reasons_of(without, batch),
                          states.empty() ? "" : "; the others: ", states));
    }
    return any;
  }

  /// Also false where Slurm does not say.
  bool no_other_node_is_usable(const Nodes& without, std::string& states) const {
    const auto nodes = client_.node_list(asked_.partition);
    if (!nodes || nodes->empty()) return false;
    for (const SlurmNode& node : *nodes) {
      if (without.contains(node.name)) continue;
      if (node.usable) return false;
      states += fmt::format("{}{} is {}", states.empty() ? "" : ", ", node.name, node.state);
    }
    states = printable(states, 500);
    return true;
  }

  // ---- elements that ended too early

  /// Of the jobs of an earlier client: what they asked for may have been raised already.
  void take_over_limits(const std::vector<SlurmJobId>& ids) {
    for (const auto& array : record_.arrays) {
      if (std::find(ids.begin(), ids.end(), array.job) == ids.end()) continue;
      if (parse_slurm_time(array.time) > parse_slurm_time(asked_.time)) asked_.time = array.time;
      if (parse_slurm_memory(array.memory) > parse_slurm_memory(asked_.memory))
        asked_.memory = array.memory;
    }
  }

  std::size_t ended(SlurmEnding end) const {
    const auto at = ends_.find(end);
    return at == ends_.end() ? 0 : at->second;
  }

  /// Then nothing is submitted against that will.
  bool somebody_ended_it() const {
    for (const SlurmEnding end : {SlurmEnding::kCancelled, SlurmEnding::kDeadline})
      if (const std::size_t count = ended(end); count > 0) {
        say(fmt::format("Nothing more is submitted: {}: {}. The same command goes on.",
                        count_text(count, "element"), words_for(end)));
        return true;
      }
    return false;
  }

  static constexpr char kMoreTime[] =
      "give elements more with --time, or less to do with --chunk-seconds";
  static constexpr char kMoreMemory[] = "give elements more with --sbatch=--mem=SIZE";

  void say_what_was_too_little() const {
    const auto tell = [&](SlurmEnding end, const std::string& asked, const char* advice) {
      if (const std::size_t count = ended(end); count > 0)
        say(fmt::format("{} of the last round: {}{}; {}.", count_text(count, "element"),
                        words_for(end), asked.empty() ? "" : fmt::format(" ({})", asked), advice));
    };
    tell(SlurmEnding::kTime, asked_.time, kMoreTime);
    tell(SlurmEnding::kMemory, asked_.memory, kMoreMemory);
  }

  void ask_for_more() {
    const auto raise = [&](SlurmEnding end, std::string& asked, const auto& parse, const auto& text,
                           const auto& most, const char* advice) {
      const std::size_t count = ended(end);
      if (count == 0) return;
      const std::string what = fmt::format("{}: {}", count_text(count, "element"), words_for(end));
      const auto before = parse(asked);
      if (!before) {
        say(fmt::format("{}; {}.", what, advice));
        return;
      }
      const auto next = twice_at_most(*before, most());
      if (!next) {
        say(fmt::format("{}; {} is the most that can be had.", what, asked));
        return;
      }
      say(fmt::format("{}; the next round asks for {} instead of {}.", what, text(*next), asked));
      asked = text(*next);
    };
    raise(
        SlurmEnding::kTime, asked_.time, parse_slurm_time, slurm_time_text,
        [&] { return partition().most_seconds; }, kMoreTime);
    raise(
        SlurmEnding::kMemory, asked_.memory, parse_slurm_memory, slurm_memory_text,
        [&] { return most_memory(); }, kMoreMemory);
    ends_.clear();
  }

  /// What scontrol tells of the partition that is asked for, or of the default one.
  SlurmPartition partition() const {
    std::string name = asked_.partition;
    if (name.empty())
      if (const auto nodes = client_.node_list(""); nodes && !nodes->empty())
        name = nodes->front().partition;
    if (!is_node_name(name)) return {};
    const auto found = client_.partition(name);
    return found ? *found : SlurmPartition();
  }

  std::optional<long long> most_memory() const {
    std::optional<long long> most = partition().most_mebibytes;
    long long largest = 0;
    if (const auto nodes = client_.node_list(asked_.partition))
      for (const SlurmNode& node : *nodes)
        if (node.usable) largest = std::max(largest, node.mebibytes);
    if (largest > 0) most = most ? std::min(*most, largest) : largest;
    return most;
  }

  // ---- waiting

  /// Until none of them is in the queue, nor any other of this run's name but the last.
  void wait_until_gone(std::vector<SlurmJobId> ids) {
    Seconds interval = options_.first_poll;
    while (!ids.empty()) {
      // All of them each time: how elements ended is forgotten after a few minutes.
      for (std::size_t i = 0; i < ids.size();) {
        const auto elements = client_.elements(ids[i], record_.name);
        throw_if_interrupted();
        answered(elements.why);
        if (!elements) break;
        const SlurmProgress progress = count(*elements);
        if (i == 0 && options_.on_progress) options_.on_progress(progress);
        if (progress.pending + progress.running == 0) {
          note_how_they_ended(ids[i], *elements);
          ids.erase(ids.begin() + std::ptrdiff_t(i));
          if (i == 0) stalled_since_.reset();
          continue;
        }
        if (i == 0) look_for_stall(ids[i], *elements, progress);
        ++i;
      }
      if (ids.empty()) return;
      if (!wait_for(interval)) throw_if_interrupted();
      interval = std::min(options_.last_poll, interval * 1.3);
    }
  }

  void answered(const std::string& why) {
    if (!why.empty() && !silent_)
      say(fmt::format(
          "Slurm does not answer ({}); waiting for it. What runs is not touched by that.", why));
    if (why.empty() && silent_) say("Slurm answers again.");
    silent_ = !why.empty();
  }

  SlurmProgress count(const std::vector<SlurmElement>& elements) const {
    SlurmProgress progress;
    progress.round = outcome_.rounds;
    for (const auto& element : elements) {
      switch (element.state) {
        case SlurmElement::State::kPending:
          if (progress.pending == 0) progress.reason = element.reason;
          progress.pending += element.count;
          break;
        case SlurmElement::State::kRunning:
          progress.running += element.count;
          break;
        case SlurmElement::State::kEnded:
          progress.ended += element.count;
          break;
      }
    }
    return progress;
  }

  void note_how_they_ended(SlurmJobId id, const std::vector<SlurmElement>& elements) {
    std::map<std::string, std::size_t> states;
    int logs = 100;  // are looked into
    for (const auto& element : elements) {
      SlurmEnding end = end_of(element);
      if (end == SlurmEnding::kWell) continue;
      if (end == SlurmEnding::kFailed && element.task && logs-- > 0 &&
          log_tells_of_memory(directory_ / "log" / fmt::format("{}_{}.log", id, *element.task)))
        end = SlurmEnding::kMemory;
      ends_[end] += element.count;
      const std::string_view words = words_for(end);
      states[fmt::format("{} ({}){}{}", element.state_name, element.reason,
                         words.empty() ? "" : ": ", words)] += element.count;
    }
    for (const auto& [state, number] : states)
      say(fmt::format("Job {}: {} of its elements ended as {}; logs are in {}.", id, number, state,
                      (directory_ / "log").string()));
  }

  /// Throws once nothing has run for `stall` and nothing can without somebody's doing.
  void look_for_stall(SlurmJobId id, const std::vector<SlurmElement>& elements,
                      const SlurmProgress& progress) {
    const bool held =
        std::all_of(elements.begin(), elements.end(), [](const SlurmElement& element) {
          return element.state != SlurmElement::State::kPending || waits_for_somebody(element);
        });
    std::string nodes_say;
    if (progress.running > 0 || !(held || no_node_is_usable(id, nodes_say))) {
      stalled_since_.reset();
      return;
    }
    if (!stalled_since_) stalled_since_ = Clock::now();
    if (Clock::now() - *stalled_since_ < options_.stall) return;
    settled_ = true;
    const std::string what =
        held ? fmt::format("'scontrol release {}' frees held elements",
                           fmt::join(outcome_.jobs, ","))
             : fmt::format(
                   "no node can run them ({}): 'sinfo -R' says why, and an administrator brings a "
                   "node back with 'scontrol update NodeName=NODE State=RESUME'",
                   nodes_say);
    throw Error(
        ExitCode::kEngine,
        fmt::format(
            "nothing runs and nothing will: {} of {} wait because of '{}'. {}; then the same "
            "command goes on. 'scancel --me --name={}' gives them up",
            progress.pending == 1 ? "1 element" : fmt::format("{} elements", progress.pending),
            ids_text(outcome_.jobs), progress.reason, what, record_.name));
  }

  bool no_node_is_usable(SlurmJobId id, std::string& states) const {
    if (const auto at = without_.find(id); at != without_.end() && !at->second.empty())
      return no_other_node_is_usable(at->second, states);
    const auto nodes = client_.nodes(options_.slurm.partition);
    if (!nodes) return false;
    for (const auto& group : *nodes) {
      if (group.up && group.usable) return false;
      states += fmt::format("{}{} {}{}", states.empty() ? "" : ", ", group.nodes, group.state,
                            group.up ? "" : " in a partition that is down");
    }
    return !nodes->empty();
  }

  /// A result may show late; one that is still missing then is.
  void settle() {
    const auto end = Clock::now() + options_.settle;
    while (Clock::now() < end && !missing().empty())
      if (!wait_for(std::min(options_.first_poll, options_.settle))) throw_if_interrupted();
  }

  // ---- Ctrl-C

  [[noreturn]] void on_interrupt() {
    const std::string again = "the same command goes on";
    if (outcome_.jobs.empty() && outcome_.rounds == 0)
      throw Error(ExitCode::kInterrupted, "interrupted; nothing was submitted");
    const std::string ids = outcome_.jobs.empty() ? "what was submitted" : ids_text(outcome_.jobs);
    const bool cancel =
        !options_.detach && (!options_.cancel_on_interrupt || options_.cancel_on_interrupt());
    if (!cancel)
      throw Error(ExitCode::kInterrupted,
                  fmt::format("interrupted; left running: {}; {}", ids, again));
    say(fmt::format("Cancelling {}; once more leaves at once.", ids));
    // By name: that finds a job too whose number was not yet read. What ignores TERM is killed after KillWait.
    Seconds kill_wait(30);
    if (const auto config = client_.config())
      if (const auto at = config->find("KillWait"); at != config->end())
        kill_wait = Seconds(std::clamp(std::strtod(at->second.c_str(), nullptr), 0.0, 600.0));
    std::string why;
    for (const auto end = Clock::now() + kill_wait + Seconds(15); Clock::now() < end;) {
      why = client_.cancel(record_.name);
      const auto living = client_.living_jobs(record_.name);
      if (living && living->empty())
        throw Error(ExitCode::kInterrupted,
                    fmt::format("interrupted; cancelled {}; {}", ids, again));
      if (!living) why = living.why;
      wait_for(std::min(options_.first_poll, Seconds(0.5)), false);
    }
    throw Error(
        ExitCode::kInterrupted,
        fmt::format("interrupted; {} may still run{}: 'scancel --me --name={}' cancels them; {}",
                    ids, why.empty() ? "" : fmt::format(" ({})", why), record_.name, again));
  }

  const SlurmWork& work_;
  const SlurmRunOptions& options_;
  SlurmClient client_;
  SlurmOptions asked_;  ///< for elements; a round may raise it
  const std::vector<std::string> finish_arguments_;
  fs::path directory_;
  SlurmRun record_;
  SlurmOutcome outcome_;
  bool silent_ = false;   ///< Slurm, at the last call
  bool settled_ = false;  ///< nothing is to be cancelled any more
  std::optional<Clock::time_point> stalled_since_;
  std::map<SlurmEnding, std::size_t> ends_;  ///< of elements since the last round was submitted
  /// By engine (empty: of all), then by node: why it hands its jobs back.
  std::map<std::string, std::map<std::string, std::string>> without_engine_;
  std::map<SlurmJobId, Nodes> without_;
  std::set<std::string> told_;  ///< problems of reports
};

}  // namespace

SlurmOutcome run_on_slurm(const SlurmWork& work, const SlurmRunOptions& options) {
  return Run(work, options)();
}

bool ask_whether_to_cancel() {
  if (!::isatty(0) || !::isatty(2)) return true;
  while (true) {
    write_message("\ncancel the jobs, or leave them running? [c/d] ");
    char answer[64];
    ssize_t size = 0;
    // A signal that comes meanwhile is dealt with by its handler; the question stays.
    while ((size = ::read(0, answer, sizeof answer)) < 0 && errno == EINTR) {
    }
    if (size <= 0 || answer[0] == 'c' || answer[0] == 'C') return true;
    if (answer[0] == 'd' || answer[0] == 'D') return false;
  }
}

SlurmStatus slurm_status(const fs::path& run_directory, std::chrono::duration<double> call_limit) {
  SlurmStatus status;
  const auto record = read_run_record(run_directory);
  if (record.name.empty()) return status;
  status.name = record.name;
  status.round = status.elements.round = record.round;
  const SlurmClient client(call_limit);
  const auto living = client.living_jobs(record.name);
  if (!living) {
    status.problem = living.why;
    return status;
  }
  status.living = *living;
  for (const auto& job : status.living) {
    const auto elements = client.elements(job.id, record.name);
    if (!elements) {
      status.problem = elements.why;
      continue;
    }
    for (const auto& element : *elements) {
      if (element.state == SlurmElement::State::kPending) {
        status.elements.pending += element.count;
        if (status.elements.reason.empty()) status.elements.reason = element.reason;
      }
      if (element.state == SlurmElement::State::kRunning) status.elements.running += element.count;
      if (element.state == SlurmElement::State::kEnded) status.elements.ended += element.count;
    }
  }
  return status;
}

}  // namespace lobelia

#include "farm/slurm/slurm_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/system/byte_locks.hpp"
#include "base/system/files.hpp"
#include "base/system/removal.hpp"
#include "base/system/standard_streams.hpp"
#include "base/words/text.hpp"
#include "farm/slurm/submitter.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// A client of a run: submits rounds, waits for them, and cancels them on Ctrl-C.
class Client {
 public:
  Client(const SlurmWork& work, const SlurmRunOptions& options)
      : options_(options),
        run_(work, options),
        reports_(run_),
        request_(run_),
        submitter_(run_, reports_, request_) {}

  SlurmOutcome operator()() {
    prepare_directory();
    const ByteLocks locks(HeldDirectory(run_.directory), "client.lock");
    const auto lock = locks.try_claim(0);
    if (!locks.is_open())
      throw Error(ExitCode::kOutput, "{}: {}", run_.directory.string(), locks.why_not());
    if (!lock)
      throw Error(ExitCode::kOutput, "{}: another client has this run ({})",
                  run_.directory.string(), locks.holder());
    if (locks.works())
      locks.write_holder();
    else
      run_.say("This file system has no locks: start no second client of this run.");
    std::string foreign;
    run_.record = read_run_record(run_.directory, foreign);
    if (!foreign.empty()) run_.say(foreign);
    // Another client of the same run gives its jobs the same name.
    if (run_.record.name.empty()) run_.record.name = job_name(run_.directory);
    struct Silence {
      ~Silence() { set_last_words(""); }
    } silence;
    try {
      rounds();
    } catch (const Error& error) {
      // An interruption can also come out of missing() or write_chunk().
      if (error.code() != ExitCode::kInterrupted || stalled_) throw;
      on_interrupt();
    }
    return run_.outcome;
  }

 private:
  void prepare_directory() {
    const auto absent = SlurmClient::absent_programs();
    if (!absent.empty())
      throw Error(ExitCode::kEngine, "no Slurm here: no program '{}' in $PATH",
                  fmt::join(absent, "', '"));
    run_.directory = fs::absolute(run_.work.run_directory).lexically_normal();
    // sbatch reads "%%" in a file name as "%", but "\" turns off every "%".
    if (run_.directory.string().find_first_of("\\\n\r") != std::string::npos)
      throw Error(ExitCode::kUsage, "{}: sbatch takes no path with a backslash or a line end",
                  printable(run_.directory.string(), 200));
    make_directories(run_.directory);
    const HeldDirectory held(run_.directory);
    // Without "log" an element fails and nobody says why.
    for (const char* name : {"log", "submit"}) held.make_below(name, HeldDirectory::Border::kCross);
  }

  void rounds() {
    for (bool begins = true;; begins = false) {
      const auto jobs = missing();
      if (jobs.empty()) return;
      if (const auto living = living_at_start(); !living.empty()) {
        attach(living);
        if (run_.outcome.detached) return;
        continue;
      }
      if (begins) run_.record.first_report = run_.record.next_chunk;
      if (run_.outcome.rounds == options_.rounds || request_.was_ended_by_somebody()) {
        request_.say_what_was_too_little();
        for (const SlurmJob& job : jobs) run_.outcome.missing.push_back(job.name);
        return;
      }
      reports_.read(request_.options().partition);
      if (submitter_.give_up_where_no_node_is_left(jobs)) continue;
      request_.raise();
      const auto ids = submitter_.submit_round(jobs);
      run_.outcome.detached = options_.detach;
      if (options_.detach) return;
      wait_until_gone(ids);
      settle();
    }
  }

  std::vector<SlurmJob> missing() const {
    auto jobs = run_.work.missing();
    throw_if_interrupted();
    return jobs;
  }

  void attach(const std::vector<SlurmJobId>& ids) {
    run_.outcome.attached = true;
    for (const SlurmJobId id : ids) run_.note(id);
    run_.say(fmt::format("Found {} of this run in the queue; waiting for them.", ids_text(ids)));
    run_.outcome.detached = options_.detach;
    if (options_.detach) return;
    request_.take_over(ids);
    wait_until_gone(ids);
    settle();
  }

  /// Throws if Slurm does not answer before anything is submitted; later waits for an answer.
  std::vector<SlurmJobId> living_at_start() const {
    std::string why;
    for (int attempt = 0; attempt < 3 || !run_.outcome.jobs.empty(); ++attempt) {
      if (attempt > 0 && !wait_for(options_.first_poll)) throw_if_interrupted();
      const auto living = run_.client.living_jobs(run_.record.name);
      if (living) {
        std::vector<SlurmJobId> ids;
        for (const SlurmLivingJob& job : *living)
          // A new round need not wait for the report of the last one.
          if (!job.comment.ends_with("-finish")) ids.push_back(job.id);
        return ids;
      }
      why = living.why;
      throw_if_interrupted();
    }
    throw Error(ExitCode::kEngine, "Slurm does not answer: {}", why);
  }

  /// Waits until none of them is in the queue.
  void wait_until_gone(std::vector<SlurmJobId> ids) {
    Seconds interval = options_.first_poll;
    while (!ids.empty()) {
      // Asks for all of them each time: after a few minutes Slurm forgets how elements ended.
      for (std::size_t i = 0; i < ids.size();) {
        const auto elements = run_.client.elements(ids[i], run_.record.name);
        throw_if_interrupted();
        note_answer(elements.why);
        if (!elements) break;
        SlurmProgress progress;
        progress.round = run_.outcome.rounds;
        count_elements(*elements, progress);
        if (i == 0 && options_.on_progress) options_.on_progress(progress);
        if (progress.pending + progress.running == 0) {
          request_.note_endings(ids[i], *elements);
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

  void note_answer(const std::string& why) {
    if (!why.empty() && !silent_)
      run_.say(fmt::format(
          "Slurm does not answer ({}); waiting for it. What runs is not touched by that.", why));
    if (why.empty() && silent_) run_.say("Slurm answers again.");
    silent_ = !why.empty();
  }

  /// Throws once nothing has run for `stall`, and nothing will unless somebody acts.
  void look_for_stall(SlurmJobId id, const std::vector<SlurmElement>& elements,
                      const SlurmProgress& progress) {
    const bool held = std::ranges::all_of(elements, [](const SlurmElement& element) {
      return element.state != SlurmElement::State::kPending || waits_for_somebody(element);
    });
    std::string nodes_say;
    const auto no_node_is_usable = [&] {
      return reports_.no_other_node_is_usable(request_.options().partition,
                                              submitter_.nodes_without(id), nodes_say);
    };
    if (progress.running > 0 || !(held || no_node_is_usable())) {
      stalled_since_.reset();
      return;
    }
    if (!stalled_since_) stalled_since_ = Clock::now();
    if (Clock::now() - *stalled_since_ < options_.stall) return;
    stalled_ = true;
    const std::string what =
        held ? fmt::format("'scontrol release {}' frees held elements",
                           fmt::join(run_.outcome.jobs, ","))
             : fmt::format(
                   "no node can run them ({}): 'sinfo -R' says why, and an administrator brings a "
                   "node back with 'scontrol update NodeName=NODE State=RESUME'",
                   nodes_say);
    throw Error(ExitCode::kEngine,
                "nothing runs and nothing will: {} of {} wait because of '{}'. {}; then the "
                "same command goes on. 'scancel --me --name={}' gives them up",
                count_text(progress.pending, "element"), ids_text(run_.outcome.jobs),
                progress.reason, what, run_.record.name);
  }

  /// Waits for results that a network file system shows late.
  void settle() const {
    const auto end = Clock::now() + options_.settle;
    while (Clock::now() < end && !missing().empty())
      if (!wait_for(std::min(options_.first_poll, options_.settle))) throw_if_interrupted();
  }

  [[noreturn]] void on_interrupt() const {
    const auto& jobs = run_.outcome.jobs;
    const auto interrupted_with = [](const std::string& what) {
      return Error(ExitCode::kInterrupted, "interrupted; " + what);
    };
    constexpr char kAgain[] = "the same command goes on";
    if (jobs.empty() && run_.outcome.rounds == 0) throw interrupted_with("nothing was submitted");
    const std::string ids = jobs.empty() ? "what was submitted" : ids_text(jobs);
    if (options_.detach || (options_.cancel_on_interrupt && !options_.cancel_on_interrupt()))
      throw interrupted_with(fmt::format("left running: {}; {}", ids, kAgain));
    run_.say(fmt::format("Cancelling {}; once more leaves at once.", ids));
    // By name, because a job's number may be unknown. Slurm kills elements that ignore TERM after KillWait.
    Seconds kill_wait(30);
    if (const auto config = run_.client.config())
      kill_wait = Seconds(std::clamp(config_number(*config, "KillWait", 30), 0LL, 600LL));
    std::string why;
    for (const auto end = Clock::now() + kill_wait + Seconds(15); Clock::now() < end;) {
      why = run_.client.cancel(run_.record.name);
      const auto living = run_.client.living_jobs(run_.record.name);
      if (living && living->empty())
        throw interrupted_with(fmt::format("cancelled {}; {}", ids, kAgain));
      if (!living) why = living.why;
      wait_for(std::min(options_.first_poll, Seconds(0.5)), false);
    }
    throw interrupted_with(
        fmt::format("{} may still run{}: 'scancel --me --name={}' cancels them; {}", ids,
                    why.empty() ? "" : fmt::format(" ({})", why), run_.record.name, kAgain));
  }

  const SlurmRunOptions& options_;
  RunContext run_;
  NodeReports reports_;
  ElementRequest request_;
  Submitter submitter_;
  bool silent_ = false;   ///< Slurm did not answer the last call
  bool stalled_ = false;  ///< cancels nothing
  std::optional<Clock::time_point> stalled_since_;
};

}  // namespace

SlurmOutcome run_on_slurm(const SlurmWork& work, const SlurmRunOptions& options) {
  return Client(work, options)();
}

bool ask_whether_to_cancel() {
  if (!::isatty(0) || !::isatty(2)) return true;
  while (true) {
    write_message("\ncancel the jobs, or leave them running? [c/d] ");
    char answer[64];
    ssize_t size = 0;
    // Signals have their own handler; the question stays.
    while ((size = ::read(0, answer, sizeof answer)) < 0 && errno == EINTR) {
    }
    if (size <= 0 || answer[0] == 'c' || answer[0] == 'C') return true;
    if (answer[0] == 'd' || answer[0] == 'D') return false;
  }
}

SlurmStatus slurm_status(const fs::path& run_directory, std::chrono::duration<double> call_limit) {
  SlurmStatus status;
  const auto record = read_run_record(run_directory, status.foreign);
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
    if (const auto elements = client.elements(job.id, record.name))
      count_elements(*elements, status.elements);
    else
      status.problem = elements.why;
  }
  return status;
}

}  // namespace lobelia

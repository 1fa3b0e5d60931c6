// The parts of a run on Slurm: its record, and what its other parts share.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "base/records/cluster.hpp"
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"
#include "farm/slurm/slurm_client.hpp"
#include "farm/slurm/slurm_run.hpp"

namespace lobelia {

inline constexpr char kRunRecordFile[] = "slurm.json";

/// "job 7", "jobs 7, 8"
inline std::string ids_text(const std::vector<SlurmJobId>& ids) {
  return fmt::format("{} {}", ids.size() == 1 ? "job" : "jobs", fmt::join(ids, ", "));
}

/// "1 element", "2 elements"
inline std::string count_text(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// Adds an item, after a comma unless it is the first.
inline void append_item(std::string& list, std::string_view item) {
  if (!list.empty()) list += ", ";
  list += item;
}

/// False if interrupted and `until_interrupted`.
inline bool wait_for(std::chrono::duration<double> time, bool until_interrupted = true) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + time;
  while (Clock::now() < end) {
    if (until_interrupted && interrupted()) return false;
    std::this_thread::sleep_for(
        std::min<std::chrono::duration<double>>(std::chrono::milliseconds(50), end - Clock::now()));
  }
  return !(until_interrupted && interrupted());
}

struct RunContext {
  RunContext(const SlurmWork& w, const SlurmRunOptions& o)
      : work(w), options(o), client(o.call_limit) {}

  void say(const std::string& sentence) const {
    if (options.say) options.say(sentence);
  }
  /// Notes a job, once; a second Ctrl-C says that it is left running.
  void note(SlurmJobId id) {
    if (std::ranges::find(outcome.jobs, id) == outcome.jobs.end()) outcome.jobs.push_back(id);
    set_last_words(fmt::format("\nleft running: {} (scancel --me --name={})\n",
                               ids_text(outcome.jobs), record.name));
  }
  void write_record() const {
    records::write_record(directory / kRunRecordFile, record, AtLink::kReplace);
  }

  const SlurmWork& work;
  const SlurmRunOptions& options;
  const SlurmClient client;
  std::filesystem::path directory;  ///< absolute
  records::SlurmRun record;
  SlurmOutcome outcome;
};

inline std::string name_of_path(const std::filesystem::path& run_directory) {
  return "lobelia-" + hex(sha256(run_directory.string())).substr(0, 16);
}

/// The name of all jobs of a run, by which they are found and cancelled: "lobelia-" and a hash of the directory's real path.
inline std::string job_name(const std::filesystem::path& run_directory) {
  return name_of_path(real_path(run_directory));
}

/// Without a name if there is no record. One that names jobs of another directory, as a copied or forged record does, gets
/// the name of this one and no arrays; `foreign` then is a sentence about it.
inline records::SlurmRun read_run_record(const std::filesystem::path& run_directory,
                                         std::string& foreign) {
  const auto path = run_directory / kRunRecordFile;
  if (file_type_at(path) == std::filesystem::file_type::not_found) return {};
  auto record = records::read_record<records::SlurmRun>(path);
  const std::string own = job_name(run_directory);
  // Earlier versions named jobs by the path as it was given.
  if (record.name == own ||
      record.name == name_of_path(std::filesystem::absolute(run_directory).lexically_normal()))
    return record;
  foreign = fmt::format(
      "{}: it names jobs '{}', which are left alone: the jobs of this directory are '{}'.",
      printable_path(path.string()), printable(record.name), own);
  record.name = own;
  record.arrays.clear();
  return record;
}

/// Adds the elements that squeue shows to the counts.
inline void count_elements(const std::vector<SlurmElement>& elements, SlurmProgress& progress) {
  for (const auto& element : elements) {
    const bool pending = element.state == SlurmElement::State::kPending;
    if (pending && progress.pending == 0) progress.reason = element.reason;
    (pending                                          ? progress.pending
     : element.state == SlurmElement::State::kRunning ? progress.running
                                                      : progress.ended) += element.count;
  }
}

}  // namespace lobelia

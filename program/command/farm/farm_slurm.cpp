#include "base/system/files.hpp"
#include "base/system/host.hpp"
#include "base/system/removal.hpp"
#include "base/words/text.hpp"
#include "farm/slurm/doctor.hpp"
#include "program/command/farm/farm.hpp"
#include "program/command/gallery/publish.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"

namespace lobelia::cli {

void SlurmSettings::add_to(CLI::App& command) {
  OptionGroup group(command, "On a cluster (docs/farm_slurm.md)");
  SlurmOptions& slurm = run_.slurm;
  group.add_choice("--executor", executor_, {"local", "slurm"},
                   "local, or slurm: the same jobs as array jobs of a cluster");
  group.add("--partition", slurm.partition, "", "Partition, as sbatch has it");
  group.add("--time", slurm.time, "", "Of an element: 30, 1:00:00");
  group.add("--account", slurm.account, "", "Account, as sbatch has it");
  group.add("--qos", slurm.qos, "", "Quality of service, as sbatch has it");
  group.add("--constraint", slurm.constraint, "", "Features of nodes, as sbatch has it");
  group.add_flag("--exclusive", slurm.exclusive, "No other job on the nodes: for timings");
  group.add_number("--cpus-per-task", slurm.processors, 1, 1024, "Threads of an element");
  group.add("--throttle", slurm.throttle, "", "Elements at once; 0 is any number")
      ->check(between(0, 1000000));
  group
      .add("--sbatch", slurm.raw, "", "Further options of sbatch, each '--name=value'; repeatable")
      ->allow_extra_args(false);
  group.add_number("--chunk-seconds", run_.chunks.target_seconds, 0.1, 1e6,
                   "Target seconds of an array task");
  group.add_number("--rounds", run_.rounds, 1, 100, "How often missing jobs are submitted again");
  group.add_number("--poll-seconds", poll_seconds_, 0.05, 3600,
                   "Seconds between the first polls of the queue");
  group.add_flag("--detach", run_.detach,
                 "Submit and leave; 'lobelia farm status DIR --attach' comes back");
}

SlurmRunOptions SlurmSettings::run_options() const {
  SlurmRunOptions options = run_;
  ChunkRule& chunks = options.chunks;
  chunks.least_seconds = std::min(chunks.least_seconds, chunks.target_seconds);
  options.first_poll = std::chrono::duration<double>(poll_seconds_);
  options.last_poll =
      std::max(options.first_poll, std::min(options.last_poll, 15 * options.first_poll));
  options.cancel_on_interrupt = ask_whether_to_cancel;
  options.say = [](const std::string& sentence) { say("lobelia: {}\n", sentence); };
  return options;
}

SlurmFarmSummary follow(SlurmRunOptions options,
                        const std::function<SlurmFarmSummary(const SlurmRunOptions&)>& run) {
  ProgressLine line;
  const auto say = options.say;
  options.say = [&](const std::string& sentence) {
    line.clear();
    say(sentence);
  };
  options.on_progress = [&](const SlurmProgress& progress) {
    const std::size_t all = progress.pending + progress.running + progress.ended;
    if (all > 0)
      line.show(double(progress.ended) / double(all),
                fmt::format("round {}: {} elements pending, {} running{}", progress.round,
                            progress.pending, progress.running,
                            progress.reason.empty() ? "" : " (" + progress.reason + ")"));
  };
  return run(options);
}

namespace {

void add_doctor(CLI::App& farm, ExitCode& exit_code) {
  struct Options {
    DoctorOptions doctor;
    bool clean = false;
  };
  auto options = std::make_shared<Options>();
  DoctorOptions& settings = options->doctor;
  auto* command = farm.add_subcommand(
      "doctor", "Check this machine, and with DIR a Slurm cluster, before the first grid");
  command->add_option("DIR", settings.directory,
                      "Where a cluster's farms are to go: on a file system that the nodes share");
  command->add_flag("--clean", options->clean,
                    "First remove temporary directories that killed programs of this user left");
  command->add_option("--partition", settings.slurm.partition, "As sbatch has it");
  command->add_option("--account", settings.slurm.account, "");
  command->add_option("--qos", settings.slurm.qos, "");
  command->footer(
      "What this machine lacks to contain engines is a warning.\n\n"
      "Exit codes: 0 a grid would run, 1 it would not.");
  command->callback([options, &exit_code] {
    if (options->clean) {
      const auto removed = remove_dead_temporaries(place_for_temporaries());
      for (const auto& path : removed) fmt::print("removed {}\n", printable_path(path.string()));
      fmt::print("{} temporary directories of killed programs removed\n", removed.size());
    }
    options->doctor.program = program_file();
    fmt::print("{}", doctor_text(look_at_machine()));
    if (options->doctor.directory.empty()) return;
    const auto checks = doctor(options->doctor);
    fmt::print("{}", doctor_text(checks));
    if (worst_of(checks) == DoctorCheck::Verdict::kFailed) exit_code = ExitCode::kDiffers;
  });
}

/// Adds a subcommand for the program itself, which the help does not list, and its required `path`.
CLI::App* add_hidden(CLI::App& farm, const std::string& name, const std::string& meaning,
                     const std::string& path, std::filesystem::path& value,
                     const std::string& path_meaning) {
  CLI::App* const command = farm.add_subcommand(name, meaning);
  command->add_option(path, value, path_meaning)->required();
  command->group("");
  return command;
}

Sha256Digest planned_hash(const std::string& text) {
  Sha256Digest planned;
  if (!from_hex(text, planned))
    throw Error(ExitCode::kUsage, "--sha256: '{}' is not 64 hexadecimal digits", printable(text));
  return planned;
}

void exec_chunk(const std::filesystem::path& run, std::size_t number, const Sha256Digest& planned,
                const Leave& leave, ExitCode& exit_code) {
  const ChunkSummary done = exec_slurm_chunk(run, number, planned, leave);
  fmt::print("chunk {}: {} jobs, {} done, {} made here, {} failed; {:.1f} s\n", number, done.jobs,
             done.done, done.work.made, done.failed, done.work.wall_seconds);
  for (const auto& [engine, why] : done.left)
    say("lobelia: {} left for another node: {}\n", engine.empty() ? "the chunk is" : engine + " is",
        why);
  if (!done.left.empty()) exit_code = ExitCode::kEngine;
  if (done.failed > 0) exit_code = ExitCode::kOutput;
}

void finish_run(const std::filesystem::path& run, const Sha256Digest& planned, const Leave& leave) {
  const SlurmFarmSummary end = finish_slurm_run(run, planned, leave);
  const FarmSummary& summary = end.farm;
  fmt::print("{} cells: {} failed, {} differ, {} pass, {} not done\n", summary.cells,
             summary.failed, summary.differs, summary.pass, summary.missing);
  publish_if_wanted(end.directory, end.gallery);
}

}  // namespace

void add_farm_slurm(CLI::App& farm, ExitCode& exit_code) {
  add_doctor(farm, exit_code);
  auto path = std::make_shared<std::filesystem::path>();
  auto number = std::make_shared<std::size_t>(0);
  auto allowed = std::make_shared<bool>(false);
  auto* chunk = add_hidden(farm, "exec-chunk", "What an element of a cluster's job does", "RUN",
                           *path, "The run's directory");
  chunk->add_option("NUMBER", *number, "Of the chunk")->required();
  auto sha256 = std::make_shared<std::string>();
  chunk->callback([path, number, sha256, allowed, &exit_code] {
    exec_chunk(*path, *number, planned_hash(*sha256), leave_of_user(*allowed), exit_code);
  });
  auto* finish = add_hidden(farm, "finish", "What the last element of a run does", "RUN", *path,
                            "The run's directory");
  finish->callback([path, sha256, allowed] {
    finish_run(*path, planned_hash(*sha256), leave_of_user(*allowed));
  });
  for (CLI::App* const command : {chunk, finish}) {
    command->add_option("--sha256", *sha256, "Of what the job was submitted to do")->required();
    command->add_flag("--allow-commands", *allowed, "Do what the run's records say");
  }
  add_hidden(farm, "doctor-on-node", "What the doctor's element does", "DIR", *path,
             "Made by the doctor")
      ->callback([path] { doctor_on_node(*path); });
}

}  // namespace lobelia::cli

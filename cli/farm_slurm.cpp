#include "cli/farm_slurm.hpp"

#include <fmt/format.h>

#include <memory>

#include "cli/options.hpp"
#include "cli/progress.hpp"
#include "cli/publish.hpp"
#include "core/removal.hpp"
#include "core/standard_streams.hpp"
#include "core/text.hpp"
#include "farm/slurm/doctor.hpp"

namespace lobelia::cli {

void SlurmSettings::add_to(CLI::App& command) {
  constexpr char kGroup[] = "On a cluster (docs/farm_slurm.md)";
  const auto text = [&](const char* name, auto& value, const char* what) {
    return command.add_option(name, value, what)->group(kGroup);
  };
  const auto number = [&](const char* name, auto& value, double least, double most,
                          const char* what) {
    return text(name, value, what)->check(between(least, most));
  };
  text("--executor", executor_, "local, or slurm: the same jobs as array jobs of a cluster")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  text("--partition", slurm_.partition, "As sbatch has it; likewise the next four");
  text("--time", slurm_.time, "Of an element: 30, 1:00:00");
  text("--account", slurm_.account, "");
  text("--qos", slurm_.qos, "");
  text("--constraint", slurm_.constraint, "");
  command.add_flag("--exclusive", slurm_.exclusive, "No other job on the nodes: for timings")
      ->group(kGroup);
  number("--cpus-per-task", slurm_.processors, 1, 1024, "Threads of an element")
      ->capture_default_str();
  number("--throttle", slurm_.throttle, 0, 1000000, "Elements at once; 0 is any number");
  text("--sbatch", slurm_.raw, "Further options of sbatch, each '--name=value'; repeatable")
      ->allow_extra_args(false);
  number("--chunk-seconds", chunk_seconds_, 0.1, 1e6, "Work of an element")->capture_default_str();
  number("--rounds", rounds_, 1, 100, "Times that what is missing is submitted")
      ->capture_default_str();
  number("--poll-seconds", poll_seconds_, 0.05, 3600, "Between the first looks at the queue")
      ->capture_default_str();
  command
      .add_flag("--detach", detach_,
                "Submit and leave; 'lobelia farm status DIR --attach' comes back")
      ->group(kGroup);
}

SlurmRunOptions SlurmSettings::run_options() const {
  SlurmRunOptions options;
  options.slurm = slurm_;
  options.chunks.target_seconds = chunk_seconds_;
  options.chunks.least_seconds = std::min(options.chunks.least_seconds, chunk_seconds_);
  options.rounds = rounds_;
  options.detach = detach_;
  options.first_poll = std::chrono::duration<double>(poll_seconds_);
  options.last_poll =
      std::max(options.first_poll, std::min(options.last_poll, 15 * options.first_poll));
  options.cancel_on_interrupt = ask_whether_to_cancel;
  options.say = [](const std::string& sentence) { say("lobelia: {}\n", sentence); };
  return options;
}

SlurmFarmSummary follow(SlurmRunOptions options, bool quiet,
                        const std::function<SlurmFarmSummary(const SlurmRunOptions&)>& run) {
  ProgressLine line(!quiet);
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

void add_farm_slurm(CLI::App& farm, ExitCode& exit_code) {
  {
    auto settings = std::make_shared<DoctorOptions>();
    auto* command = farm.add_subcommand(
        "doctor", "Check this machine, and with DIR a Slurm cluster, before the first grid");
    auto directory = std::make_shared<std::string>();
    command->add_option("DIR", *directory,
                        "Where a cluster's farms are to go: on a file system that the nodes share");
    auto clean = std::make_shared<bool>(false);
    command->add_flag("--clean", *clean,
                      "First remove temporary directories that killed programs of this user left");
    command->add_option("--partition", settings->slurm.partition, "As sbatch has it");
    command->add_option("--account", settings->slurm.account, "");
    command->add_option("--qos", settings->slurm.qos, "");
    command->footer(
        "What this machine lacks to contain engines is a warning.\n\n"
        "Exit codes: 0 a grid would run, 1 it would not.");
    command->callback([settings, directory, clean, &exit_code] {
      if (*clean) {
        const auto removed = remove_dead_temporaries(std::filesystem::temp_directory_path());
        for (const auto& path : removed) fmt::print("removed {}\n", printable_path(path.string()));
        fmt::print("{} temporary directories of killed programs removed\n", removed.size());
      }
      settings->directory = *directory;
      settings->program = own_program();
      auto checks = look_at_machine();
      fmt::print("{}", doctor_text(checks));
      if (directory->empty()) return;
      checks = doctor(*settings);
      fmt::print("{}", doctor_text(checks));
      if (worst_of(checks) == DoctorCheck::Verdict::kFailed) exit_code = ExitCode::kDiffers;
    });
  }
  {
    struct Chunk {
      std::string run;
      std::size_t number = 0;
    };
    auto chunk = std::make_shared<Chunk>();
    auto* command = farm.add_subcommand("exec-chunk", "What an element of a cluster's job does");
    command->add_option("RUN", chunk->run, "The run's directory")->required();
    command->add_option("NUMBER", chunk->number, "Of the chunk")->required();
    command->group("");
    command->callback([chunk, &exit_code] {
      const ChunkSummary done = exec_slurm_chunk(chunk->run, chunk->number);
      fmt::print("chunk {}: {} jobs, {} done, {} made here, {} failed; {:.1f} s\n", chunk->number,
                 done.jobs, done.done, done.work.made, done.failed, done.work.wall_seconds);
      for (const auto& [engine, why] : done.left)
        say("lobelia: {} left for another node: {}\n",
            engine.empty() ? "the chunk is" : engine + " is", why);
      if (!done.left.empty()) exit_code = ExitCode::kEngine;
      if (done.failed > 0) exit_code = ExitCode::kOutput;
    });
  }
  {
    auto run = std::make_shared<std::string>();
    auto* command = farm.add_subcommand("finish", "What the last element of a run does");
    command->add_option("RUN", *run, "The run's directory")->required();
    command->group("");
    command->callback([run] {
      const SlurmFarmSummary end = finish_slurm_run(*run);
      const FarmSummary& summary = end.farm;
      fmt::print("{} cells: {} failed, {} differ, {} pass, {} not done\n", summary.cells,
                 summary.failed, summary.differs, summary.pass, summary.missing);
      publish_if_wanted(end.directory, end.gallery);
    });
  }
  {
    auto directory = std::make_shared<std::string>();
    auto* command = farm.add_subcommand("doctor-on-node", "What the doctor's element does");
    command->add_option("DIR", *directory, "Made by the doctor")->required();
    command->group("");
    command->callback([directory] { doctor_on_node(*directory); });
  }
}

}  // namespace lobelia::cli

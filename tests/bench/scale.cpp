// The limits of farms of 1e6 and 1e8 cells: planning is measured, the work of 1000 nodes is simulated. docs/scale.md has the
// conclusions; `make bench` measures crowds of spheres and a farm's own cost.
#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <queue>
#include <random>

#include "base/system/files.hpp"
#include "base/system/timing.hpp"
#include "farm/farm.hpp"
#include "farm/slurm/slurm_farm.hpp"
#include "tests/bench/inputs.hpp"

namespace lobelia::bench {
namespace {

namespace fs = std::filesystem;

Grid grid_of(const fs::path& directory, int cells) {
  constexpr int kMaxExponents = 10000;
  const std::string sizes =
      "<axis name=\"size\" values=\"64, 96, 128, 160, 192, 224, 256, 288, 320, 352\"/>";
  write_file(directory / "grid.xml", grid_of_models(std::min(cells / 10, kMaxExponents),
                                                    cells / 10 > kMaxExponents ? sizes : ""));
  return read_grid(directory / "grid.xml");
}

void planning(const fs::path& directory) {
  fmt::print("\nPlanning, {} threads: lobelia farm --dry-run without its printing\n\n",
             oneapi::tbb::info::default_concurrency());
  fmt::print("| cells | jobs | plan, s | us per cell |\n|---|---|---|---|\n");
  for (const int cells : {1000, 10000, 100000, 1000000}) {
    const Grid grid = grid_of(directory, cells);
    FarmPlan plan;
    const double seconds = seconds_of([&] {
      plan = plan_farm(grid, directory / "none", {}, [](const std::string&, const std::string&) {});
    });
    fmt::print("| {} | {} | {:.2f} | {:.1f} |\n", plan.cells, plan.jobs, seconds,
               1e6 * seconds / double(plan.cells));
  }
}

// ---- beyond this machine ----

struct Cluster {
  int nodes = 1;
  int cores = 32;      ///< of a node
  int threads = 32;    ///< of an element
  double latency = 3;  ///< seconds until the next element runs (docs/farm.md)
  double metadata_per_second =
      2e4;          ///< operations that one server of the shared file system answers
  int servers = 1;  ///< the cache's shelves are spread evenly over them
  double failures_per_node_day = 0.01, requeue = 300;
};

/// Metadata operations of a result on the file server: its directory, its files (create, close, look at, make
/// read-only), its record, the rename, two locks.
double metadata_of(const SlurmJob& job) { return job.phase == 0 ? 28 : 20; }

struct Outcome {
  std::size_t elements = 0;
  double seconds = 0, busy = 0, metadata = 0, lost = 0;
};

/// Each element goes to the place that is free first. Its jobs share its threads evenly. All running elements together
/// cannot be faster than the file server.
Outcome simulate(const std::vector<SlurmJob>& jobs, const Cluster& cluster, std::uint64_t seed) {
  ChunkRule rule;
  const int places_of_node = cluster.cores / cluster.threads;
  rule.slots = std::size_t(cluster.nodes) * std::size_t(places_of_node);
  // The target is wall time; an element with several threads does more seconds of work in it.
  rule.target_seconds *= cluster.threads;
  Outcome outcome;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  double now = 0, work = 0;
  for (const int phase : {0, 1}) {
    std::vector<SlurmJob> of_phase;
    for (const auto& job : jobs)
      if (job.phase == phase) of_phase.push_back(job);
    const auto chunks = make_chunks(of_phase, rule);
    outcome.elements += chunks.size();
    double operations = 0, phase_work = 0;
    std::priority_queue<double, std::vector<double>, std::greater<>> free;
    for (std::size_t i = 0; i < rule.slots; ++i) free.push(now);
    double end = now;
    for (const auto& chunk : chunks) {
      const double cost = cost_of(of_phase, chunk);
      phase_work += cost;
      for (const std::size_t job : chunk) operations += metadata_of(of_phase[job]);
      const double seconds = cost / cluster.threads;
      double start = free.top() + cluster.latency;
      free.pop();
      // A node that dies loses the element's unpublished results: here half of its time on average, and a requeue.
      if (uniform(random) < seconds / 86400 * cluster.failures_per_node_day) {
        outcome.lost += 1;
        start += cluster.requeue + seconds * uniform(random);
      }
      free.push(start + seconds);
      end = std::max(end, start + seconds);
    }
    outcome.metadata += operations;
    now = std::max(end, now + operations / (cluster.metadata_per_second * cluster.servers));
    work += phase_work;
  }
  outcome.seconds = now;
  outcome.busy = work / (now * double(cluster.nodes) * cluster.cores);
  return outcome;
}

std::vector<SlurmJob> jobs_of(std::size_t cells) {
  Scene scene;
  scene.film = {256, 256};
  std::vector<SlurmJob> jobs;
  jobs.reserve(cells * 8);
  const auto add = [&](JobKind kind, const EngineInfo* engine, int phase) {
    jobs.push_back({"", phase, estimated_seconds(kind, engine, scene),
                    std::string(engine ? engine->name : "")});
  };
  for (std::size_t i = 0; i < cells; ++i) {
    add(JobKind::kRender, nullptr, 0);
    for (const EngineInfo& engine : engine_infos()) {
      add(JobKind::kReference, &engine, 0);
      add(JobKind::kCompare, &engine, 1);
    }
    add(JobKind::kProfile, nullptr, 1);
  }
  return jobs;
}

void simulation(std::size_t cells) {
  const std::vector<SlurmJob> jobs = jobs_of(cells);
  double work = 0;
  for (const auto& job : jobs) work += job.seconds;
  fmt::print(
      "\nSimulated: {} cells of 256 x 256 with {} engines, {} jobs, {:.0f} core hours by the estimates that chunks "
      "are cut by; nodes of 32 cores, 3 s until an element runs, 20000 operations on names a second, a node dies "
      "every 100 days and what it had is back after 300 s\n\n",
      cells, engine_infos().size(), jobs.size(), work / 3600);
  fmt::print(
      "| nodes | threads of an element | elements | time, s | cores busy | names a second | lost elements |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const int threads : {1, 32})
    for (const int nodes : {1, 10, 100, 1000}) {
      Cluster cluster;
      cluster.nodes = nodes;
      cluster.threads = threads;
      const Outcome outcome = simulate(jobs, cluster, 1);
      fmt::print("| {} | {} | {} | {:.0f} | {:.0f} % | {:.0f} | {:.0f} |\n", nodes, threads,
                 outcome.elements, outcome.seconds, 100 * outcome.busy,
                 outcome.metadata / outcome.seconds, outcome.lost);
    }
}

/// 1e8 cells: a hundred farms of 1e6, one after the other. Three are simulated, each with failures of its own.
void very_large_simulation() {
  constexpr int kFarms = 100, kSimulated = 3;
  const std::vector<SlurmJob> jobs = jobs_of(1000000);
  fmt::print(
      "\nSimulated: 1e8 cells as {} farms of 1e6, one after the other, on 1000 such nodes; {} farms were simulated\n\n"
      "| file servers | elements of a farm | days | cores busy | names a second | lost elements |\n"
      "|---|---|---|---|---|---|\n",
      kFarms, kSimulated);
  for (const int servers : {1, 10, 100, 1000}) {
    Cluster cluster;
    cluster.nodes = 1000;
    cluster.servers = servers;
    Outcome sum;
    for (int farm = 0; farm < kSimulated; ++farm) {
      const Outcome one = simulate(jobs, cluster, std::uint64_t(farm + 1));
      sum.elements += one.elements, sum.seconds += one.seconds, sum.busy += one.busy;
      sum.metadata += one.metadata, sum.lost += one.lost;
    }
    const double times = double(kFarms) / kSimulated;
    fmt::print("| {} | {} | {:.1f} | {:.0f} % | {:.0f} | {:.0f} |\n", servers,
               sum.elements / kSimulated, sum.seconds * times / 86400, 100 * sum.busy / kSimulated,
               sum.metadata / sum.seconds, sum.lost * times);
  }
}

}  // namespace
}  // namespace lobelia::bench

int main() {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  using namespace lobelia;
  const TemporaryDirectory directory;
  bench::planning(directory.path());
  bench::simulation(100000);
  bench::simulation(1000000);
  bench::very_large_simulation();
}

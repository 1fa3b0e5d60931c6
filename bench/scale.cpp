// The limits of crowds of spheres, and of farms of 1e6 cells and 1e8 cells on 1000 nodes: measured as far as this machine
// allows, simulated beyond.
// docs/scale.md has the conclusions.
#include <fmt/format.h>
#include <malloc.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <numeric>
#include <queue>
#include <random>

#include "bench/inputs.hpp"
#include "core/files.hpp"
#include "core/group_flush.hpp"
#include "core/timing.hpp"
#include "farm/farm.hpp"
#include "farm/result_cache.hpp"
#include "farm/slurm/slurm_farm.hpp"
#include "renderer/accelerator.hpp"
#include "renderer/render.hpp"

namespace lobelia::bench {
namespace {

namespace fs = std::filesystem;

/// Bytes of memory that this process holds now.
double resident_bytes() {
  std::int64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return double(resident) * double(::sysconf(_SC_PAGESIZE));
}

void measure_crowd(CrowdKind kind, const char* title) {
  constexpr int kSide = 256, kSamples = 16;
  fmt::print(
      "\n{}: {} x {}, {} samples, one lamp with shadows, {} threads, median of 5\n"
      "{:>10} {:>13} {:>9} {:>9} {:>9} {:>16}\n",
      title, kSide, kSide, kSamples, oneapi::tbb::info::default_concurrency(), "spheres",
      "bytes of each", "plan s", "build s", "render s", "ns a camera ray");
  for (const auto& lattice :
       {std::array{10, 10, 10}, {25, 20, 20}, {50, 50, 40}, {100, 100, 100}, {200, 200, 100}}) {
    Scene scene = crowd(kind, lattice, kSide);
    scene.sampler.sample_count = kSamples;
    ::malloc_trim(0);  // what was released before would be counted as well
    const double without = resident_bytes();
    auto accelerator = std::make_unique<Accelerator>(scene.spheres);
    const double bytes =
        sizeof(Sphere) + (resident_bytes() - without) / double(scene.spheres.size());
    accelerator.reset();
    std::vector<double> plan, build, trace;
    double rays = 0;
    for (int repeat = 0; repeat < 5; ++repeat) {
      const RenderResult result = render(scene, {});
      plan.push_back(result.plan_seconds);
      build.push_back(result.build_seconds);
      trace.push_back(result.render_seconds - result.build_seconds);
      rays = double(result.work.camera_rays);
    }
    // Below that, what a few pages more or less hold would be counted.
    constexpr std::size_t kCountable = 100000;
    const double seconds = summary(trace).median;
    fmt::print("{:>10} {:>13} {:>9.4f} {:>9.4f} {:>9.4f} {:>16.0f}\n", scene.spheres.size(),
               scene.spheres.size() >= kCountable ? fmt::format("{:.0f}", bytes) : "",
               summary(plan).median, summary(build).median, seconds, 1e9 * seconds / rays);
  }
}

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

ResultKey key_of(std::size_t i) { return result_key({"scale", std::to_string(i)}); }

/// Publishes a result of three small files, as many as a picture has; as a farm does if there is a `flush`.
void publish(const ResultCache& cache, std::size_t i, GroupFlush* flush) {
  const auto claim = std::make_shared<std::optional<ByteLocks::Claim>>(cache.try_claim(key_of(i)));
  const auto draft = std::make_shared<ResultDraft>(cache.draft());
  const auto later = flush ? flush->later() : std::nullopt;
  for (const char* name : {"lobelia.exr", "lobelia.json", "lobelia.png"})
    write_file(draft->file(name), std::string(2000, char('a' + i % 26)));
  records::Result result;
  result.job = "render";
  cache.seal(*draft, key_of(i), result);
  const auto place = [claim, draft, result, i, &cache] { cache.place(*draft, key_of(i), result); };
  flush ? flush->add(draft->files(), place) : place();
}

/// Results per second from `begin` to `end`.
double published(const ResultCache& cache, std::size_t begin, std::size_t end, bool together) {
  return double(end - begin) / seconds_of([&] {
           std::optional<GroupFlush> flush;
           if (together) flush.emplace(std::vector{cache.directory()}, std::rethrow_exception);
           oneapi::tbb::parallel_for(
               begin, end, [&](std::size_t i) { publish(cache, i, flush ? &*flush : nullptr); });
         });
}

void caching(const fs::path& directory) {
  fmt::print(
      "\nA cache on this machine's disk; a result is three files of 2 kB and its record\n\n");
  fmt::print(
      "| results | published per s | each file flushed alone | entries of a shelf, mean and most | list all, ms | look at one, us | "
      "one that is missing, us | claims per s |\n|---|---|---|---|---|---|---|---|\n");
  const ResultCache cache(directory / "cache");
  std::size_t there = 0;
  for (const std::size_t results : {500u, 2000u, 8000u}) {
    const std::size_t half = (there + results) / 2;
    const double alone = published(cache, there, half, false);
    const double together = published(cache, half, results, true);
    there = results;
    std::map<char, std::size_t> shelves;
    std::size_t listed = 0;
    const double list = seconds_of([&] {
      for (const ResultKey& key : cache.list()) {
        ++shelves[char(key.digest[0])];
        ++listed;
      }
    });
    if (listed != results) fmt::print("{} results are listed\n", listed);
    std::size_t most = 0;
    for (const auto& [shelf, count] : shelves) most = std::max(most, count);
    std::size_t found = 0;
    const std::size_t looks = 1000;
    const double look = seconds_of([&] {
      for (std::size_t i = 0; i < looks; ++i)
        found += cache.find(key_of(i * results / looks)) ? 1 : 0;
    });
    const double miss = seconds_of([&] {
      for (std::size_t i = 0; i < looks; ++i) found += cache.has(key_of(results + i)) ? 1 : 0;
    });
    if (found != looks) fmt::print("{} of {} results are found\n", found, looks);
    const double claims = seconds_of([&] {
      for (std::size_t i = 0; i < looks; ++i) (void)cache.try_claim(key_of(i));
    });
    fmt::print("| {} | {:.0f} | {:.0f} | {:.0f}, {} | {:.1f} | {:.1f} | {:.1f} | {:.0f} |\n",
               results, together, alone, double(results) / double(shelves.size()), most, 1e3 * list,
               1e6 * look / double(looks), 1e6 * miss / double(looks), double(looks) / claims);
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
  bench::measure_crowd(bench::CrowdKind::kPacked,
                       "Packed crowd, spheres of 0.4 times their spacing");
  bench::measure_crowd(bench::CrowdKind::kThin,
                       "Thin crowd, a ray through it meets half a sphere on average");
  const TemporaryDirectory directory;
  bench::planning(directory.path());
  bench::caching(directory.path());
  bench::simulation(100000);
  bench::simulation(1000000);
  bench::very_large_simulation();
}

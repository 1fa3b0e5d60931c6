#include "reference_scenes/povray/povray.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/interrupt.hpp"
#include "core/text.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/povray/povray_input.hpp"
#include "reference_scenes/povray/povray_options.hpp"
#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

/// POV-Ray 3.7 sleeps through most of the 0.7 s that a small picture takes it; a large one works.
constexpr int kProcessesPerProcessor = 4;
constexpr std::size_t kLargePixels = 1 << 20;
constexpr std::uint64_t kMaxLogBytes = 16 << 20;

constexpr EngineProbe kProbe{"povray", "POV-Ray ", [](int major, int minor) {
                               return major == 3 && (minor == 7 || minor == 8);
                             }};

struct PassResult {
  Image image;
  std::string error;
  std::vector<std::string> commands;
  bool writes_limited = false;
  double seconds = 0;
  double parse_seconds = 0, trace_seconds = 0;  ///< by its statistics, where they were asked for
};

/// The passes of one scene, filled in by whichever thread comes to them.
struct Job {
  PovrayInput input;
  Film film;
  std::vector<std::string> options;
  std::vector<PassResult> passes;
  std::size_t unfinished = 0;
};

struct WorkItem {
  std::size_t job, pass;
};

std::string pass_stem(std::size_t scene, std::size_t pass) {
  return fmt::format("scene{}-pass{}", scene, pass);
}

/// "  Trace Time:       0 hours  0 minutes  0 seconds (0.029 seconds)"; 0 for any other line.
double seconds_in(std::string_view line, std::string_view what) {
  const auto from = line.find('('), to = line.find(" seconds)");
  double seconds = 0;
  if (line.find(what) != line.npos && from != line.npos && to != line.npos && from < to)
    parse_number(line.substr(from + 1, to - from - 1), seconds);
  return seconds;
}

/// Of the pass that shows what this one's picture rounds off.
std::string rest_of(const std::string& stem) { return stem + "-rest"; }

Image read_pass(const fs::path& file, const Film& film, double gain) {
  Image image = read_image(file);
  if (image.width() != film.width || image.height() != film.height)
    throw Error(ExitCode::kEngine, "POV-Ray's picture has another size than was asked for");
  for (float& value : image.values()) value = float(value / gain);
  return image;
}

class Povray final : public Engine {
 public:
  explicit Povray(fs::path program) : wanted_program_(std::move(program)) {}

  const EngineInfo& info() const override { return kPovrayInfo; }

  const EngineStatus& status() override {
    if (!probed_) {
      status_ = probe_engine(kPovrayInfo, kProbe, wanted_program_);
      probed_ = true;
    }
    return status_;
  }

 protected:
  std::string why_not_simple(const Scene& scene, const ReferenceOptions& options) const override {
    return why_not_in_povray(scene, options);
  }
  void render_simple(std::span<const Scene> scenes, const ReferenceOptions& options,
                     const OnResult& on_result) override;

 private:
  PassResult run_pass(const std::string& stem, const Job& job, const PovrayPass& pass,
                      const ReferenceOptions& options) const;
  PassResult run_pov(const std::string& stem, const Job& job, const PovrayPass& pass,
                     const ReferenceOptions& options) const;
  std::string joined_logs(std::size_t index, const std::vector<PassResult>& passes) const;

  fs::path wanted_program_, directory_;
  std::vector<std::string> environment_;
  EngineStatus status_;
  bool probed_ = false;
};

PassResult Povray::run_pov(const std::string& stem, const Job& job, const PovrayPass& pass,
                           const ReferenceOptions& options) const {
  PassResult result;
  write_povray_ini(directory_, stem, pass.gain, job.options);
  const std::vector<std::string> arguments{status_.program.string(), stem + ".ini"};
  ProcessOptions process;
  process.working_directory = directory_;
  process.writable = directory_;
  process.on_start = [&](bool writes_limited) { result.writes_limited = writes_limited; };
  process.environment = environment_;
  process.timeout = options.time_limit;
  process.log = directory_ / (stem + ".log");
  if (options.stages)
    process.on_line = [&](std::string_view line) {
      result.parse_seconds += seconds_in(line, "Parse Time:") + seconds_in(line, "Bounding Time:");
      result.trace_seconds += seconds_in(line, "Trace Time:");
    };
  const ProcessResult ended = run_process(arguments, process);
  if (ended.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  result.commands.push_back(shell_join(arguments));
  result.seconds = ended.seconds;
  const fs::path picture = directory_ / (stem + ".exr");
  if (ended.exit_code != 0 || ended.timed_out) {
    result.error = describe_failure(kPovrayInfo, ended, options.time_limit.count());
  } else if (!fs::exists(picture)) {
    result.error = fmt::format("POV-Ray wrote no picture: {}", last_words(ended.output_tail));
  } else {
    try {
      result.image = read_pass(picture, job.film, pass.gain);
    } catch (const Error& error) {
      result.error = fmt::format("POV-Ray's picture cannot be used: {}", error.what());
    }
  }
  return result;
}

/// The pass, and where it was asked for a second one that shows what half floats left out of the first.
PassResult Povray::run_pass(const std::string& stem, const Job& job, const PovrayPass& pass,
                            const ReferenceOptions& options) const {
  const std::string coarse = stem + ".exr", rest = rest_of(stem);
  write_file(directory_ / (stem + ".pov"), pass.scene());
  PassResult result = run_pov(stem, job, pass, options);
  if (options.fine && result.error.empty()) {
    write_file(directory_ / (rest + ".pov"), pass.rest(coarse));
    const PassResult left = run_pov(rest, job, pass, options);
    result.error = left.error;
    result.commands.push_back(left.commands.front());
    result.seconds += left.seconds;
    result.parse_seconds += left.parse_seconds;
    result.trace_seconds += left.trace_seconds;
    result.writes_limited = result.writes_limited && left.writes_limited;
    if (left.error.empty())
      for (std::size_t i = 0; i < result.image.values().size(); ++i)
        result.image.values()[i] += 2 * left.image.values()[i];
  }
  std::error_code ignored;
  for (const std::string& picture : {coarse, rest + ".exr"})
    fs::remove(directory_ / picture,
               ignored);  // of many large ones only those at work lie on the disk
  return result;
}

std::string Povray::joined_logs(std::size_t index, const std::vector<PassResult>& passes) const {
  std::string text;
  for (std::size_t p = 0; p < passes.size(); ++p) {
    std::string stem = pass_stem(index, p);
    for (const std::string& command : passes[p].commands) {
      const fs::path log = directory_ / (stem + ".log");
      text += "$ " + command + "\n";
      if (fs::exists(log)) text += read_file(log, kMaxLogBytes);
      stem = rest_of(stem);
    }
  }
  return text;
}

ReferenceResult finish(Job& job, const ReferenceOptions& options, Json record) {
  ReferenceResult result;
  const bool fine = options.fine;
  double seconds = 0, parse_seconds = 0, trace_seconds = 0;
  bool writes_limited = true;
  Json commands = Json::array();
  std::vector<Image> images;
  for (PassResult& pass : job.passes) {
    if (result.error.empty()) result.error = pass.error;
    seconds += pass.seconds;
    parse_seconds += pass.parse_seconds;
    trace_seconds += pass.trace_seconds;
    writes_limited = writes_limited && pass.writes_limited;
    for (const std::string& command : pass.commands) commands.push_back(command);
    images.push_back(std::move(pass.image));
  }
  record["witness"] = job.input.native ? "native" : "expressed";
  record["method"] = job.input.native ? "POV-Ray's own highlight under its own lamps"
                                      : "pattern function under a real lamp, one pass per light";
  if (fine)
    record["method"] =
        record["method"].get<std::string>() +
        "; twice, the second time less the first picture, for what half floats round off";
  record["passes"] = job.passes.size();
  record["engineCommands"] = std::move(commands);
  record["engineOptions"] = job.options;
  record["writesLimited"] = writes_limited;
  record["seconds"] = {{"total", seconds}};
  if (options.stages) {
    record["seconds"]["parse"] = parse_seconds;
    record["seconds"]["trace"] = trace_seconds;
  }
  result.record = std::move(record);
  if (result.error.empty()) result.image = sum_of(images);
  job.passes.clear();
  return result;
}

void Povray::render_simple(std::span<const Scene> scenes, const ReferenceOptions& options,
                           const OnResult& on_result) {
  const TemporaryDirectory directory;
  directory_ = directory.path();
  environment_ = povray_home(directory_, status_.version);

  std::vector<Job> jobs(scenes.size());
  std::vector<WorkItem> work;
  std::map<std::string, std::string> includes;  // of all jobs: a name always has the same text
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    try {
      jobs[i].input = povray_input(in_engine_units(scenes[i]), options);
    } catch (const Error& refused) {
      on_result(i, {{}, {}, refused.what(), reference_record(kPovrayInfo, status_, scenes[i])});
      continue;
    }
    includes.merge(jobs[i].input.includes);
    jobs[i].film = scenes[i].film;
    jobs[i].unfinished = jobs[i].input.passes.size();
    jobs[i].passes.resize(jobs[i].unfinished);
    for (std::size_t p = 0; p < jobs[i].unfinished; ++p) work.push_back({i, p});
  }
  for (const auto& [file, text] : includes) write_file(directory_ / file, text);

  const int processors = options.threads > 0
                             ? options.threads
                             : int(std::max(1u, std::thread::hardware_concurrency()));
  const bool large = std::ranges::any_of(jobs, [](const Job& job) {
    return std::size_t(job.film.width) * job.film.height > kLargePixels;
  });
  const int processes = processors * (large ? 1 : kProcessesPerProcessor);
  const int workers = int(std::min(work.size(), std::size_t(processes)));
  const int threads_each = workers > 0 ? std::max(1, processors / workers) : 1;
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;  // of the jobs' bookkeeping, on_result and the first failure
  std::exception_ptr failure;
  for (Job& job : jobs) job.options = povray_options(job.film, threads_each, options.stages);
  const auto run = [&] {
    try {
      for (std::size_t i; !stop && (i = next++) < work.size();) {
        throw_if_interrupted();
        const auto [index, pass] = work[i];
        Job& job = jobs[index];
        const std::string stem = pass_stem(index, pass);
        PassResult result = run_pass(stem, job, job.input.passes[pass], options);
        const std::scoped_lock lock(mutex);
        job.passes[pass] = std::move(result);
        if (--job.unfinished > 0 || stop) continue;
        write_engine_log(options, kPovrayInfo, index, joined_logs(index, job.passes));
        on_result(index,
                  finish(job, options, reference_record(kPovrayInfo, status_, scenes[index])));
      }
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!failure) failure = std::current_exception();
      stop = true;
    }
  };
  {
    std::vector<std::jthread> pool;
    for (int i = 0; i < workers; ++i) pool.emplace_back(run);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

std::unique_ptr<Engine> make_povray(const fs::path& program) {
  return std::make_unique<Povray>(program);
}

void keep_povray_input(const Scene& scene, const ReferenceOptions& options,
                       const fs::path& directory) {
  const PovrayInput input = povray_input(in_engine_units(scene), options);
  for (const auto& [file, text] : input.includes) write_file(directory / file, text);
  std::string commands;
  for (std::size_t p = 0; p < input.passes.size(); ++p) {
    const std::string stem = fmt::format("pass{}", p);
    const auto keep = [&](const std::string& name, const std::string& text) {
      write_file(directory / (name + ".pov"), text);
      write_povray_ini(directory, name, input.passes[p].gain, povray_options(scene.film, 1));
      commands += fmt::format("povray {}.ini\n", name);
    };
    keep(stem, input.passes[p].scene());
    if (options.fine) {
      commands += fmt::format("# Twice this one's picture is to be added to {}.exr.\n", stem);
      keep(rest_of(stem), input.passes[p].rest(stem + ".exr"));
    }
  }
  write_file(directory / "povray.sh", commands);
}

}  // namespace lobelia

#include "reference_scenes/engines/povray/povray.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>

#include "core/at_once.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/interrupt.hpp"
#include "core/removal.hpp"
#include "core/text.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/engines/povray/povray_input.hpp"
#include "reference_scenes/engines/povray/povray_options.hpp"
#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

/// POV-Ray 3.7 sleeps through most of the 0.7 to 1.1 s that a small picture takes it; a large one works.
constexpr double kSecondsAsleep = 1;
constexpr int kProcessesPerProcessor = 16;
constexpr double kFirstPerProcessor = 12;  // until one has ended and told how long it worked
constexpr std::size_t kLargePixels = 1 << 20;

constexpr EngineProbe kPovrayProbe{"povray", "POV-Ray ", [](int major, int minor) {
                                     return major == 3 && (minor == 7 || minor == 8);
                                   }};

struct PassResult {
  std::chrono::steady_clock::time_point begun = {};
  Image image;
  Failure failure;
  std::vector<std::string> commands;
  EngineLog log;
  ProcessLimits limits{true, Containment::kPidNamespace};  ///< the weakest of its processes
  double seconds = 0, cpu_seconds = 0;
  std::uint64_t peak_memory_bytes = 0;
  double parse_seconds = 0, trace_seconds = 0;  ///< by its statistics, where they were asked for
};

/// One scene.
struct Job {
  PovrayInput input;
  Film film;
  std::vector<std::string> options;
  int threads = 1;  ///< of each process
  fs::path directory;
};

/// Also of what keep_povray_input() writes, so that messages name a file that is there.
std::string pass_stem(std::size_t pass) { return fmt::format("pass{}", pass); }

/// "  Trace Time:       0 hours  0 minutes  0 seconds (0.029 seconds)"; 0 for any other line.
double seconds_in(std::string_view line, std::string_view what) {
  const auto from = line.find('('), to = line.find(" seconds)");
  double seconds = 0;
  if (line.find(what) != line.npos && from != line.npos && to != line.npos && from < to)
    parse_number(line.substr(from + 1, to - from - 1), seconds);
  return seconds;
}

/// Lets in so many processes that the processors are busy though each of them mostly sleeps.
class Gate {
 public:
  /// For at most `most` processes at once.
  Gate(int processors, int most) : processors_(processors), most_(most) {}
  /// One process after the other. Those of large pictures keep the processors busy by themselves.
  class Visit {
   public:
    Visit(Gate& gate, bool large) : gate_(gate), large_(large) { gate.enter(large); }
    ~Visit() { gate_.leave(large_, cpu_seconds); }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;
    double cpu_seconds = 0;  ///< of each process; 0 where that is not known

   private:
    Gate& gate_;
    const bool large_;
  };
  /// Of processes that are not there, as far as can be told.
  int room() {
    const std::scoped_lock lock(mutex_);
    return std::max(0, most_ - inside_);
  }

 private:
  void enter(bool large) {
    std::unique_lock lock(mutex_);
    leave_.wait(lock, [&] { return inside_ < limit(large || large_inside_ > 0); });
    ++inside_;
    large_inside_ += large;
  }
  void leave(bool large, double cpu_seconds) {
    {
      const std::scoped_lock lock(mutex_);
      --inside_;
      large_inside_ -= large;
      // The last few count: the next scenes may be of another kind.
      if (cpu_seconds > 0)
        mean_ = mean_ > 0 ? mean_ + (cpu_seconds - mean_) / processors_ / 4 : cpu_seconds;
    }
    leave_.notify_all();
  }
  int limit(bool large) const {
    const double each = large ? 1 : mean_ > 0 ? 1 + kSecondsAsleep / mean_ : kFirstPerProcessor;
    return int(std::clamp(each * processors_, 1.0, double(most_)));
  }
  const int processors_, most_;
  std::mutex mutex_;
  std::condition_variable leave_;
  int inside_ = 0, large_inside_ = 0;
  double mean_ = 0;
};

class PovraySession final : public SimpleSession {
 public:
  PovraySession(const EngineStatus& status, const ReferenceOptions& options)
      : status_(status),
        options_(options),
        processors_(threads_of(options)),
        processes_(options.processes > 0 ? options.processes
                                         : processors_ * kProcessesPerProcessor),
        gate_(processors_, processes_) {}

  ReferenceResult render(const Scene& scene, std::size_t scenes) override;
  int at_once(std::size_t scenes) const override {
    return int(std::clamp(scenes, std::size_t{1}, std::size_t(processes_)));
  }
  void stop() override { stop_ = true; }

 private:
  PassResult run_pass(const Job& job, std::size_t pass);
  void run_pov(PassResult& result, const Job& job, const PovrayPass& pass, const std::string& stem,
               const fs::path& home) const;

  const EngineStatus& status_;
  const ReferenceOptions options_;
  const int processors_, processes_;
  const TemporaryDirectory directory_;
  std::atomic<std::size_t> begun_ = 0;
  Gate gate_;
  std::atomic<bool> stop_ = false;
};

class Povray final : public ProgramEngine {
 public:
  explicit Povray(const fs::path& program) : ProgramEngine(kPovrayInfo, kPovrayProbe, program) {}

 protected:
  std::string why_not_simple(const Scene& scene, const ReferenceOptions& options) const override {
    return why_not_in_povray(scene, options);
  }
  std::unique_ptr<SimpleSession> open_simple(const ReferenceOptions& options) override {
    return std::make_unique<PovraySession>(status(), options);
  }
};

/// Renders `stem`.pov in `home`, and adds to the result what it took.
void PovraySession::run_pov(PassResult& result, const Job& job, const PovrayPass& pass,
                            const std::string& stem, const fs::path& home) const {
  write_povray_ini(home, stem, pass.gain, job.options);
  const std::vector<std::string> arguments{status_.program.string(), stem + ".ini"};
  ProcessOptions process;
  process.working_directory = process.writable = process.progress_directory = home;
  process.on_start = [&](const ProcessLimits& limits) {
    result.limits = weaker(result.limits, limits);
  };
  process.environment = povray_home(home, status_.version);
  process.timeout = options_.time_limit;
  process.no_progress_limit = options_.no_progress_limit;
  process.stop = &stop_;
  const std::string command = shell_join(arguments);
  result.log.add("$ " + command);
  process.on_line = [&](std::string_view line) {
    result.log.add(line);
    if (!options_.stages) return;
    result.parse_seconds += seconds_in(line, "Parse Time:") + seconds_in(line, "Bounding Time:");
    result.trace_seconds += seconds_in(line, "Trace Time:");
  };
  ProcessResult ended;
  // It waits some seconds for its own thread to start, which is not enough on a crowded machine.
  constexpr std::string_view kSlowStart = "Timed out waiting for worker thread startup";
  constexpr int kMostStarts = 5;
  for (int start = 0; start < kMostStarts; ++start) {
    result.failure = run_engine(kPovrayInfo, arguments, process, options_, ended);
    result.commands.push_back(command);
    result.seconds += ended.seconds;
    result.cpu_seconds += ended.cpu_seconds;
    result.peak_memory_bytes = std::max(result.peak_memory_bytes, ended.peak_memory_bytes);
    if (!result.failure) break;
    if (ended.output_tail.find(kSlowStart) == ended.output_tail.npos) return;
  }
  if (result.failure) return;
  Image image;
  result.failure = read_engine_picture(kPovrayInfo, home / (stem + ".exr"), job.film, image);
  if (const std::string words = last_words(ended.output_tail);
      result.failure.kind == FailureClass::kNoOutput && !words.empty())
    result.failure.message += ": " + words;
  if (result.failure) return;
  // The second of two passes shows half of the first one's rounding.
  const bool first = result.image.pixel_count() == 0;
  if (first) result.image = Image(image.width(), image.height());
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const float value = float(image.values()[i] / pass.gain);
    if (first)
      result.image.values()[i] = value;
    else
      result.image.values()[i] += 2 * value;
  }
}

/// The pass, and where it was asked for a second one that shows what half floats left out of the first; in
/// a directory that has nothing else, so that whatever happens there is progress of this pass.
PassResult PovraySession::run_pass(const Job& job, std::size_t index) {
  const PovrayPass& pass = job.input.passes[index];
  const std::string stem = pass_stem(index);
  const fs::path home = fmt::format("{}-{}", job.directory.string(), stem);
  const bool large = std::size_t(job.film.width) * job.film.height > kLargePixels;
  PassResult result;
  Gate::Visit visit(gate_, large && options_.processes == 0);
  if (stop_) throw Error(ExitCode::kInterrupted, "interrupted");
  throw_if_interrupted();
  result.begun = std::chrono::steady_clock::now();
  make_directories(home);
  for (const auto& [file, text] : job.input.includes) write_file(home / file, text);
  write_file(home / (stem + ".pov"), pass.scene());
  run_pov(result, job, pass, stem, home);
  if (options_.fine && !result.failure) {
    const std::string rest = stem + "-rest";
    write_file(home / (rest + ".pov"), pass.rest(stem + ".exr"));
    run_pov(result, job, pass, rest, home);
  }
  visit.cpu_seconds = result.cpu_seconds / double(result.commands.size());
  remove_in_temporary_directory(home);  // of many large pictures only those at work lie on the disk
  return result;
}

ReferenceResult finish(const Job& job, std::vector<PassResult>& passes,
                       const ReferenceOptions& options, records::Reference record) {
  ReferenceResult result;
  const bool fine = options.fine;
  double seconds = 0, cpu_seconds = 0, parse_seconds = 0, trace_seconds = 0;
  std::uint64_t peak_memory_bytes = 0;
  ProcessLimits limits{true, Containment::kPidNamespace};
  std::vector<std::string> commands;
  std::vector<Image> images;
  result.begun = std::ranges::min(passes, {}, &PassResult::begun).begun;
  for (PassResult& pass : passes) {
    result.log += pass.log.text();
    if (result.error.empty() && pass.failure) {
      result.error = pass.failure.message;
      result.failure = pass.failure.kind;
    }
    seconds += pass.seconds;
    cpu_seconds += pass.cpu_seconds;
    peak_memory_bytes = std::max(peak_memory_bytes, pass.peak_memory_bytes);
    parse_seconds += pass.parse_seconds;
    trace_seconds += pass.trace_seconds;
    limits = weaker(limits, pass.limits);
    for (const std::string& command : pass.commands) commands.push_back(command);
    images.push_back(std::move(pass.image));
  }
  record.witness = job.input.native ? "native" : "expressed";
  record.method = job.input.native ? "POV-Ray's own highlight under its own lamps"
                                   : "pattern function under a real lamp, one pass per light";
  if (fine)
    record.method +=
        "; twice, the second time less the first picture, for what half floats round off";
  record.passes = passes.size();
  record.engine_commands = std::move(commands);
  record.engine_options = job.options;
  record_limits(record, limits);
  record.seconds.total = seconds;
  record_cost(record, cpu_seconds, peak_memory_bytes, job.threads);
  if (options.stages) {
    record.seconds.parse = parse_seconds;
    record.seconds.trace = trace_seconds;
  }
  result.record = std::move(record);
  if (result.error.empty()) result.image = sum_of(images);
  return result;
}

ReferenceResult PovraySession::render(const Scene& scene, std::size_t scenes) {
  Job job;
  try {
    job.input = povray_input(in_engine_units(scene), options_);
  } catch (const Error& refused) {
    return failed_result(kPovrayInfo, status_, scene, {FailureClass::kRefused, refused.what()});
  }
  std::vector<PassResult> passes(job.input.passes.size());
  job.film = scene.film;
  job.threads = std::max(1, processors_ / at_once(scenes * passes.size()));
  job.options = povray_options(job.film, job.threads, options_.stages);
  job.directory = directory_.path() / fmt::format("scene{}", begun_++);
  // Where there is room, passes go side by side; elsewhere other scenes do.
  for_each_at_once(
      passes.size(), 1 + gate_.room(), [&](std::size_t p) { passes[p] = run_pass(job, p); },
      [this] { stop(); });
  return finish(job, passes, options_, reference_record(kPovrayInfo, status_, scene));
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
    const std::string stem = pass_stem(p);
    const auto keep = [&](const std::string& name, const std::string& text) {
      write_file(directory / (name + ".pov"), text);
      write_povray_ini(directory, name, input.passes[p].gain, povray_options(scene.film, 1));
      commands += fmt::format("povray {}.ini\n", name);
    };
    keep(stem, input.passes[p].scene());
    if (options.fine) {
      commands += fmt::format("# Twice this one's picture is to be added to {}.exr.\n", stem);
      keep(stem + "-rest", input.passes[p].rest(stem + ".exr"));
    }
  }
  write_file(directory / "povray.sh", commands);
}

}  // namespace lobelia

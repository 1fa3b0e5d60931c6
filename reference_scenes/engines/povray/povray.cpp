#include "reference_scenes/engines/povray/povray.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>

#include "base/pictures/image_io.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/removal.hpp"
#include "base/words/text.hpp"
#include "reference_scenes/at_once.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/engines/povray/povray_input.hpp"
#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

/// POV-Ray 3.7 sleeps for most of the 0.7 to 1.1 s that a small picture takes.
constexpr double kSecondsAsleep = 1;
constexpr int kProcessesPerProcessor = 16;
constexpr double kFirstPerProcessor = 12;  // until one has ended and its CPU time is known
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
  EngineCost cost;
};

/// One scene.
struct Job {
  PovrayInput input;
  Film film;
  std::vector<std::string> options;
  int threads = 1;  ///< of each process
  fs::path directory;
};

/// The weaker of two processes' limits.
ProcessLimits weaker(const ProcessLimits& a, const ProcessLimits& b) {
  return {a.writes_limited && b.writes_limited, std::min(a.contained, b.contained)};
}

/// Admits enough processes, up to `most`, to keep the processors busy although each process mostly sleeps.
class Gate {
 public:
  Gate(int processors, int most) : processors_(processors), most_(most) {}
  /// One process after another. A large picture keeps the processors busy by itself.
  class Visit {
   public:
    Visit(Gate& gate, bool large) : gate_(gate), large_(large) { gate.enter(large); }
    ~Visit() { gate_.leave(large_, cpu_seconds); }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;
    double cpu_seconds = 0;  ///< of each process; 0: not known

   private:
    Gate& gate_;
    const bool large_;
  };
  /// How many more processes may start now.
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
      // A running mean, because the next scenes may differ.
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

/// Renders `stem`.pov in `home`, and adds its picture and cost to the result.
void PovraySession::run_pov(PassResult& result, const Job& job, const PovrayPass& pass,
                            const std::string& stem, const fs::path& home) const {
  write_povray_ini(home, stem, pass.gain, job.options);
  const std::vector<std::string> arguments{status_.program.string(), stem + ".ini"};
  ProcessOptions process;
  process.on_start = [&](const ProcessLimits& limits) {
    result.limits = weaker(result.limits, limits);
  };
  process.environment = povray_home(home, status_.version);
  process.timeout = options_.time_limit;
  process.stop = &stop_;
  const std::string command = shell_join(arguments);
  result.log.add("$ " + command);
  process.on_line = [&](std::string_view line) { result.log.add(line); };
  ProcessResult ended;
  // POV-Ray waits a few seconds for its own thread to start, too short on a busy machine.
  constexpr std::string_view kSlowStart = "Timed out waiting for worker thread startup";
  constexpr int kMostStarts = 5;
  for (int start = 0; start < kMostStarts; ++start) {
    result.failure = run_engine(kPovrayInfo, arguments, home, process, options_, ended);
    result.commands.push_back(command);
    result.cost.add({ended.seconds, ended.cpu_seconds, ended.peak_memory_bytes});
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
  for (float& value : image.values()) value = float(value / pass.gain);
  if (result.image.pixel_count() == 0) {
    result.image = std::move(image);
    return;
  }
  // The second of two pictures shows half of the first one's rounding error.
  for (std::size_t i = 0; i < image.values().size(); ++i)
    result.image.values()[i] += 2 * image.values()[i];
}

/// Renders the pass, and with `fine` a second picture of the first one's rounding error, in a directory of its own, so that
/// every change there is progress of this pass.
PassResult PovraySession::run_pass(const Job& job, std::size_t index) {
  const PovrayPass& pass = job.input.passes[index];
  const std::string stem = povray_pass_stem(index);
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
  visit.cpu_seconds = result.cost.cpu_seconds / double(result.commands.size());
  remove_in_temporary_directory(home);  // large pictures must not pile up on the disk
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
  job.options = povray_options(job.film, job.threads);
  job.directory = directory_.path() / fmt::format("scene{}", begun_++);
  // Passes run side by side if there is room; otherwise other scenes do.
  for_each_at_once(
      passes.size(), 1 + gate_.room(), [&](std::size_t p) { passes[p] = run_pass(job, p); },
      [this] { stop(); });

  PassResult all;
  std::vector<Image> images;
  ReferenceResult result;
  for (PassResult& pass : passes) {
    result.log += pass.log.text();
    if (!all.failure) all.failure = pass.failure;
    all.cost.add(pass.cost);
    all.limits = weaker(all.limits, pass.limits);
    std::ranges::move(pass.commands, std::back_inserter(all.commands));
    images.push_back(std::move(pass.image));
  }
  result.begun = std::ranges::min(passes, {}, &PassResult::begun).begun;
  result.error = all.failure.message;
  result.failure = all.failure.kind;
  if (!all.failure) result.image = sum_of(images);
  records::Reference& record = result.record = reference_record(kPovrayInfo, status_, scene);
  record.shading = job.input.native ? "native" : "expressed";
  record.method = job.input.native ? "POV-Ray's own highlight under its own lamps"
                                   : "pattern function under a real lamp, one pass per light";
  if (options_.fine)
    record.method +=
        "; twice, the second time less the first picture, for what half floats round off";
  record.passes = passes.size();
  record.engine_commands = std::move(all.commands);
  record.engine_options = job.options;
  record_limits(record, all.limits);
  record.seconds.total = all.cost.seconds;
  record_cost(record, all.cost, job.threads);
  return result;
}

}  // namespace

std::unique_ptr<Engine> make_povray(const fs::path& program) {
  return std::make_unique<Povray>(program);
}

void keep_povray_input(const Scene& scene, const ReferenceOptions& options,
                       const fs::path& directory) {
  for (const auto& [file, text] : povray_files(scene, options)) write_file(directory / file, text);
}

}  // namespace lobelia

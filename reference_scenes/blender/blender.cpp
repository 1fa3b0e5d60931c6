#include "reference_scenes/blender/blender.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <mutex>
#include <optional>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/removal.hpp"
#include "core/text.hpp"
#include "records/record.hpp"
#include "reference_scenes/blender/blender_input.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/preparation.hpp"
#include "reference_scenes/worker_pool.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view render_scenes_py;
}
namespace {
namespace fs = std::filesystem;

constexpr char kScriptFile[] = "render_scenes.py";
constexpr char kJobFile[] = "job.json";
constexpr char kNextFile[] = "next.json";
constexpr int kSigAlrm = 14;
/// Processes in a row that came to no scene at all: then none will.
constexpr int kMostIdleStarts = 3;

/// The node groups' and point primitives' interface that render_scenes.py uses.
/// Of a release as it is unpacked, and of a package: "3.4" beside the program, or ../share/blender. The Python of a
/// release is none of it: what our script uses of that decides no pixel.
std::vector<fs::path> blender_directories(const fs::path& program, std::string_view version) {
  std::error_code ignored;
  const fs::path place = fs::weakly_canonical(program, ignored).parent_path();
  const auto minor = version.find('.', version.find('.') + 1);
  const std::string series(version.substr(0, minor));
  std::vector<fs::path> directories;
  for (const fs::path& base : {place / series, place.parent_path() / "share" / "blender",
                               place.parent_path() / "share" / "blender" / series})
    for (const char* part : {"scripts", "datafiles"}) directories.push_back(base / part);
  return directories;
}

constexpr EngineProbe kProbe{
    "blender", "Blender ",
    [](int major, int minor) { return major == 4 || (major == 3 && minor >= 4); },
    blender_directories};

/// Without the user's start-up file and add-ons, and with Python's failures as failures.
/// `directory` holds script and job; Blender must be told where it is, because it believes $PWD
/// rather than its working directory.
std::vector<std::string> blender_arguments(const std::string& program, const fs::path& directory) {
  return {program,
          "-b",
          "--factory-startup",
          "-noaudio",
          "--python-exit-code",
          "9",
          "--python",
          (directory / kScriptFile).string(),
          "--",
          (directory / kJobFile).string()};
}

BlenderJob empty_job(int threads, const ReferenceOptions& options) {
  BlenderJob job;
  job.threads = threads;
  job.seconds_per_scene = options.time_limit.count();
  return job;
}

/// Adds up a scene's passes, and removes them.
Failure read_passes(const fs::path& directory, const std::string& name, const Scene& scene,
                    std::size_t passes, Image& sum) {
  std::vector<Image> images(passes);
  for (std::size_t pass = 0; pass < passes; ++pass) {
    const fs::path file = directory / fmt::format("{}-{}.exr", name, pass);
    if (Failure failure = read_engine_picture(kBlenderInfo, file, scene.film, images[pass]))
      return failure;
    remove_in_temporary_directory(file);
  }
  sum = sum_of(images);
  return {};
}

/// Two ends of a line: ours, and that which a program has as its stdin.
class Line {
 public:
  Line() {
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_) != 0)
      throw Error(ExitCode::kEngine, fmt::format("no socket: {}", std::strerror(errno)));
  }
  ~Line() {
    for (const int end : ends_) ::close(end);
  }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  int theirs() const { return ends_[1]; }
  /// A few words, which never have to wait for anyone to read them. One who has gone will be missed soon.
  void say(std::string_view words) { ::send(ends_[0], words.data(), words.size(), MSG_NOSIGNAL); }
  /// Nothing more to say.
  void end() { ::shutdown(ends_[0], SHUT_WR); }

 private:
  int ends_[2];
};

/// Where the time of a scene goes, by when Blender says that it goes on.
class StageClock {
 public:
  void restart() { *this = {}; }
  void take(std::string_view line) {
    const auto ends = [&](std::string_view words) { return line.find(words) != line.npos; };
    if (ends("lobelia: begin")) {
      end(start_);
    } else if (ends("| Sample 0/")) {
      end(parse_);
    } else if (ends("| Finished")) {
      end(trace_);
    } else if (line.starts_with(" Time: ") || ends("lobelia: done")) {
      end(write_);
    }
  }
  void report(records::EngineSeconds& seconds) const {
    seconds.start = start_;
    seconds.parse = parse_;
    seconds.trace = trace_;
    seconds.write = write_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  void end(double& stage) {
    const auto now = Clock::now();
    stage += std::chrono::duration<double>(now - since_).count();
    since_ = now;
  }
  Clock::time_point since_ = Clock::now();
  double start_ = 0, parse_ = 0, trace_ = 0, write_ = 0;
};

/// What is common to the processes of one call of render(): the scenes that wait, and whom to tell.
struct Shared {
  std::span<const Scene> scenes;
  const ReferenceOptions& options;
  const EngineStatus& status;
  const std::function<void(std::size_t, ReferenceResult)>& on_result;
  int threads;  ///< of one process
  std::atomic<bool> stop{false};
  std::mutex waiting_mutex{}, result_mutex{};
  std::deque<std::size_t> waiting{};
  std::atomic<int> idle_starts{0};  ///< in a row, of all processes

  bool native() const { return options.witness == Witness::kNative; }
  std::optional<std::size_t> take_next() {
    const std::scoped_lock lock(waiting_mutex);
    if (waiting.empty()) return {};
    const std::size_t index = waiting.front();
    waiting.pop_front();
    return index;
  }
  void put_back(std::size_t index) {
    const std::scoped_lock lock(waiting_mutex);
    waiting.push_front(index);
  }
  void tell(std::size_t index, const EngineLog& log, ReferenceResult result) {
    const std::scoped_lock lock(result_mutex);
    if (stop) return;
    if (!log.text().empty()) write_engine_log(options, kBlenderInfo, index, log.text());
    on_result(index, std::move(result));
  }
};

std::string name_of(std::size_t index) { return fmt::format("scene{}", index); }

/// Processes one after the other, each of which is given one scene after the other for as long as it lives.
class BlenderWorker {
 public:
  explicit BlenderWorker(Shared& shared) : shared_(shared), options_(shared.options) {}

  void run() {
    write_file(directory_.path() / kScriptFile, embedded::render_scenes_py);
    while (!shared_.stop) {
      throw_if_interrupted();
      given_ = next();
      if (!given_) return;
      run_process_from(*given_);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Given {
    std::size_t index = 0;
    BlenderScene input;
  };
  /// Of which Blender says that it is done.
  struct Done {
    Given given;
    EngineLog log;
    StageClock clock;
    double seconds = 0, cpu_seconds = 0;
    std::uint64_t peak_memory_bytes = 0;
    bool cost_told = false;
  };

  /// The next scene that may begin and that Blender can show.
  std::optional<Given> next() {
    while (const auto index = shared_.take_next()) {
      if (!may_begin(options_, *index)) continue;
      try {
        return Given{*index, blender_input(in_engine_units(shared_.scenes[*index]), name_of(*index),
                                           shared_.native())};
      } catch (const Error& refused) {
        shared_.tell(*index, {}, failed(*index, {FailureClass::kRefused, refused.what()}));
      }
    }
    return {};
  }

  /// Whatever happens, fewer scenes wait afterwards, or this one does again after others were done.
  void run_process_from(const Given& first) {
    BlenderJob job = empty_job(shared_.threads, options_);
    job.scenes.push_back(first.input);
    job.go_on = true;
    write_file(directory_.path() / kJobFile, records::record_line(job));

    const std::string program = shared_.status.program.string();
    // The temporary directory is of no use to a reader, and would make every record differ.
    command_ = shell_join(blender_arguments(program, ""));
    begin_log();
    clock_.restart();
    begun_ = false;
    started_ = Clock::now();
    cpu_told_ = 0;
    Line line;
    line_ = &line;
    ProcessOptions process;
    process.working_directory = process.writable = process.progress_directory = directory_.path();
    process.on_start = [&](const ProcessLimits& limits) { limits_ = limits; };
    process.environment = engine_environment(directory_.path());
    // It is given no scene after one time limit, and each scene has an alarm of its own; this is for
    // a Blender that never comes to that.
    process.timeout = 2 * options_.time_limit;
    process.no_progress_limit = options_.no_progress_limit;
    process.stop = &shared_.stop;
    process.input = line.theirs();
    process.on_line = [&](std::string_view text) { take_line(text); };
    ProcessResult ended;
    Failure failure = run_engine(kBlenderInfo, blender_arguments(program, directory_.path()),
                                 process, options_, ended);
    line_ = nullptr;
    report_done();
    if (begun_) shared_.idle_starts = 0;
    if (!given_) return;
    if (ended.exit_code == 128 + kSigAlrm) {
      ended.timed_out = true;
      failure = process_failure(kBlenderInfo, ended, options_);
    }
    if (!failure)
      failure = {
          FailureClass::kNoOutput,
          fmt::format("Blender {}: {}",
                      current_ ? "stopped with exit code 0 in the middle" : "rendered nothing",
                      last_words(ended.output_tail))};
    if (current_) {  // died with a scene in its hands: that scene's result, and no one else's
      current_ = false;
      fail_given(failure);
    } else if (begun_) {  // died between two
      shared_.put_back(given_->index);
      given_.reset();
    } else {
      fail_given(failure);
      if (++shared_.idle_starts < kMostIdleStarts) return;
      while ((given_ = next())) fail_given(failure);
    }
  }

  /// What it throws (a full disk, say) ends Blender and comes out of run_process.
  void take_line(std::string_view line) {
    log_.add(line);
    clock_.take(line);
    if (line.starts_with("lobelia: ")) take_message(split(line, " "));
  }

  /// "lobelia: begin NAME", "lobelia: done NAME SECONDS CPU_SECONDS PEAK_BYTES", "lobelia: failed NAME WHY" or
  /// "lobelia: more". Between done and more nothing is read, so that Blender need not wait.
  void take_message(const std::vector<std::string>& words) {
    if (words.size() == 2 && words[1] == "more") {
      go_on();
      report_done();
      return;
    }
    if (words.size() < 3 || !given_ || words[2] != name_of(given_->index)) return;
    if (words[1] == "begin") {
      report_done();
      begun_ = current_ = true;
    } else if (words[1] == "failed") {
      std::string why;
      for (std::size_t i = 3; i < words.size(); ++i) why += " " + words[i];
      current_ = false;
      fail_given({FailureClass::kExitCode, "Blender Cycles:" + printable(why, 300)});
    } else if (words[1] == "done") {
      begun_ = true;
      done_.emplace();
      if (words.size() > 3) parse_number(words[3], done_->seconds);
      long long peak = 0;
      double cpu = 0;
      if (words.size() > 5 && parse_number(words[4], cpu) && parse_integer(words[5], peak)) {
        done_->cpu_seconds = cpu - cpu_told_;
        done_->peak_memory_bytes = std::uint64_t(std::max(0LL, peak));
        done_->cost_told = true;
        cpu_told_ = cpu;
      }
      done_->given = std::move(*given_);
      given_.reset();
      done_->log = std::exchange(log_, {});
      done_->clock = clock_;
      current_ = false;
      begin_log();
      clock_.restart();
    }
  }

  void go_on() {
    if (given_) return;
    if (Clock::now() - started_ < options_.time_limit) given_ = next();
    if (!given_) {
      line_->end();
      return;
    }
    write_file(directory_.path() / kNextFile, records::record_line(given_->input));
    line_->say(std::string(kNextFile) + "\n");
  }

  /// Reads the picture that is ready, if one is.
  void report_done() {
    if (!done_) return;
    const Done done = std::move(*done_);
    done_.reset();
    const std::size_t index = done.given.index, passes = done.given.input.passes.size();
    const Scene& scene = shared_.scenes[index];
    ReferenceResult result;
    if (const Failure failure =
            read_passes(directory_.path(), name_of(index), scene, passes, result.image)) {
      shared_.tell(index, done.log, failed(index, failure));
      return;
    }
    result.record = reference_record(kBlenderInfo, shared_.status, scene);
    result.record.witness = shared_.native() ? "native" : "expressed";
    result.record.method =
        shared_.native()
            ? "Cycles' Ashikhmin-Shirley closure, its geometry term taken out by its colour, under a "
              "real lamp, one pass per light and reflection"
            : "shader nodes as the colour of a surface under a real lamp, one pass per light and "
              "reflection";
    result.record.passes = passes;
    result.record.engine_commands = {command_};
    record_limits(result.record, limits_);
    result.record.seconds.total = done.seconds;
    if (done.cost_told)
      record_cost(result.record, done.cpu_seconds, done.peak_memory_bytes, shared_.threads);
    if (options_.stages) done.clock.report(result.record.seconds);
    shared_.tell(index, done.log, std::move(result));
  }

  void fail_given(const Failure& failure) {
    const std::size_t index = given_->index;
    given_.reset();
    shared_.tell(index, log_, failed(index, failure));
    begin_log();
  }

  ReferenceResult failed(std::size_t index, const Failure& failure) const {
    return failed_result(kBlenderInfo, shared_.status, shared_.scenes[index], failure);
  }

  void begin_log() {
    log_ = {};
    log_.add("$ " + command_);
  }

  Shared& shared_;
  const ReferenceOptions& options_;
  const TemporaryDirectory directory_;
  std::optional<Given> given_;  ///< to the process, and not done
  bool current_ = false;        ///< it has begun that one
  std::optional<Done> done_;    ///< not yet read
  // Of the process at work:
  bool begun_ = false;  ///< any scene
  Clock::time_point started_;
  double cpu_told_ = 0;
  Line* line_ = nullptr;
  std::string command_;
  ProcessLimits limits_;
  // Since its last scene:
  StageClock clock_;
  EngineLog log_;
};

class Blender final : public Engine {
 public:
  explicit Blender(fs::path program) : wanted_program_(std::move(program)) {}

  const EngineInfo& info() const override { return kBlenderInfo; }

  const EngineStatus& status() override {
    if (!probed_) {
      status_ = probe_engine(kBlenderInfo, kProbe, wanted_program_);
      probed_ = true;
    }
    return status_;
  }

 protected:
  std::string why_not_simple(const Scene& scene, const ReferenceOptions& options) const override {
    if (options.witness == Witness::kNative && !is_native_in_blender(scene))
      return "Cycles has highlights of its own only with the distribution of Ashikhmin and Shirley: cos^n "
             "of the half-vector angle, here on spheres";
    if (const std::string lamp = lamp_below_horizon(scene); !lamp.empty())
      return lamp + ", and in Cycles a rounding decides whether the sphere hides it";
    return why_not_for_programs(scene);
  }
  void render_simple(std::span<const Scene> scenes, const ReferenceOptions& options,
                     const OnResult& on_result) override {
    const int processors = threads_of(options);
    // Preparing a scene keeps Blender on one processor for most of a small picture's time.
    const int wanted = options.processes > 0 ? options.processes : processors;
    const int processes = int(std::min(std::size_t(wanted), scenes.size()));
    if (processes == 0) return;
    Shared shared{scenes, options, status_, on_result, std::max(1, processors / processes)};
    for (std::size_t i = 0; i < scenes.size(); ++i) shared.waiting.push_back(i);
    run_workers(processes, shared.stop, [&] { BlenderWorker(shared).run(); });
  }

 private:
  fs::path wanted_program_;
  EngineStatus status_;
  bool probed_ = false;
};

}  // namespace

std::unique_ptr<Engine> make_blender(const fs::path& program) {
  return std::make_unique<Blender>(program);
}

void keep_blender_input(const Scene& scene, const ReferenceOptions& options,
                        const fs::path& directory) {
  BlenderJob job = empty_job(threads_of({}), {});
  job.scenes.push_back(
      blender_input(in_engine_units(scene), "scene0", options.witness == Witness::kNative));
  write_file(directory / kScriptFile, embedded::render_scenes_py);
  write_file(directory / kJobFile, records::record_text(job));
  write_file(directory / "blender.sh", shell_join(blender_arguments("blender", "")) + "\n");
}

}  // namespace lobelia

#include "reference_scenes/blender/blender.hpp"

#include <fmt/format.h>

#include <deque>
#include <exception>
#include <map>
#include <optional>
#include <thread>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/interrupt.hpp"
#include "core/text.hpp"
#include "reference_scenes/blender/blender_input.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view render_scenes_py;
}
namespace {
namespace fs = std::filesystem;

constexpr char kScriptFile[] = "render_scenes.py";
constexpr char kJobFile[] = "job.json";
constexpr int kSigAlrm = 14;

/// The node groups' and point primitives' interface that render_scenes.py uses.
constexpr EngineProbe kProbe{"blender", "Blender ", [](int major, int minor) {
                               return major == 4 || (major == 3 && minor >= 4);
                             }};

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

Json job_json(const ReferenceOptions& options) {
  const int processors = options.threads > 0
                             ? options.threads
                             : int(std::max(1u, std::thread::hardware_concurrency()));
  const double limit = options.time_limit.count();
  return {{"threads", processors},
          {"secondsPerScene", limit},
          {"secondsPerProcess", limit},
          {"scenes", Json::array()}};
}

Image read_passes(const fs::path& directory, const std::string& name, const Scene& scene,
                  std::size_t passes) {
  std::vector<Image> images;
  for (std::size_t pass = 0; pass < passes; ++pass) {
    const fs::path file = directory / fmt::format("{}-{}.exr", name, pass);
    images.push_back(read_image(file));
    if (images.back().width() != scene.film.width || images.back().height() != scene.film.height)
      throw Error(ExitCode::kEngine, "another size than was asked for");
    fs::remove(file);
  }
  return sum_of(images);
}

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
  void report(Json& seconds) const {
    seconds["start"] = start_;
    seconds["parse"] = parse_;
    seconds["trace"] = trace_;
    seconds["write"] = write_;
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

/// One call of render(): scenes that wait, and the processes that take them.
class BlenderRun {
 public:
  BlenderRun(std::span<const Scene> scenes, const ReferenceOptions& options,
             const EngineStatus& status,
             const std::function<void(std::size_t, ReferenceResult)>& on_result)
      : scenes_(scenes), options_(options), status_(status), on_result_(on_result) {}

  void run() {
    write_file(directory_.path() / kScriptFile, embedded::render_scenes_py);
    for (std::size_t i = 0; i < scenes_.size(); ++i) accept(i);
    while (!waiting_.empty()) run_process_on_waiting();
  }

 private:
  bool native() const { return options_.witness == Witness::kNative; }
  std::string name_of(std::size_t index) const { return fmt::format("scene{}", index); }

  /// Puts the scene in line, or says at once why not.
  void accept(std::size_t index) {
    try {
      inputs_[index] = blender_input(in_engine_units(scenes_[index]), name_of(index), native());
      waiting_.push_back(index);
    } catch (const Error& refused) {
      on_result_(index,
                 {{}, {}, refused.what(), reference_record(kBlenderInfo, status_, scenes_[index])});
    }
  }

  /// Starts Blender once for all that wait. Whatever happens, fewer wait afterwards.
  void run_process_on_waiting() {
    Json job = job_json(options_);
    for (const std::size_t index : waiting_) job["scenes"].push_back(inputs_[index]);
    write_file(directory_.path() / kJobFile, job.dump());

    const auto arguments = blender_arguments(status_.program.string(), directory_.path());
    // The temporary directory is of no use to a reader, and would make every record differ.
    command_ = shell_join(blender_arguments(status_.program.string(), ""));
    log_ = "$ " + command_ + "\n";
    current_.reset();
    clock_.restart();
    const std::size_t waited = waiting_.size();
    ProcessOptions process;
    process.working_directory = directory_.path();
    process.writable = directory_.path();
    process.on_start = [&](bool writes_limited) { writes_limited_ = writes_limited; };
    process.environment = private_home(directory_.path());
    // The user's own configuration could give the scene's numbers other primaries.
    process.environment.emplace_back("OCIO=");
    // It starts no scene after one time limit, and each scene has an alarm of its own; this is for
    // a Blender that never comes to that.
    process.timeout = 2 * options_.time_limit;
    process.on_line = [&](std::string_view line) { take_line(line); };
    ProcessResult ended = run_process(arguments, process);
    if (ended.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");

    if (current_) {  // died with a scene in its hands: that scene's result, and no one else's
      if (ended.exit_code == 128 + kSigAlrm) ended.timed_out = true;
      fail(*current_, describe_failure(kBlenderInfo, ended, options_.time_limit.count()));
    } else if (waiting_.size() == waited) {  // came to no scene at all, and will not next time
      std::string why = describe_failure(kBlenderInfo, ended, options_.time_limit.count());
      if (ended.exit_code == 0)
        why = fmt::format("Blender rendered nothing: {}", last_words(ended.output_tail));
      while (!waiting_.empty()) fail(waiting_.front(), why);
    }
  }

  /// What it throws (a full disk, say) ends Blender and comes out of run_process.
  void take_line(std::string_view line) {
    log_.append(line).append("\n");
    clock_.take(line);
    if (line.starts_with("lobelia: ")) take_message(split(line, " "));
  }

  /// "lobelia: begin NAME", "lobelia: done NAME SECONDS" or "lobelia: failed NAME WHY".
  void take_message(const std::vector<std::string>& words) {
    if (words.size() < 3) return;
    const auto scene = std::ranges::find_if(
        waiting_, [&](std::size_t index) { return name_of(index) == words[2]; });
    if (scene == waiting_.end()) return;
    if (words[1] == "begin") {
      current_ = *scene;
    } else if (words[1] == "failed") {
      std::string why;
      for (std::size_t i = 3; i < words.size(); ++i) why += " " + words[i];
      fail(*scene, "Blender Cycles:" + printable(why, 300));
    } else if (words[1] == "done") {
      double seconds = 0;
      if (words.size() > 3) parse_number(words[3], seconds);
      succeed(*scene, seconds);
    }
  }

  void succeed(std::size_t index, double seconds) {
    ReferenceResult result;
    const std::size_t passes = inputs_[index]["passes"].size();
    try {
      result.image = read_passes(directory_.path(), name_of(index), scenes_[index], passes);
    } catch (const std::exception& error) {
      fail(index, fmt::format("Blender's picture cannot be used: {}", error.what()));
      return;
    }
    result.record = reference_record(kBlenderInfo, status_, scenes_[index]);
    result.record["witness"] = native() ? "native" : "expressed";
    result.record["method"] =
        native()
            ? "Cycles' Ashikhmin-Shirley closure, its geometry term taken out by its colour, under a "
              "real lamp, one pass per light and reflection"
            : "shader nodes as the colour of a surface under a real lamp, one pass per light and "
              "reflection";
    result.record["passes"] = passes;
    result.record["engineCommands"] = Json::array({command_});
    result.record["writesLimited"] = writes_limited_;
    result.record["seconds"] = {{"total", seconds}};
    if (options_.stages) clock_.report(result.record["seconds"]);
    clock_.restart();
    finish(index, std::move(result));
  }

  void fail(std::size_t index, const std::string& why) {
    finish(index, {{}, {}, why, reference_record(kBlenderInfo, status_, scenes_[index])});
  }

  void finish(std::size_t index, ReferenceResult result) {
    std::erase(waiting_, index);
    current_.reset();
    write_engine_log(options_, kBlenderInfo, index, log_);
    log_ = "$ " + command_ + "\n";
    on_result_(index, std::move(result));
  }

  std::span<const Scene> scenes_;
  const ReferenceOptions& options_;
  const EngineStatus& status_;
  const std::function<void(std::size_t, ReferenceResult)>& on_result_;
  const TemporaryDirectory directory_;
  std::map<std::size_t, Json> inputs_;
  std::deque<std::size_t> waiting_;
  std::optional<std::size_t> current_;  ///< begun and not done
  StageClock clock_;                    ///< since the last scene
  std::string command_, log_;           ///< of the process at work, since the last scene
  bool writes_limited_ = false;         ///< likewise
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
    return why_not_for_programs(scene);
  }
  void render_simple(std::span<const Scene> scenes, const ReferenceOptions& options,
                     const OnResult& on_result) override {
    BlenderRun(scenes, options, status_, on_result).run();
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
  Json job = job_json({});
  job["scenes"].push_back(
      blender_input(in_engine_units(scene), "scene0", options.witness == Witness::kNative));
  write_file(directory / kScriptFile, embedded::render_scenes_py);
  write_file(directory / kJobFile, job.dump(2) + "\n");
  write_file(directory / "blender.sh", shell_join(blender_arguments("blender", "")) + "\n");
}

}  // namespace lobelia

#include "reference_scenes/engines/outside/outside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>

#include "base/pictures/picture_file.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/process.hpp"
#include "base/system/removal.hpp"
#include "base/words/text.hpp"
#include "reference_scenes/content.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/engines/outside/outside_reader.hpp"
#include "reference_scenes/formats/catalogue.hpp"
#include "renderer/plan/plan.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

constexpr char kPicture[] = "out.exr";

/// Full path of an argument that is the path of a file beside the description; otherwise the argument.
std::string with_full_path(const std::string& argument, const fs::path& directory) {
  const fs::path file = directory / argument;
  std::error_code unknown;
  return !argument.empty() && fs::is_regular_file(file, unknown) ? file.string() : argument;
}

std::vector<std::string> with_full_paths(std::vector<std::string> arguments,
                                         const fs::path& directory) {
  for (std::string& argument : arguments) argument = with_full_path(argument, directory);
  if (!arguments.empty())
    if (const fs::path program = find_program(arguments.front()); !program.empty())
      arguments.front() = program.string();
  return arguments;
}

/// The first line of the version command's output, escaped.
std::string version_in(const std::string& output) {
  constexpr std::size_t kMost = 120;
  const std::vector<std::string> lines = split(output, "\n");
  return lines.empty() ? "" : printable(lines.front(), kMost);
}

class Outside final : public Engine {
 public:
  Outside(const OutsideEngine& engine, const Leave& leave);
  const EngineInfo& info() const override { return info_; }
  const EngineStatus& status() override;
  const OutsideEngine* outside() const override { return &engine_; }
  std::string key_part(const Film& film, const AxisValues& axes,
                       std::chrono::duration<double> time_limit) const override;

  bool has_program() const { return !engine_.command.empty(); }
  /// Throws Error(kInput) if it is no picture that the film justifies, and what key_part() met with it.
  InputFile open_picture(const Film& film, const AxisValues& axes) const;
  std::vector<std::string> command(const AxisValues& axes, const Film& film, int threads,
                                   const std::string& scene, const std::string& picture) const;
  std::vector<std::string> environment(const fs::path& directory) const;

 protected:
  std::string why_not_whole(const Scene& scene, const AxisValues& axes) const override;
  std::string why_not_simple(const Scene&, const ReferenceOptions&) const override { return ""; }
  std::unique_ptr<SimpleSession> open_simple(const ReferenceOptions& options) override;

 private:
  std::string why_not_ready(EngineStatus& status) const;
  /// From `directory`.
  fs::path picture_of(const AxisValues& axes) const;
  std::string key_of_picture(const Film& film, const AxisValues& axes,
                             std::chrono::duration<double> time_limit) const;

  const OutsideEngine engine_;
  const Leave leave_;
  const std::vector<std::string> command_, version_command_;  ///< with full paths
  std::string effects_;
  EngineInfo info_;
  std::optional<EngineStatus> status_;
  /// A picture's part of the keys: its hash, or why it has none. Each picture is hashed once for all cells. Without a
  /// hash it is not read later either: the keys would not tell its contents apart.
  struct PictureKey {
    std::string sha256, why_not;
  };
  mutable std::map<std::string, PictureKey> keys_;
  mutable std::mutex mutex_;
};

/// A picture for films of a size.
std::string name_of(const fs::path& picture, const Film& film) {
  return fmt::format("{} x {}: {}", film.width, film.height, picture.string());
}

/// Writes the scene in the form that the engine takes. Returns the name of its main file.
std::string write_scene(const OutsideEngine& engine, const Scene& scene,
                        const fs::path& directory) {
  const SceneFormat& format = scene_format(engine.scene);
  for (const auto& [name, text] : format.write(scene)) write_file(directory / name, text);
  return std::string(format.file);
}

class OutsideSession final : public SimpleSession {
 public:
  OutsideSession(const Outside& engine, const EngineStatus& status, const ReferenceOptions& options)
      : engine_(engine), status_(status), options_(options), processors_(threads_of(options)) {}

  ReferenceResult render(const Scene& scene, std::size_t scenes) override {
    return render_cell(scene, {}, scenes);
  }
  ReferenceResult render_cell(const Scene& scene, const AxisValues& axes,
                              std::size_t scenes) override {
    return engine_.has_program() ? run(scene, axes, scenes) : read(scene, axes);
  }
  int at_once(std::size_t scenes) const override {
    const int most = options_.processes > 0 ? options_.processes : processors_;
    return int(std::clamp(scenes, std::size_t{1}, std::size_t(most)));
  }
  void stop() override { stop_ = true; }

 private:
  ReferenceResult run(const Scene& scene, const AxisValues& axes, std::size_t scenes);
  ReferenceResult read(const Scene& scene, const AxisValues& axes) const;
  ReferenceResult finished(const Scene& scene, const Failure& failure) const;

  const Outside& engine_;
  const EngineStatus& status_;
  const ReferenceOptions options_;
  const int processors_;
  const TemporaryDirectory directory_;
  std::atomic<std::size_t> begun_ = 0;
  std::atomic<bool> stop_ = false;
};

Outside::Outside(const OutsideEngine& engine, const Leave& leave)
    : engine_(engine),
      leave_(leave.said_by(engine.directory)),
      command_(with_full_paths(engine.command, engine.directory)),
      version_command_(with_full_paths(engine.version_command, engine.directory)),
      effects_(engine.effects ? fmt::format("{}", fmt::join(*engine.effects, ", "))
                              : "all, as far as is known") {
  info_.name = engine_.name;
  info_.title = engine_.title;
  info_.install_hint = "it is not one of Lobelia's engines: see the grid that describes it";
  info_.supported_versions = "any";
  info_.shading = "its own";
  info_.precision = "of its pictures";
  info_.effects = effects_;
  info_.plain = "float";
  info_.is_program = has_program();
  info_.whole_scenes = true;
  info_.floor = {.of_value = engine_.of_value, .of_peak = engine_.of_peak};
  info_.seconds = {1, 1e-5};
}

const EngineStatus& Outside::status() {
  if (status_) return *status_;
  status_.emplace();
  if (!has_program()) {
    status_->state = EngineState::kReady;
    status_->version = "pictures";
    return *status_;
  }
  if (!leave_) {
    status_->state = EngineState::kBroken;
    status_->why = "nobody gave leave to start it (--allow-commands)";
    return *status_;
  }
  status_->program = find_program(command_.front());
  if (status_->program.empty()) {
    status_->why = fmt::format("no program '{}'", printable(command_.front(), 400));
    return *status_;
  }
  status_->why = why_not_ready(*status_);
  status_->state = status_->why.empty() ? EngineState::kReady : EngineState::kBroken;
  return *status_;
}

std::string Outside::why_not_ready(EngineStatus& status) const {
  for (const std::string& argument : command_)
    if (std::error_code unknown; fs::is_regular_file(argument, unknown))
      status.files.programs.emplace_back(argument);
  if (version_command_.empty()) {
    status.version = "unknown";
    return "";
  }
  constexpr double kMostSeconds = 60;
  const TemporaryDirectory home;
  const LoaderTrace trace(home.path());
  ProcessOptions process;
  process.timeout = std::chrono::duration<double>(kMostSeconds);
  process.environment = environment(home.path());
  process.only_environment = true;
  process.working_directory = process.writable = home.path();
  std::ranges::copy(trace.environment(), std::back_inserter(process.environment));
  const std::string command = shell_join(version_command_);
  ProcessResult result;
  try {
    result = run_process(version_command_, process);
  } catch (const Error& error) {
    return error.what();
  }
  if (result.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  if (result.timed_out)
    return fmt::format("{} did not end within {} s", printable(command, 400), kMostSeconds);
  if (result.exit_code != 0)
    return fmt::format("{} ended with exit code {}: {}", printable(command, 400), result.exit_code,
                       last_words(result.output_tail));
  status.version = version_in(result.output_tail);
  if (status.version.empty()) return fmt::format("{} prints nothing", printable(command, 400));
  const EngineFiles loaded = trace.files();
  std::ranges::copy(loaded.programs, std::back_inserter(status.files.programs));
  status.files.libraries = loaded.libraries;
  return "";
}

fs::path Outside::picture_of(const AxisValues& axes) const {
  return filled_in(engine_.files, [&](std::string_view name) {
    const std::string* value = records::find(axes, name);
    return value ? *value : std::string();
  });
}

InputFile Outside::open_picture(const Film& film, const AxisValues& axes) const {
  const fs::path name = picture_of(axes);
  {
    const std::scoped_lock lock(mutex_);
    const auto found = keys_.find(name_of(name, film));
    if (found != keys_.end() && !found->second.why_not.empty())
      throw Error(ExitCode::kInput, found->second.why_not);
  }
  auto file = open_named(name, engine_.directory, leave_, fmt::format("engine {}", engine_.name));
  PictureFile::require_picture(file);
  if (const std::uint64_t most = most_picture_bytes(film); file.size() > most)
    throw Error(ExitCode::kInput,
                "{}: the file has {} bytes; a picture of {} x {} pixels may have {}",
                file.path().string(), file.size(), film.width, film.height, most);
  return file;
}

std::vector<std::string> Outside::command(const AxisValues& axes, const Film& film, int threads,
                                          const std::string& scene,
                                          const std::string& picture) const {
  std::vector<std::string> arguments;
  for (const std::string& argument : command_)
    arguments.push_back(filled_in(argument, [&](std::string_view name) {
      if (name == "scene") return scene;
      if (name == "out") return picture;
      if (name == "width") return fmt::format("{}", film.width);
      if (name == "height") return fmt::format("{}", film.height);
      if (name == "threads") return fmt::format("{}", threads);
      const std::string* value = records::find(axes, name);
      if (!value) return std::string();
      require_no_option(*value, name);
      return *value;
    }));
  return arguments;
}

std::vector<std::string> Outside::environment(const fs::path& directory) const {
  std::vector<std::string> all = engine_environment(directory);
  for (const std::string& name : engine_.environment)
    if (const char* value = std::getenv(name.c_str()))
      all.push_back(fmt::format("{}={}", name, value));
  return all;
}

std::string Outside::key_of_picture(const Film& film, const AxisValues& axes,
                                    std::chrono::duration<double> time_limit) const {
  const std::string name = name_of(picture_of(axes), film);
  const auto text_of = [](const PictureKey& key) {
    return key.why_not.empty() ? key.sha256 : "unreadable";
  };
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = keys_.find(name); found != keys_.end()) return text_of(found->second);
  }
  PictureKey key;
  try {
    key.sha256 = FileHashes::of_user().hash(open_picture(film, axes), time_limit).sha256;
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput || error.is_fault()) throw;
    key.why_not = error.what();
  }
  const std::scoped_lock lock(mutex_);
  return text_of(keys_.emplace(name, std::move(key)).first->second);
}

/// The picture's content, or the command and what it gets from the environment.
std::string Outside::key_part(const Film& film, const AxisValues& axes,
                              std::chrono::duration<double> time_limit) const {
  if (!has_program()) return key_of_picture(film, axes, time_limit);
  std::string part = engine_.scene;
  for (const std::string& argument : command(axes, {}, 0, "{scene}", "{out}"))
    part += fmt::format("\n{}", argument);
  for (const std::string& name : engine_.environment)
    if (const char* value = std::getenv(name.c_str())) part += fmt::format("\n{}={}", name, value);
  return part;
}

std::string Outside::why_not_whole(const Scene& scene, const AxisValues& axes) const {
  if (!has_program()) {
    const fs::path file = picture_of(axes);
    std::error_code unknown;
    return fs::is_regular_file(engine_.directory / file, unknown)
               ? ""
               : fmt::format("{}{}", kMissingPicture, printable_path(file.string()));
  }
  const SceneFormat& format = scene_format(engine_.scene);
  if (std::string why = format.why_not(scene); !why.empty())
    return fmt::format("{} gets scenes for {}: {}", engine_.title, format.title, why);
  if (!engine_.effects) return "";
  for (const EffectDecision& effect : make_plan(scene, EffectPolicy::kAsCalledFor).effects)
    if (effect.on && std::ranges::find(*engine_.effects, effect.name) == engine_.effects->end())
      return fmt::format("the scene calls for {}, which {} is not said to show", effect.name,
                         engine_.title);
  return "";
}

std::unique_ptr<SimpleSession> Outside::open_simple(const ReferenceOptions& options) {
  return std::make_unique<OutsideSession>(*this, status(), options);
}

ReferenceResult OutsideSession::finished(const Scene& scene, const Failure& failure) const {
  ReferenceResult result = failed_result(engine_.info(), status_, scene, failure);
  result.record.shading = "outside";
  result.record.passes = 1;
  return result;
}

ReferenceResult OutsideSession::read(const Scene& scene, const AxisValues& axes) const {
  Image image;
  ReferenceResult result =
      finished(scene, read_engine_picture(
                          engine_.info(),
                          [&] { return PictureFile(engine_.open_picture(scene.film, axes)); },
                          scene.film, image));
  result.image = std::move(image);
  result.record.method = "a picture that was there";
  return result;
}

ReferenceResult OutsideSession::run(const Scene& scene, const AxisValues& axes,
                                    std::size_t scenes) {
  if (stop_) throw Error(ExitCode::kInterrupted, "interrupted");
  throw_if_interrupted();
  const auto begun = std::chrono::steady_clock::now();
  const fs::path home = directory_.path() / fmt::format("scene{}", begun_++);
  make_directories(home);
  const std::string main_file = write_scene(*engine_.outside(), scene, home);
  const int threads = std::max(1, processors_ / at_once(scenes));
  const std::vector<std::string> arguments = engine_.command(
      axes, scene.film, threads, (home / main_file).string(), (home / kPicture).string());
  EngineLog log;
  log.add("$ " + shell_join(arguments));
  ProcessLimits limits;
  ProcessOptions process;
  process.environment = engine_.environment(home);
  process.timeout = options_.time_limit;
  process.stop = &stop_;
  process.on_line = [&](std::string_view line) { log.add(line); };
  process.on_start = [&](const ProcessLimits& these) { limits = these; };
  ProcessResult ended;
  Failure failure = run_engine(engine_.info(), arguments, home, process, options_, ended);
  Image image;
  if (!failure) failure = read_engine_picture(engine_.info(), home / kPicture, scene.film, image);
  if (const std::string words = last_words(ended.output_tail);
      failure.kind == FailureClass::kNoOutput && !words.empty())
    failure.message += ": " + words;
  remove_in_temporary_directory(home);
  ReferenceResult result = finished(scene, failure);
  result.begun = begun;
  result.image = std::move(image);
  result.log = log.text();
  result.record.method = "its own, of the whole scene";
  result.record.engine_commands = {
      shell_join(engine_.command(axes, scene.film, threads, main_file, kPicture))};
  record_limits(result.record, limits);
  result.record.seconds.total = ended.seconds;
  record_cost(result.record, {ended.seconds, ended.cpu_seconds, ended.peak_memory_bytes}, threads);
  return result;
}

}  // namespace

std::unique_ptr<Engine> make_outside_engine(const OutsideEngine& engine, const Leave& leave) {
  return std::make_unique<Outside>(engine, leave);
}

void keep_outside_input(const OutsideEngine& engine, const Scene& scene, const AxisValues& axes,
                        const fs::path& directory) {
  const Outside outside(engine, {});
  if (!outside.has_program()) return;
  const std::string main_file = write_scene(engine, scene, directory);
  write_file(directory / "again.sh",
             shell_join(outside.command(axes, scene.film, 1, main_file, kPicture)) + "\n");
}

std::vector<std::string> starts_of(const OutsideEngine& engine) {
  std::vector<std::string> starts;
  for (const auto* command : {&engine.version_command, &engine.command})
    if (!command->empty())
      starts.push_back(fmt::format("start '{}' by engine {}", printable(shell_join(*command), 1000),
                                   engine.name));
  return starts;
}

void require_leave_to_start(std::span<const OutsideEngine> engines, const Leave& leave) {
  std::vector<std::string> wishes;
  for (const OutsideEngine& engine : engines)
    if (!leave.said_by(engine.directory))
      std::ranges::move(starts_of(engine), std::back_inserter(wishes));
  if (!wishes.empty()) refuse_without_leave(wishes);
}

}  // namespace lobelia

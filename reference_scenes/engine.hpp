// The engines that we did not write: what they are, whether they are here, and how to ask them for
// the same picture.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.hpp"
#include "records/render.hpp"
#include "reference_scenes/failure.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

struct EngineInfo {
  std::string_view name;                ///< "povray", as on the command line and in file names
  std::string_view title;               ///< "POV-Ray"
  std::string_view install_hint;        ///< "sudo apt-get install povray"
  std::string_view supported_versions;  ///< "3.7 or 3.8"
  std::string_view witness;    ///< which models it shades itself, and which are expressed in it
  std::string_view precision;  ///< of its pictures
  std::string_view effects;    ///< that scenes for it may have
  std::string_view plain,
      fine = {};           ///< names of its number formats; `fine` empty: it has one only
  bool is_program = true;  ///< to be looked for
};

/// Whose shading of a highlight it is: the engine's own, or our formula in the engine's language.
enum class Witness { kAny, kNative, kExpressed };
inline constexpr std::string_view kWitnessNames[] = {"any", "native", "expressed"};

/// Whether an engine can be asked for pictures. That it cannot show one scene is no matter of this: why_not().
enum class EngineState {
  kAbsent,  ///< not installed: there is no such program
  kBroken,  ///< there is one that cannot be started, does not end, or tells no version that can be driven
  kReady,
};

constexpr std::string_view state_name(EngineState state) {
  return records::kEngineStates[std::size_t(state)];
}

/// What an engine consists of, as far as asking its version showed: its content (engine_content.hpp) is theirs.
struct EngineFiles {
  std::vector<std::filesystem::path>
      programs;  ///< that ran; a wrapper is one script and several programs
  std::vector<std::filesystem::path> libraries;  ///< that these loaded
  std::vector<std::filesystem::path>
      directories;  ///< of scripts and data that it reads when it renders
};

struct EngineStatus {
  EngineState state = EngineState::kAbsent;
  std::filesystem::path program;
  std::string version;  ///< "3.7.0.10"
  std::string why;      ///< where not ready: one sentence
  EngineFiles files = {};
  bool available() const { return state == EngineState::kReady; }
};

struct ReferenceOptions {
  int threads = 0;    ///< 0: all processors
  int processes = 0;  ///< of an engine that is a program, at most at once; 0: as suits it
  std::chrono::duration<double> time_limit = std::chrono::minutes(10);  ///< for each picture
  /// Longest time in which a program neither says nor writes anything; 0: none.
  std::chrono::duration<double> no_progress_limit{0};
  std::uint64_t memory_limit =
      0;  ///< bytes that the processes of a picture may have together; 0: any number
  std::uint64_t disk_limit = 0;         ///< likewise on the disk
  std::filesystem::path log_directory;  ///< receives the engine's own output; empty: dropped
  /// Points of every light with a size, of the lens and of the pixel, where a scene has such; a multiple
  /// of kReplicates.
  int points = 256;
  std::uint64_t seed = 0;  ///< of those points
  bool fine = false;       ///< in the finer of the engine's number formats, if it has two
  Witness witness = Witness::kAny;
  /// Also tells in the record's `seconds` what went to `start`, `parse`, `trace` and `write`, as far as the
  /// engine tells them apart; added up over its processes and passes.
  bool stages = false;
  /// If set, asked once of every scene given to render(), just before work on it begins: false leaves it
  /// out, and there is no result. From any thread, never two at once; scenes that are refused are not
  /// asked for.
  std::function<bool(std::size_t)> begin;
};

/// Independent estimates, whose scatter tells the error of their mean.
inline constexpr int kReplicates = 16;

/// One picture, or why there is none. `image` has the gain and every other trick taken out again.
struct ReferenceResult {
  Image image;
  Image standard_error;  ///< of the image where it is an average (replicates.hpp); otherwise empty
  std::string error;     ///< empty on success
  FailureClass failure = FailureClass::kNone;  ///< kNone on success
  records::Reference record;  ///< without the command and the name of the picture's file
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual const EngineInfo& info() const = 0;
  /// Looks for the program and asks its version; slow the first time, remembered afterwards.
  virtual const EngineStatus& status() = 0;
  /// Why this engine cannot show a scene, as a sentence; empty if it can.
  std::string why_not(const Scene& scene, const ReferenceOptions& options) const;

  using OnResult = std::function<void(std::size_t, ReferenceResult)>;
  /// Renders every scene, in any order; calls `on_result(index, result)` for each, never two at once. A
  /// picture with values that are not finite is a failure.
  /// A scene that needs_replicates() is the average of many. One scene's failure is its result and
  /// nothing else's. Throws Error(kEngine) if the engine is not available and Error(kInterrupted)
  /// on Ctrl-C.
  void render(std::span<const Scene> scenes, const ReferenceOptions& options,
              const OnResult& on_result);

 protected:
  /// The same of scenes of which a single ray through each pixel's centre tells all, under lamps without
  /// a size.
  virtual std::string why_not_simple(const Scene& scene, const ReferenceOptions& options) const = 0;
  /// The same of such scenes, each once, several at a time if the engine likes. Asks options.begin of
  /// each, as often as it likes.
  virtual void render_simple(std::span<const Scene> scenes, const ReferenceOptions& options,
                             const OnResult& on_result) = 0;
};

/// Bytes that the pictures take of which a scene is the average, all at once; 0 of a scene that is one picture.
std::uint64_t memory_to_average(const Scene& scene, const ReferenceOptions& options);

/// The catalogue: the engines' names, and an engine by name (with `program` in place of the one in
/// $PATH, if not empty).
std::span<const EngineInfo> engine_infos();
std::unique_ptr<Engine> make_engine(std::string_view name, const std::filesystem::path& program);

}  // namespace lobelia

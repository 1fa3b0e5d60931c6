// The engines that we did not write: what they are, whether they are here, and how to ask them for
// the same picture.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
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

/// Who shades a highlight: the engine itself, or our formula in the engine's language.
enum class Shading { kAny, kNative, kReimplemented };
inline constexpr std::string_view kShadingNames[] = {"any", "native", "expressed"};

/// How far a picture may be off: by a share of each value, or by a share of the peak.
struct Target {
  bool relative = false;
  double limit = 0;
};
/// Holds up to an exponent.
struct ExponentTarget {
  double up_to;
  Target target;
};

/// A shading in a number format, as `lobelia verify references` measures it.
struct EngineVariant {
  std::string_view name;   ///< "povray_native_half"
  std::string_view title;  ///< "POV-Ray native, half"
  bool fine = false;       ///< in the finer number format
  Shading shading = Shading::kAny;
  /// The first whose exponent is high enough counts.
  std::span<const ExponentTarget> targets = {};
  /// Why it misses a target, as far as that is known.
  std::string_view why_off = {};
  /// The rounding of an average's values, as a share. 0: no averages are measured.
  double rounding = 0;
};

/// A value of its pictures agrees with ours within a share of itself plus a share of the peak.
struct EngineTolerance {
  double of_value = 0, of_peak = 0;
};

/// A rough estimate of how long a picture takes on one core.
struct EngineSeconds {
  double start = 0, per_ray = 0;
};

struct EngineInfo {
  std::string_view name;                ///< "povray", as on the command line and in file names
  std::string_view title;               ///< "POV-Ray"
  std::string_view install_hint;        ///< "sudo apt-get install povray"
  std::string_view supported_versions;  ///< "3.7 or 3.8"
  std::string_view shading;    ///< which models it shades itself, and which are reimplemented in it
  std::string_view precision;  ///< of its pictures
  std::string_view effects;    ///< that scenes for it may have
  std::string_view plain;      ///< name of its number format
  std::string_view fine = {};  ///< name of the finer one; empty if there is none
  bool is_program = true;      ///< false: part of ours
  EngineTolerance tolerance = {};
  EngineSeconds seconds = {};
  std::span<const EngineVariant> variants = {};
  /// The name of its own light transport (see ReferenceOptions::own_transport); empty if it has none.
  std::string_view transport = {};
};

/// Whether an engine can be asked for pictures. That it cannot show one scene is no matter of this: why_not().
enum class EngineState {
  kAbsent,  ///< not installed: there is no such program
  kBroken,  ///< there is one that cannot be started, does not end, or tells no version that can be driven
  kReady,
};

constexpr std::string_view state_name(EngineState state) {
  return records::kEngineStates[std::size_t(state)];
}

/// The files of an engine, as far as asking its version showed them; engine_content.hpp hashes them.
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
  std::uint64_t disk_limit = 0;  ///< likewise on the disk
  /// Points of every light with a size, of the lens and of the pixel, where a scene has such; a multiple
  /// of kReplicates.
  int points = 256;
  std::uint64_t seed = 0;  ///< of those points
  bool fine = false;       ///< in the finer of the engine's number formats, if it has two
  Shading shading = Shading::kAny;
  /// The scene's samples, seed, area lights and inter-reflection by the engine's own light transport, on surfaces
  /// without a highlight, in place of averages of single rays. To measure the engine, not the picture.
  bool own_transport = false;
  /// Also tells in the record's `seconds` what went to `start`, `parse`, `trace` and `write`, as far as the
  /// engine tells them apart; added up over its processes and passes.
  bool stages = false;
  /// How many scenes are to come, as far as that is known: processes and threads are divided among so many.
  std::size_t scenes = 1;
};

/// Independent estimates, whose scatter tells the error of their mean.
inline constexpr int kReplicates = 16;

/// Stands in messages for the temporary directory that an engine works in.
inline constexpr std::string_view kEngineDirectory = "<its directory>";

/// One picture, or why there is none. `image` has the gain and every other trick taken out again.
struct ReferenceResult {
  Image image;
  Image standard_error;  ///< of the image where it is an average (replicates.hpp); otherwise empty
  std::string error;     ///< empty on success
  FailureClass failure = FailureClass::kNone;        ///< kNone on success
  std::string log;                                   ///< the engine's own output
  std::chrono::steady_clock::time_point begun = {};  ///< when work on it began
  records::Reference record;  ///< without the command and the name of the picture's file
};

/// An engine at work on scenes of which a single ray through each pixel's centre tells all, under lamps without a size.
class SimpleSession {
 public:
  virtual ~SimpleSession() = default;
  /// As Session::render(); `scenes` is how many the caller has to render, this one among them.
  virtual ReferenceResult render(const Scene& scene, std::size_t scenes) = 0;
  virtual int at_once(std::size_t scenes) const = 0;
  virtual void stop() = 0;
};

class Engine;

/// An engine at work. Its processes end with it.
class Session {
 public:
  /// Throws Error(kEngine) if the engine is not available.
  Session(Engine& engine, const ReferenceOptions& options);

  /// Blocks until there is the picture, or why there is none; a picture with values that are not finite is a
  /// failure. From any thread. Of a scene that needs_replicates() the parts are rendered at_once(), so one such scene
  /// is enough to keep the machine busy. Throws Error(kInterrupted) on Ctrl-C and after stop().
  ReferenceResult render(const Scene& scene);

  /// How many calls of render() at a time keep the engine busy.
  int at_once() const { return simple_->at_once(options_.scenes); }
  /// Ends what is at work.
  void stop() { simple_->stop(); }

 private:
  ReferenceResult render_part(const Scene& scene, std::size_t scenes);

  Engine& engine_;
  const ReferenceOptions options_;
  std::unique_ptr<SimpleSession> simple_;
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual const EngineInfo& info() const = 0;
  /// Looks for the program and asks its version; slow the first time, remembered afterwards.
  virtual const EngineStatus& status() = 0;
  /// Why this engine cannot show a scene, as a sentence; empty if it can.
  std::string why_not(const Scene& scene, const ReferenceOptions& options) const;

 protected:
  friend class Session;
  virtual std::string why_not_simple(const Scene& scene, const ReferenceOptions& options) const = 0;
  /// The same of a scene for the engine's own light transport.
  virtual std::string why_not_transport(const Scene&) const { return "it has none"; }
  virtual std::unique_ptr<SimpleSession> open_simple(const ReferenceOptions& options) = 0;
};

/// Throws Error(kEngine) with the reason and how to install it, unless the engine is available.
void require_available(const EngineInfo& engine, const EngineStatus& status);

/// Bytes that the pictures take of which a scene is the average, all at once; 0 of a scene that is one picture.
std::uint64_t memory_to_average(const Scene& scene, const ReferenceOptions& options);

/// The catalogue: the engines, and an engine by name (with `program` in place of the one in $PATH, if not empty).
/// Throws Error(kUsage) for a name that there is not.
std::span<const EngineInfo> engine_infos();
const EngineInfo& engine_info(std::string_view name);
std::unique_ptr<Engine> make_engine(std::string_view name, const std::filesystem::path& program);

}  // namespace lobelia

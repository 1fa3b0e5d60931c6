// The reference engines: what they are, whether they are installed, and how to ask them for a picture.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/records/outside_engine.hpp"
#include "base/records/render.hpp"
#include "reference_scenes/failure.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Native: the engine's own shading. Reimplemented: our formula in the engine's language.
enum class Shading { kAny, kNative, kReimplemented };
inline constexpr std::string_view kShadingNames[] = {"any", "native", "expressed"};

/// Half a unit in the last place of a float32 or a half float, as a share of the value.
inline constexpr double kFloat32Rounding = 0x1p-24, kHalfRounding = 0x1p-11;

/// How far an engine's number formats may lead a correct picture from the formulas. Farms and `lobelia verify references`
/// hold its pictures to this.
struct EngineFloor {
  double of_value = 0;  ///< share of the value: the rounding of the picture
  double of_peak = 0;   ///< share of the peak: the rounding of colours
  /// Error of a point's place, as a share of its distance from the camera. On a sphere the normal turns by it over the
  /// radius, and the lobe's angle by twice that; cos^n falls by up to sqrt(n / e) of its peak per radian, and N.L by up
  /// to 1.
  double of_place = 0;
  /// Rounding of the quadratic that finds the point, as a share of the squared distance from the camera. The normal turns by
  /// it times the square of distance over radius: the root halves it, and a slanting ray takes the half away again.
  double of_quadratic = 0;
  double of_cosine =
      0;  ///< error of the lobe's cosine; cos^n falls by up to n of its peak per unit
  double least_cosine = 0;  ///< N.L below which its lights stop

  /// The share of the peak in a picture of the scene, besides of_value.
  double of_peak_in(const Scene& scene) const;
};
/// The error that the renderer's choice of precision allows (docs/numerics.md).
inline constexpr EngineFloor kOursFloor{.of_peak = 1e-5};

/// A shading in a number format; `lobelia verify references` measures each.
struct EngineVariant {
  std::string_view name;   ///< "povray_native_half"
  std::string_view title;  ///< "POV-Ray native, half"
  bool fine = false;       ///< in the finer number format
  Shading shading = Shading::kAny;
  EngineFloor floor = {};
  double rounding = 0;  ///< relative error of an average's values; 0: averages are not measured
};

/// A rough estimate for a picture on one core.
struct EngineSeconds {
  double start = 0, per_ray = 0;
};

struct EngineInfo {
  std::string_view name;                ///< "povray", as on the command line and in file names
  std::string_view title;               ///< "POV-Ray"
  std::string_view install_hint;        ///< "sudo apt-get install povray"
  std::string_view supported_versions;  ///< "3.7 or 3.8"
  std::string_view shading;             ///< which models are native, and which are reimplemented
  std::string_view precision;           ///< of its pictures
  std::string_view effects;             ///< effects of light that it supports
  std::string_view plain;               ///< name of its number format
  std::string_view fine = {};           ///< name of the finer one; empty if there is none
  bool is_program = true;               ///< false: it is part of Lobelia, or pictures
  bool whole_scenes = false;  ///< shows lights with a size and so on by itself, not as averages
  EngineFloor floor = {};     ///< of its usual pictures
  EngineSeconds seconds = {};
  std::span<const EngineVariant> variants = {};
  std::string_view transport =
      {};  ///< name for ReferenceOptions::own_transport; empty if it has none
};

/// Whether an engine can render at all. Engine::why_not() tells about one scene.
enum class EngineState {
  kAbsent,  ///< there is no such program
  kBroken,  ///< it does not start, does not end, or does not report a supported version
  kReady,
};

constexpr std::string_view state_name(EngineState state) {
  return records::kEngineStates[std::size_t(state)];
}

/// The files of an engine that were seen when it was asked for its version; content.hpp hashes them.
struct EngineFiles {
  std::vector<std::filesystem::path> programs;   ///< started; a wrapper script starts several
  std::vector<std::filesystem::path> libraries;  ///< loaded by these
  std::vector<std::filesystem::path>
      data;  ///< what it reads: files, and directories with all in them
};

struct EngineStatus {
  EngineState state = EngineState::kAbsent;
  std::filesystem::path program;
  std::string version;  ///< "3.7.0.10"
  std::string why;      ///< one sentence if it is not ready
  EngineFiles files = {};
  bool available() const { return state == EngineState::kReady; }
};

struct ReferenceOptions {
  int threads = 0;    ///< 0: all processors
  int processes = 0;  ///< of an engine that is a program, at most at once; 0: chosen by the engine
  std::chrono::duration<double> time_limit = std::chrono::minutes(10);  ///< for each picture
  /// Longest time without output or change of a file; 0: none.
  std::chrono::duration<double> no_progress_limit{0};
  std::uint64_t memory_limit = 0;  ///< bytes for all processes of a picture; 0: any number
  std::uint64_t disk_limit = 0;    ///< likewise on disk
  /// Points on every area light, on the lens and in the pixel, if the scene has them; a multiple of kReplicates.
  int points = 256;
  std::uint64_t seed = 0;  ///< of these points
  bool fine = false;       ///< use the finer number format, if there are two
  Shading shading = Shading::kAny;
  /// Renders the scene's samples, seed, area lights and inter-reflection by the engine's own light transport, on surfaces
  /// without highlights, instead of averaging single rays. To measure the engine, not the picture.
  bool own_transport = false;
  std::size_t scenes =
      1;  ///< expected number of scenes; processes and threads are divided among them
};

/// Independent estimates; their scatter gives the error of their mean.
inline constexpr int kReplicates = 16;

/// Replaces the path of an engine's temporary directory in messages.
inline constexpr std::string_view kEngineDirectory = "<its directory>";

/// One picture, or why there is none.
struct ReferenceResult {
  Image image;           ///< without gain
  Image standard_error;  ///< if the image is an average (replicates.hpp); otherwise empty
  std::string error;     ///< empty on success
  FailureClass failure = FailureClass::kNone;        ///< kNone on success
  std::string log;                                   ///< the engine's output
  std::chrono::steady_clock::time_point begun = {};  ///< when work on it began
  records::Reference record;  ///< without the command and the picture's file name
};

/// The values of a cell's axes, by axis, as they can be a part of a file's name.
using AxisValues = records::Named<std::string>;

/// An engine at work on scenes under lights without size, by one ray through each pixel's centre.
class SimpleSession {
 public:
  virtual ~SimpleSession() = default;
  /// As Session::render(); `scenes` is the number that the caller has to render, including this one.
  virtual ReferenceResult render(const Scene& scene, std::size_t scenes) = 0;
  /// The same for an engine that also gets the cell's values.
  virtual ReferenceResult render_cell(const Scene& scene, const AxisValues&, std::size_t scenes) {
    return render(scene, scenes);
  }
  virtual int at_once(std::size_t scenes) const = 0;
  virtual void stop() = 0;
};

class Engine;

/// An engine at work. Its processes end with it.
class Session {
 public:
  /// Throws Error(kEngine) if the engine is not available.
  Session(Engine& engine, const ReferenceOptions& options);

  /// Blocks until the picture is there or has failed; values that are not finite are a failure. Callable from any thread.
  /// A scene that needs_replicates() keeps the machine busy by itself: its parts are rendered at_once(). Throws
  /// Error(kInterrupted) on Ctrl-C and after stop().
  ReferenceResult render(const Scene& scene, const AxisValues& axes = {});

  /// How many simultaneous calls of render() keep the engine busy.
  int at_once() const { return simple_->at_once(options_.scenes); }
  /// Ends all processes.
  void stop() { simple_->stop(); }

 private:
  ReferenceResult render_part(const Scene& scene, const AxisValues& axes, std::size_t scenes);

  Engine& engine_;
  const ReferenceOptions options_;
  std::unique_ptr<SimpleSession> simple_;
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual const EngineInfo& info() const = 0;
  /// Finds the program and asks for its version; slow at the first call, cached afterwards.
  virtual const EngineStatus& status() = 0;
  /// Why this engine cannot show a scene, as a sentence; empty if it can.
  std::string why_not(const Scene& scene, const ReferenceOptions& options,
                      const AxisValues& axes = {}) const;
  /// Its description, if it is not one of the catalogue; otherwise null.
  virtual const records::OutsideEngine* outside() const { return nullptr; }
  /// The part of a picture's cache key that its version, files and scene do not cover. What takes longer than
  /// `time_limit` to read is not read: the picture fails.
  virtual std::string key_part(const Film&, const AxisValues&,
                               std::chrono::duration<double> /*time_limit*/) const {
    return "";
  }
  /// Whether a picture of this scene is an average of many.
  bool averages(const Scene& scene) const;

 protected:
  friend class Session;
  virtual std::string why_not_simple(const Scene& scene, const ReferenceOptions& options) const = 0;
  /// The same for an engine with EngineInfo::whole_scenes.
  virtual std::string why_not_whole(const Scene&, const AxisValues&) const { return ""; }
  /// The same for the engine's own light transport.
  virtual std::string why_not_transport(const Scene&) const { return "it has none"; }
  virtual std::unique_ptr<SimpleSession> open_simple(const ReferenceOptions& options) = 0;
};

/// How an engine shades each model, by what it says of a sphere under one directional light. Empty for what is not a
/// program of the catalogue.
std::vector<records::EngineModel> engine_models(const Engine& engine);

/// Throws Error(kEngine) with the reason and the install hint unless the engine is available.
void require_available(const EngineInfo& engine, const EngineStatus& status);

/// Bytes of all the pictures that a scene is averaged from; 0 if it is a single picture.
std::uint64_t memory_to_average(const Scene& scene, const ReferenceOptions& options);

/// Attributes of the EXR: the engine, the method and the scene. No times and no paths, so that the same reference is the
/// same file.
ImageMetadata reference_metadata(const Scene& scene, const records::Reference& record);

/// The catalogue of engines. Unknown names throw Error(kUsage). An empty `program` means the one in $PATH.
std::span<const EngineInfo> engine_infos();
const EngineInfo& engine_info(std::string_view name);
/// The first engine with its own light transport; null if there is none.
const EngineInfo* transport_engine();
std::unique_ptr<Engine> make_engine(std::string_view name, const std::filesystem::path& program);
/// Writes the engine's input files and a script that renders them without Lobelia into `directory`. The parts of an average
/// go into directories setR-P: the mean over P is one estimate.
void keep_engine_input(std::string_view engine, const Scene& scene, const ReferenceOptions& options,
                       const std::filesystem::path& directory);

}  // namespace lobelia

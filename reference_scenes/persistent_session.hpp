// Programs of engines that are given one scene after another, because they start slowly.
//
// A program renders the scene that it is started with, and then asks for more. It prints
//
//   lobelia: begin NAME
//   lobelia: done NAME SECONDS CPU_SECONDS PEAK_BYTES
//   lobelia: failed NAME WHY
//   lobelia: more
//
// and whatever else, which goes into the scene's log. At "done" the pictures NAME-PASS.FORMAT lie in its directory, float
// RGB of the film's size; they add up. After "more" a line of standard input names a file there with another scene; an
// empty line or the end of the input ends the program. CPU_SECONDS and PEAK_BYTES count from its start and may be left
// out. A scene that takes too long ends it by SIGALRM, or with exit code 142.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "reference_scenes/engine.hpp"

namespace lobelia {

/// A scene as a program gets it.
struct SceneInput {
  std::string name;
  std::size_t passes = 0;  ///< number of pictures
  std::string text;
};

/// The differences between these programs. Its functions may be called from several threads.
class PersistentProgram {
 public:
  static constexpr char kFirstFile[] = "first";

  virtual ~PersistentProgram() = default;
  virtual const EngineInfo& info() const = 0;
  /// Throws Error for what it cannot render.
  virtual SceneInput input(const Scene& scene, const std::string& name) const = 0;
  /// Everything that it needs besides scenes.
  virtual void write_files(const std::filesystem::path&) const {}
  /// Writes the file that it starts with: kFirstFile with the scene's text, unless overridden.
  virtual void write_first(const std::filesystem::path& directory, int threads,
                           const ReferenceOptions& options, const SceneInput& first) const;
  /// `program` is EngineStatus::program, `directory` where it is to work.
  virtual std::vector<std::string> arguments(const std::string& program,
                                             const std::filesystem::path& directory) const = 0;
  /// Pictures that a scene needs, and their removal.
  virtual void write_pictures(const std::filesystem::path&, const Scene&, const SceneInput&) const {
  }
  virtual void remove_pictures(const std::filesystem::path&, const SceneInput&) const {}
  /// The ending of its pictures.
  virtual std::string_view picture_format() const { return "exr"; }
  virtual bool is_native() const { return true; }
  virtual std::string method() const = 0;
};

/// `status` must outlive it.
std::unique_ptr<SimpleSession> open_persistent(std::unique_ptr<const PersistentProgram> program,
                                               const EngineStatus& status,
                                               const ReferenceOptions& options);

}  // namespace lobelia

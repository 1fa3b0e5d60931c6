// A scene written down for POV-Ray: numbers and our own names around lobelia_scene.inc and the models' include files, which
// `lobelia export` writes too. Nothing that a user typed into the scene file (ids, paths) gets in, so none of it can become
// code.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reference_scenes/engine.hpp"

namespace lobelia {

struct PovrayPass {
  std::string view, surfaces;  ///< the .pov file before and after the place for rest()
  double gain = 1;             ///< the picture is too bright by this factor, a power of two

  std::string scene() const { return view + surfaces; }
  /// A scene that shows half of the rounding error of this pass's picture, the file `coarse` beside it.
  std::string rest(const std::string& coarse) const;
};

struct PovrayInput {
  /// One pass with POV-Ray's own phong and specular and all lights. Otherwise the model is a pattern function of one light,
  /// and each pass has one.
  bool native = false;
  std::vector<PovrayPass> passes;
  std::map<std::string, std::string>
      includes;  ///< text by file name; they lie beside the .pov files
};

/// Why POV-Ray cannot show this scene of single rays and lights without size, as a sentence; empty if it can.
std::string why_not_in_povray(const Scene& scene, const ReferenceOptions& options);

/// `scene` is in engine units (preparation.hpp).
PovrayInput povray_input(const Scene& scene, const ReferenceOptions& options = {});

/// The name of a pass's files.
std::string povray_pass_stem(std::size_t pass);

/// Options for the .ini file, "Width=64": all that affect the picture, because the system's or the user's povray.ini is
/// read first. File names are not among them. With `statistics` POV-Ray reports times.
std::vector<std::string> povray_options(const Film& film, int threads);

/// All files with which `sh povray.sh` renders a scene, by name: pass0.pov, pass0.ini, include files.
std::map<std::string, std::string> povray_files(const Scene& scene,
                                                const ReferenceOptions& options = {});

/// Writes `stem`.ini, with which `povray STEM.ini`, run in `directory`, renders STEM.pov to STEM.exr.
void write_povray_ini(const std::filesystem::path& directory, const std::string& stem, double gain,
                      const std::vector<std::string>& options);

/// Makes `home` a home directory with POV-Ray's own restrictions enabled and an empty povray.ini, and returns the
/// environment to run POV-Ray `version` with.
///
/// Debian's 3.7.0.10 says that its restrictions are enabled. They keep it from running programs, even if the system's
/// povray.conf allows that, but not from files: with [File I/O Security] restricted, #fopen, #include and the picture
/// still reach all that the user may read and write. base/system/write_limit.hpp is what limits its writing; the
/// restrictions are for builds that honour them.
std::vector<std::string> povray_home(const std::filesystem::path& home, const std::string& version);

}  // namespace lobelia

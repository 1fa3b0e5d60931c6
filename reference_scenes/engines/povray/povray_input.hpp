// A scene written down for POV-Ray: numbers and our own names around lobelia_scene.inc and the models'
// include files, which are what `lobelia export` writes. Nothing that a person typed into the scene
// file (ids, paths) is in it, so nothing of it can become code.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reference_scenes/engine.hpp"

namespace lobelia {

struct PovrayPass {
  std::string view, surfaces;  ///< the .pov file, before and after the place for rest()
  double gain = 1;             ///< its picture is this many times too bright; a power of two

  std::string scene() const { return view + surfaces; }
  /// A scene that shows half of what its picture, the file `coarse` beside it, has rounded off.
  std::string rest(const std::string& coarse) const;
};

struct PovrayInput {
  /// POV-Ray's own phong and specular with all lights at once; otherwise the model is a pattern
  /// function of one light and each pass has one.
  bool native = false;
  std::vector<PovrayPass> passes;
  std::map<std::string, std::string> includes;  ///< file name and text; beside the .pov files
};

/// Why POV-Ray cannot show this scene of single rays and lamps without a size, as a sentence; empty if
/// it can.
std::string why_not_in_povray(const Scene& scene, const ReferenceOptions& options);

/// `scene` is in engine units (preparation.hpp).
PovrayInput povray_input(const Scene& scene, const ReferenceOptions& options = {});

}  // namespace lobelia

// The files that POV-Ray is given for a reference picture.
#include "reference_scenes/engines/povray/povray_input.hpp"
#include "reference_scenes/formats/formats.hpp"
#include "reference_scenes/preparation.hpp"
#include "reference_scenes/replicates.hpp"

namespace lobelia {
namespace {

std::string why_not_povray_scene(const Scene& scene) {
  if (std::string why = why_not_so_many_spheres(scene); !why.empty()) return why;
  if (std::string why = why_not_comparable(scene); !why.empty()) return why;
  if (needs_replicates(scene))
    return "its picture is the average of many of POV-Ray's: it has a light with a size, a lens or several samples "
           "per pixel ('lobelia reference --engine povray --keep-input DIR' writes them)";
  return why_not_in_povray(scene, {});
}

}  // namespace

constinit const SceneFormat kPovrayFormat{
    "povray",
    "POV-Ray",
    "pass0.pov",
    "a directory of .pov, .ini and .inc files; 'sh povray.sh' renders them. Models that POV-Ray lacks take a pass "
    "for each light",
    why_not_povray_scene,
    [](const Scene& scene) { return povray_files(scene); },
};

}  // namespace lobelia

// A script that builds the scene in Blender, for people to look at and to go on with. The reference engine is another one
// (engines/blender), which shows our formulas.
#include "base/records/record.hpp"
#include "reference_scenes/formats/catalogue.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view scene_in_blender_py;
}
namespace {

constexpr std::string_view kBegin =
    R"("""Builds the scene SCENE in Blender 3 or 4, and renders it with Cycles:

    blender -b -P scene.py -o //picture -f 1     renders pictureNNNN.exr
    blender -P scene.py                          opens it

Written by 'lobelia scene SCENE --to blender-python'. Highlights are Blender's own glossy shader, so they are only near to
Lobelia's; each material has the exact model in its custom properties. 'lobelia reference --engine blender' is exact.
"""

import json
import math
import os

import bmesh
import bpy
from mathutils import Matrix, Vector

true, false, null = True, False, None
SCENE = )";

std::string why_not_blender_python(const Scene& scene) {
  if (std::string why = why_not_spelled_out(scene); !why.empty()) return why;
  for (const Light& light : scene.lights)
    if (const auto lamp = find_lamp(light); lamp && lamp->has_normal())
      return lamp->spot
                 ? "it has a spot light, which this script does not make"
                 : "a point light falls with the cosine to its normal, and Blender's lamps do not";
  return {};
}

/// JSON with three names is Python: its strings have the same escapes, so nothing in the scene becomes code.
std::map<std::string, std::string> write_blender_python(const Scene& scene) {
  return {{"scene.py", std::string(kBegin) + record_text(scene_record(scene)) +
                           std::string(embedded::scene_in_blender_py)}};
}

}  // namespace

constinit const SceneFormat kBlenderPythonFormat{
    "blender-python",
    "Blender",
    "scene.py",
    "a script for 'blender -P scene.py' that builds the scene of meshes, lamps and Blender's own glossy shader",
    why_not_blender_python,
    write_blender_python,
};

}  // namespace lobelia

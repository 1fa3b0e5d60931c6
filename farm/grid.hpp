// Grid files: a scene, the axes along which it varies, and the engines to compare with.
//
//   <grid version="1" title="Six models">
//     <scene file="../scenes/oblique_45.xml"/>
//     <film width="256" height="256"/>                      may be left out
//     <axis name="model" values="phong_rdf, modified_phong"/>
//     <axis name="exponent" values="16, 128"/>
//     <engine name="povray"/>
//   </grid>
//
// Files are named relative to the grid file. Every combination of the axes' values is a cell.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "farm/axes.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

inline constexpr std::size_t kMaxCells = 100000;

struct Axis {
  std::string name;
  std::vector<AxisValue> values;
};

struct Grid {
  std::string title;
  std::string file_name;  ///< without directory
  Scene scene;
  std::vector<Axis> axes;  ///< at least one, in the file's order
  std::vector<std::string> engines;
};

struct Cell {
  std::string id;  ///< a file name: the axes' tokens, joined by '-'
  std::vector<std::pair<std::string, std::string>> axes;  ///< name, value
  Scene scene;
};

/// Throws Error(kInput) with all errors found, each "file:line:column: ...".
Grid read_grid(const std::filesystem::path& path);

/// All combinations, the last axis running fastest.
std::vector<Cell> cells_of(const Grid& grid);

}  // namespace lobelia

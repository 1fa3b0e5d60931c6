// Grid files: a scene, the axes along which it varies, and the engines to compare with.
//
//   <grid version="1" title="Six models">
//     <scene file="../scenes/oblique_45.xml"/>
//     <film width="256" height="256"/>                      may be left out
//     <axis name="model" values="phong_rdf, modified_phong"/>
//     <axis name="exponent" values="16, 128"/>
//     <exclude model="phong_rdf" exponent="128"/>
//     <include model="phong_rdf" exponent="2048"/>
//     <engine name="povray"/>
//   </grid>
//
// Files are named relative to the grid file. Every combination of the axes' values is a cell;
// docs/grid_format.md says the rest.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "farm/axes.hpp"
#include "farm/grid_places.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

inline constexpr std::size_t kMaxCells = 1000000;
inline constexpr std::size_t kMaxIdBytes = 200;  ///< leaves room for an ending in a file's name

struct Axis {
  std::string name;
  std::vector<AxisValue> values;  ///< those that only an include names come last
};

struct Grid {
  std::string title;
  std::string file_name;             ///< without directory
  Scene scene;                       ///< empty if there is an axis of scenes
  std::vector<Axis> axes;            ///< at least one, in the file's order
  std::vector<std::string> engines;  ///< every one that a cell is compared with
  /// For each cell the index of its value on every axis. No combination stands twice.
  std::vector<ValueIndex> places;

  std::size_t cell_count() const { return places.size() / axes.size(); }
};

struct Cell {
  std::string id;  ///< a file name, unique in its grid: the axes' tokens, joined by '-'
  std::vector<std::pair<std::string, std::string>> axes;  ///< name, value
  std::vector<ValueIndex> at;                             ///< index of its value on each axis
  std::vector<std::string> engines;                       ///< that it is compared with
};

/// Throws Error(kInput) with all errors found, each "file:line:column: ...".
Grid read_grid(const std::filesystem::path& path);

/// All cells: the product, the last axis or list running fastest, then what is included.
std::vector<Cell> cells_of(const Grid& grid);

/// The id of the cell with these values, one on each axis.
std::string cell_id(const Grid& grid, std::span<const ValueIndex> at);

/// The cell's scene, made now because a grid may have a million. For any thread.
Scene scene_of(const Grid& grid, const Cell& cell);

}  // namespace lobelia

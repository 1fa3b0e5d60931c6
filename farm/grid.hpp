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
//     <engine name="mine" command="myrender {scene} {out}"/>
//   </grid>
//
// Paths are relative to the grid file. Every combination of the axes' values is a cell. See docs/grid_format.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/records/outside_engine.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

inline constexpr std::size_t kMaxCells = 1000000;
inline constexpr std::size_t kMaxIdBytes = 200;  ///< leaves room for a file name's ending

struct AxisValue {
  std::string value;  ///< in the grid file: "cs16:paper"
  std::string label;  ///< for people: "cs16, paper"
  std::string
      token;  ///< for file names, "cs16_paper": [A-Za-z0-9_.+-], without '.' or '-' in front
  std::function<void(Scene&)> apply = {};  ///< for any thread; null if it changes nothing
  std::shared_ptr<const Scene> scene =
      {};  ///< replaces the grid's scene before any apply; null: keeps it
};

/// A kind of axis: how a value is written and what it does to a scene. A new kind is an entry in axes.cpp.
struct AxisKind {
  std::string_view name;
  std::string_view allowed;  ///< values, in words
  /// Looks for files in `directory`. Throws std::runtime_error that names neither line nor grid file.
  AxisValue (*parse)(const std::string& text, const std::filesystem::path& directory);
};

std::span<const AxisKind> axis_kinds();

struct Grid;
/// An axis that cannot stand beside another one, or with a scene of the grid, and why; empty if all can.
std::pair<std::string, std::string> conflict_of(const Grid& grid);

/// All of docs/reference/grid.xsd, by the table that read_grid() checks against.
std::string grid_schema();

/// The parts of `text` between commas and white space. On the axis of lobes not within the parentheses of a formula.
std::vector<std::string> split_values(std::string_view axis, std::string_view text);

/// A sentence if a light of the scene is a picture file, which a cell cannot keep; otherwise empty.
std::string picture_of(const Scene& scene);

using ValueIndex = std::uint16_t;  ///< of a value on its axis

struct Axis {
  std::string name;
  std::vector<AxisValue> values;  ///< values named only in an <include> come last
};

struct Grid {
  std::string title;
  std::string authors, url;                     ///< of the study, for its gallery; may be empty
  std::string file_name;                        ///< without directory
  std::filesystem::path directory;              ///< of the file: absolute, without links
  Scene scene;                                  ///< empty if there is an axis of scenes
  std::vector<Axis> axes;                       ///< at least one, in the file's order
  std::vector<std::string> engines;             ///< all that any cell is compared with
  std::vector<records::OutsideEngine> outside;  ///< those of them that are not in the catalogue
  std::string
      truth;  ///< the engine with which all pictures are compared; empty: each engine with ours
  bool ours = true;  ///< whether our picture is compared and shown
  /// For each cell the index of its value on every axis. No combination appears twice.
  std::vector<ValueIndex> places;

  std::size_t cell_count() const { return places.size() / axes.size(); }
};

struct Cell {
  std::string id;  ///< a file name, unique in its grid: the values' tokens, joined by '-'
  std::vector<std::pair<std::string, std::string>> axes;  ///< name, value
  std::vector<ValueIndex> at;                             ///< index of its value on each axis
  AxisValues
      tokens;  ///< by axis, the value if it can be a file name; only for a grid with outside engines
  std::vector<std::string> engines;  ///< to compare with
};

/// Throws Error(kInput) with all errors found, each "file:line:column: ...".
Grid read_grid(const std::filesystem::path& path);

/// All cells: the product, the last axis or list running fastest, then the included ones.
std::vector<Cell> cells_of(const Grid& grid);

/// The id of the cell with these values, one on each axis.
std::string cell_id(const Grid& grid, std::span<const ValueIndex> at);

/// The cell's scene, made on demand because a grid may have a million. For any thread.
Scene scene_of(const Grid& grid, const Cell& cell);

}  // namespace lobelia

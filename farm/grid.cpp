#include "farm/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image.hpp"
#include "core/text.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/scene/scene_io.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kMaxGridBytes = 1 << 20;
constexpr std::size_t kMaxAxisValues = 10000;
constexpr std::size_t kMaxParts = 10000000;
constexpr std::string_view kGridFormatVersion = "1";
constexpr std::string_view kElements[] = {"scene", "film", "axis", "engine"};

class GridReader {
 public:
  GridReader(XmlSource& source, std::filesystem::path directory)
      : source_(source), directory_(std::move(directory)) {}

  Grid read() {
    const auto root = source_.root();
    if (std::string_view(root.name()) != "grid") {
      source_.error(root, fmt::format("the root element is <{}>; a grid file begins with <grid>",
                                      printable(root.name())));
      source_.throw_if_errors();
    }
    source_.check_attributes(root, {"version", "title"});
    if (const auto version = source_.required(root, "version");
        !version.empty() && version != kGridFormatVersion)
      source_.error(root.attribute("version"), root,
                    fmt::format("format version '{}'; this program reads version {}",
                                printable(version), kGridFormatVersion));
    grid_.title = root.attribute("title").as_string("Highlights");
    for (const auto node : root.children())
      if (node.type() == pugi::node_element) read_element(node);
    if (!seen_.contains("scene")) source_.error(root, "the grid has no <scene file=\"...\"/>");
    if (grid_.axes.empty()) source_.error(root, "the grid has no <axis>; it needs one");
    check_size(root);
    source_.throw_if_errors();
    if (film_) {
      grid_.scene.film.width = film_->width;  // the filter stays the scene's
      grid_.scene.film.height = film_->height;
    }
    return std::move(grid_);
  }

 private:
  void read_element(pugi::xml_node node) {
    const std::string_view tag = node.name();
    if (tag == "scene" && once(node)) read_scene_file(node);
    if (tag == "film" && once(node)) read_film(node);
    if (tag == "axis") read_axis(node);
    if (tag == "engine") read_engine(node);
    if (std::find(std::begin(kElements), std::end(kElements), tag) == std::end(kElements))
      source_.error(node,
                    fmt::format("unknown element <{}> in <grid>; allowed: {}{}", printable(tag),
                                join(kElements), did_you_mean(tag, kElements)));
  }

  bool once(pugi::xml_node node) {
    if (seen_.insert(node.name()).second) return true;
    source_.error(node, fmt::format("a second <{}>; one is allowed", node.name()));
    return false;
  }

  void read_scene_file(pugi::xml_node node) {
    source_.check_attributes(node, {"file"});
    const std::string file = source_.required(node, "file");
    if (file.empty()) return;
    try {
      grid_.scene = read_scene(directory_ / file);
      if (const std::string picture = picture_of(grid_.scene); !picture.empty())
        source_.error(node.attribute("file"), node, picture);
    } catch (const Error& error) {
      source_.error(node.attribute("file"), node, error.what());
    }
  }

  void read_film(pugi::xml_node node) {
    source_.check_attributes(node, {"width", "height"});
    const auto side = [&](const char* name) {
      const std::string text = source_.required(node, name);
      long long value = 1;
      if (!text.empty() && (!parse_integer(text, value) || value < 1 || value > kMaxImageSide)) {
        source_.error(node.attribute(name), node,
                      fmt::format("{} '{}'; allowed: whole numbers from 1 to {}", name,
                                  printable(text), kMaxImageSide));
        value = 1;
      }
      return int(value);
    };
    film_ = Film{side("width"), side("height")};
    if (std::int64_t{film_->width} * film_->height > kMaxImagePixels)
      source_.error(node, fmt::format("{} x {} pixels; allowed: {} in all", film_->width,
                                      film_->height, kMaxImagePixels));
  }

  void read_axis(pugi::xml_node node) {
    source_.check_attributes(node, {"name", "values"});
    const std::string name = source_.required(node, "name");
    const std::string values = source_.required(node, "values");
    if (name.empty() || values.empty()) return;
    const auto kinds = axis_kinds();
    const auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const AxisKind& k) { return k.name == name; });
    if (kind == kinds.end()) {
      std::vector<std::string_view> names;
      for (const auto& k : kinds) names.push_back(k.name);
      source_.error(node.attribute("name"), node,
                    fmt::format("unknown axis '{}'; allowed: {}{}", printable(name), join(names),
                                did_you_mean(name, names)));
      return;
    }
    if (!axis_names_.insert(name).second) {
      source_.error(node, fmt::format("a second axis '{}'; one is allowed", name));
      return;
    }
    Axis axis{name, {}};
    std::set<std::string> texts, tokens;
    for (const auto& text : split(values, ", \t\n\r")) {
      try {
        // By the text first, so that a file named a thousand times is read once.
        if (!texts.insert(text).second)
          throw std::runtime_error(
              fmt::format("'{}' stands twice on the axis '{}'", printable(text), name));
        if (texts.size() > kMaxAxisValues) break;
        axis.values.push_back(kind->parse(text, directory_));
        if (!tokens.insert(axis.values.back().token).second)
          throw std::runtime_error(
              fmt::format("'{}' would have the same file name as another value of the axis '{}'",
                          printable(text), name));
      } catch (const std::runtime_error& error) {
        source_.error(node.attribute("values"), node, error.what());
      }
    }
    if (texts.size() > kMaxAxisValues)
      source_.error(node, fmt::format("over {} values on the axis '{}'; allowed: {}",
                                      kMaxAxisValues, name, kMaxAxisValues));
    if (texts.empty())
      source_.error(node,
                    fmt::format("the axis '{}' has no values; allowed: {}", name, kind->allowed));
    grid_.axes.push_back(std::move(axis));
  }

  void read_engine(pugi::xml_node node) {
    source_.check_attributes(node, {"name"});
    const std::string name = source_.required(node, "name");
    std::vector<std::string_view> names;
    for (const auto& engine : engine_infos()) names.push_back(engine.name);
    if (std::find(names.begin(), names.end(), name) == names.end())
      source_.error(node, fmt::format("unknown engine '{}'; allowed: {}{}", printable(name),
                                      join(names), did_you_mean(name, names)));
    else if (std::find(grid_.engines.begin(), grid_.engines.end(), name) != grid_.engines.end())
      source_.error(node, fmt::format("a second engine '{}'; one is allowed", name));
    else
      grid_.engines.push_back(name);
  }

  void check_size(pugi::xml_node root) {
    std::size_t count = 1;
    for (const auto& axis : grid_.axes) {
      count *= std::max<std::size_t>(1, axis.values.size());
      if (count <= kMaxCells) continue;
      source_.error(root, fmt::format("over {} cells; allowed: {}", kMaxCells, kMaxCells));
      return;
    }
    // Every cell holds its scene.
    const Scene& scene = grid_.scene;
    const std::size_t parts =
        scene.spheres.size() + scene.planes.size() + scene.materials.size() + scene.lights.size();
    if (count * parts > kMaxParts)
      source_.error(root, fmt::format("{} cells of {} shapes, materials and lights each; allowed: "
                                      "{} in all",
                                      count, parts, kMaxParts));
  }

  XmlSource& source_;
  std::filesystem::path directory_;
  Grid grid_;
  std::optional<Film> film_;
  std::set<std::string> seen_, axis_names_;
};

}  // namespace

Grid read_grid(const std::filesystem::path& path) {
  XmlSource source(read_file(path, kMaxGridBytes), path.string(), kMaxGridBytes);
  Grid grid = GridReader(source, path.parent_path()).read();
  grid.file_name = path.filename().string();
  return grid;
}

std::vector<Cell> cells_of(const Grid& grid) {
  std::vector<Cell> cells{{"", {}, grid.scene}};
  for (const auto& axis : grid.axes) {
    std::vector<Cell> longer;
    for (const auto& cell : cells)
      for (const auto& value : axis.values) {
        Cell next = cell;
        next.id += (next.id.empty() ? "" : "-") + value.token;
        next.axes.emplace_back(axis.name, value.value);
        value.apply(next.scene);
        longer.push_back(std::move(next));
      }
    cells = std::move(longer);
  }
  return cells;
}

}  // namespace lobelia

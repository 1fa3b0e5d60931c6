#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/pictures/image.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "farm/grid_choices.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engines/outside/outside_reader.hpp"
#include "renderer/scene/scene_io.hpp"
#include "renderer/shipped_files.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kMaxGridBytes = 1 << 20;
constexpr std::size_t kMaxParts = 100000000;
constexpr std::string_view kGridFormatVersion = "1", kDefaultTitle = "Highlights";
constexpr std::size_t kMaxEngines = 100;  // a job has the engine's number in a byte

XmlAttribute attribute(std::string_view name, std::string_view default_value,
                       std::string_view meaning, std::vector<std::string_view> choices = {}) {
  return {{name, ParameterType::kString, default_value, 0, 0, "", meaning}, std::move(choices)};
}

std::vector<XmlElement> make_elements() {
  constexpr Parameter kSides[] = {
      {"width", ParameterType::kInteger, "", 1, kMaxImageSide, "pixels", "of every picture"},
      {"height", ParameterType::kInteger, "", 1, kMaxImageSide, "pixels", "of every picture"}};
  std::vector<std::string_view> axes;
  std::vector<XmlAttribute> chosen;
  for (const AxisKind& kind : axis_kinds()) {
    axes.push_back(kind.name);
    chosen.push_back(attribute(kind.name, "any", kind.allowed));
  }
  std::vector<XmlElement> elements{
      {"grid",
       "scenes that vary along axes, and the engines to compare with",
       {attribute("version", "", "of the format", {kGridFormatVersion}),
        attribute("title", kDefaultTitle, "of the gallery"),
        attribute("authors", "none", "of the study, for its gallery: A. Author and B. Author"),
        attribute("url", "none", "where the study is published, for its gallery: https://..."),
        attribute("reference", "ours", "the engine that all others are compared with"),
        attribute("ours", "yes", "whether our picture is compared and shown", {"yes", "no"})},
       {{{"scene"}, 0, 1},
        {{"film"}, 0, 1},
        {{"axis", "list"}, 1},
        {{"exclude", "include", "engine", "pictures"}}}},
      {"scene", "the scene that varies", {attribute("file", "", "relative to the grid file")}},
      {"film", "the size of every picture", {{kSides[0]}, {kSides[1]}}},
      {"axis",
       "a setting that varies",
       {attribute("name", "", "what varies", axes),
        attribute("values", "", "between commas or blanks")}},
      {"list", "axes that advance together", {}, {{{"axis"}, 1}}},
      {"exclude", "takes away every cell that has all of these values", chosen},
      {"include", "adds one cell; it has a value of every axis of the grid", std::move(chosen)},
  };
  for (XmlElement element : outside_elements()) {
    // The description may be in a file, and then everything else is.
    for (XmlAttribute& each : element.attributes)
      if (each.parameter.default_value.empty()) each.parameter.default_value = "in the file";
    element.attributes.push_back(attribute("file", "none", "a file with an <engine>"));
    elements.push_back(std::move(element));
  }
  return elements;
}

std::span<const XmlElement> grid_elements() {
  static const std::vector<XmlElement> elements = make_elements();
  return elements;
}

class GridReader {
 public:
  /// `directory` is the file's by its path as it was given, `real_directory` that of InputFile::real_path().
  GridReader(XmlSource& source, std::filesystem::path directory,
             std::filesystem::path real_directory)
      : source_(source), directory_(std::move(directory)) {
    grid_.directory = std::move(real_directory);
  }

  Grid read() {
    const auto root = source_.root();
    if (std::string_view(root.name()) != "grid") {
      source_.error(root, fmt::format("the root element is <{}>; a grid file begins with <grid>",
                                      printable(root.name())));
      source_.throw_if_errors();
    }
    check_attributes(root);
    if (const auto version = source_.required(root, "version");
        !version.empty() && version != kGridFormatVersion)
      source_.error(root.attribute("version"), root,
                    fmt::format("format version '{}'; this program reads version {}",
                                printable(version), kGridFormatVersion));
    grid_.title = root.attribute("title").as_string(kDefaultTitle.data());
    grid_.authors = root.attribute("authors").as_string();
    grid_.url = root.attribute("url").as_string();
    if (!grid_.url.empty() && !grid_.url.starts_with("https://") &&
        !grid_.url.starts_with("http://"))
      source_.error(
          root.attribute("url"), root,
          fmt::format("url '{}'; allowed: an address that begins with https:// or http://",
                      printable(grid_.url)));
    for (const auto node : root.children())
      if (node.type() == pugi::node_element) read_element(node);
    if (!seen_.contains("scene") && !axis_nodes_.contains("scene"))
      source_.error(root, "the grid has no <scene file=\"...\"/> and no axis 'scene'");
    if (axis_nodes_.empty()) source_.error(root, "the grid has no <axis>; it needs one");
    if (film_ && axis_nodes_.contains("size"))
      source_.error(axis_nodes_["size"], "an axis 'size' beside a <film>; allowed: one of them");
    if (!grid_.engines.empty() && axis_nodes_.contains("engine"))
      source_.error(axis_nodes_["engine"],
                    "an axis 'engine' beside <engine>; allowed: one of them");
    read_truth(root);
    check_size(root);
    source_.throw_if_errors();  // what follows builds on whole axes
    read_choices(source_, root, tables_, std::move(factors_), grid_);
    if (const auto [axis, why] = conflict_of(grid_); !why.empty())
      source_.error(axis_nodes_[axis], why);
    check_places();
    source_.throw_if_errors();
    finish_scenes();
    check_parts(root);
    source_.throw_if_errors();
    return std::move(grid_);
  }

 private:
  void read_element(pugi::xml_node node) {
    const std::string_view tag = node.name();
    if (tag == "scene" && once(node)) read_scene_file(node);
    if (tag == "film" && once(node)) read_film(node);
    if (tag == "axis") {
      GridFactor factor;
      read_axis(node, factor, false);
      add(std::move(factor));
    }
    if (tag == "list") read_list(node);
    if (tag == "engine" || tag == "pictures") read_engine(node);
    if (const auto allowed = grid_elements().front().child_tags();
        std::ranges::find(allowed, tag) == allowed.end())
      source_.error(node, fmt::format("unknown element <{}> in <grid>; allowed: {}{}",
                                      printable(tag), join(allowed), did_you_mean(tag, allowed)));
  }

  void check_attributes(pugi::xml_node node) {
    source_.check_attributes(node, find_element(grid_elements(), node.name()).attribute_names());
  }

  bool once(pugi::xml_node node) {
    if (seen_.insert(node.name()).second) return true;
    source_.error(node, fmt::format("a second <{}>; one is allowed", node.name()));
    return false;
  }

  void read_scene_file(pugi::xml_node node) {
    check_attributes(node);
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
    check_attributes(node);
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

  /// Axes that advance together.
  void read_list(pugi::xml_node node) {
    check_attributes(node);
    GridFactor factor;
    std::string_view first;
    for (const auto child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      if (std::string_view(child.name()) != "axis") {
        source_.error(child, fmt::format("unknown element <{}> in <list>; allowed: axis",
                                         printable(child.name())));
        continue;
      }
      if (!read_axis(child, factor, true)) continue;
      if (first.empty()) first = child.attribute("name").value();
      if (factor.steps.back().size() != factor.size() && !source_.has_errors())
        source_.error(child, fmt::format("{} values beside the {} of the axis '{}'; the axes of a "
                                         "<list> advance together and have as many values each",
                                         factor.steps.back().size(), factor.size(), first));
    }
    if (!node.child("axis")) source_.error(node, "the <list> has no <axis>; it needs one");
    check_steps(node, factor);
    add(std::move(factor));
  }

  /// A step that stands twice would be the same cells twice.
  void check_steps(pugi::xml_node node, const GridFactor& factor) {
    if (source_.has_errors() || factor.steps.empty()) return;
    std::set<std::vector<ValueIndex>> before;
    for (std::size_t step = 0; step < factor.size(); ++step) {
      std::vector<ValueIndex> values;
      for (const auto& steps : factor.steps) values.push_back(steps[step]);
      if (!before.insert(values).second)
        return source_.error(
            node, fmt::format("the values of step {} of the <list> stand there twice", step + 1));
    }
  }

  void add(GridFactor factor) {
    if (!factor.steps.empty()) factors_.push_back(std::move(factor));
  }

  /// Adds the axis to the factor. In a list a value may stand more than once. False if there is no such axis.
  bool read_axis(pugi::xml_node node, GridFactor& factor, bool in_list) {
    check_attributes(node);
    const std::string name = source_.required(node, "name");
    const std::string values = source_.required(node, "values");
    if (name.empty() || values.empty()) return false;
    const auto kinds = axis_kinds();
    const auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const AxisKind& k) { return k.name == name; });
    if (kind == kinds.end()) {
      std::vector<std::string_view> names;
      for (const auto& k : kinds) names.push_back(k.name);
      source_.error(node.attribute("name"), node,
                    fmt::format("unknown axis '{}'; allowed: {}{}", printable(name), join(names),
                                did_you_mean(name, names)));
      return false;
    }
    if (!axis_nodes_.emplace(name, node).second) {
      source_.error(node, fmt::format("a second axis '{}'; one is allowed", name));
      return false;
    }
    AxisTable& table = tables_.emplace_back(*kind, directory_);
    auto& steps = factor.steps.emplace_back();
    const auto texts = split_values(name, values);
    for (const auto& text : texts) {
      if (source_.full()) break;
      try {
        if (!in_list && table.find(text))
          throw std::runtime_error(
              fmt::format("'{}' stands twice on the axis '{}'", printable(text), name));
        steps.push_back(table.find_or_add(text));
      } catch (const std::runtime_error& error) {
        source_.error(node.attribute("values"), node, error.what());
        // Every further one would be too many as well.
        if (table.axis().values.size() >= kMaxAxisValues) break;
      }
    }
    if (texts.empty())
      source_.error(node,
                    fmt::format("the axis '{}' has no values; allowed: {}", name, kind->allowed));
    return true;
  }

  void read_engine(pugi::xml_node node) {
    std::string name;
    if (node.attribute("file")) {
      name = read_engine_of_file(node);
    } else if (std::string_view(node.name()) == "pictures" || is_outside_engine(node)) {
      if (auto outside = read_outside_engine(source_, node, grid_.directory))
        name = add_outside(node, std::move(*outside));
    } else {
      source_.check_attributes(node, {"name"});
      name = source_.required(node, "name");
      std::vector<std::string_view> names;
      for (const auto& engine : engine_infos()) names.push_back(engine.name);
      if (std::find(names.begin(), names.end(), name) == names.end())
        return source_.error(
            node,
            fmt::format("unknown engine '{}'; allowed: {}{}, or one of your own with a command",
                        printable(name), join(names), did_you_mean(name, names)));
    }
    if (name.empty()) return;
    if (std::find(grid_.engines.begin(), grid_.engines.end(), name) != grid_.engines.end())
      source_.error(node, fmt::format("a second engine '{}'; one is allowed", name));
    else if (grid_.engines.size() == kMaxEngines)
      source_.error(node, fmt::format("over {} engines", kMaxEngines));
    else
      grid_.engines.push_back(name);
  }

  std::string add_outside(pugi::xml_node node, records::OutsideEngine engine) {
    engine_nodes_.push_back(node);
    return grid_.outside.emplace_back(std::move(engine)).name;
  }

  std::string read_engine_of_file(pugi::xml_node node) {
    source_.check_attributes(node, {"file"});
    try {
      return add_outside(node, read_engine_file(directory_ / node.attribute("file").value()));
    } catch (const Error& error) {
      source_.error(node.attribute("file"), node, error.what());
      return "";
    }
  }

  /// The engine that all are compared with.
  void read_truth(pugi::xml_node root) {
    grid_.truth = root.attribute("reference").value();
    const std::string ours = root.attribute("ours").as_string("yes");
    grid_.ours = ours == "yes";
    if (ours != "yes" && ours != "no")
      source_.error(root.attribute("ours"), root,
                    fmt::format("ours '{}'; allowed: yes, no", printable(ours)));
    if (!root.attribute("reference")) {
      if (!grid_.ours)
        source_.error(root, "ours=\"no\" needs a reference=\"ENGINE\" to compare the others with");
      return;
    }
    if (axis_nodes_.contains("engine"))
      source_.error(root.attribute("reference"), root, "a reference beside an axis 'engine'");
    else if (std::find(grid_.engines.begin(), grid_.engines.end(), grid_.truth) ==
             grid_.engines.end())
      source_.error(
          root.attribute("reference"), root,
          fmt::format("reference '{}'; allowed: an engine of this grid{}{}", printable(grid_.truth),
                      grid_.engines.empty() ? "" : ", ", fmt::join(grid_.engines, ", ")));
  }

  /// Whether each {name} of the outside engines is an axis or a place that every command has.
  void check_places() {
    for (std::size_t i = 0; i < grid_.outside.size(); ++i) {
      const records::OutsideEngine& engine = grid_.outside[i];
      const bool is_pictures = engine.command.empty();
      std::vector<std::string_view> names;
      if (!is_pictures) names = {"scene", "out", "width", "height", "threads"};
      for (const Axis& axis : grid_.axes) names.push_back(axis.name);
      std::vector<std::string> texts = engine.command;
      if (is_pictures) texts = {engine.files};
      try {
        for (const std::string& text : texts)
          filled_in(text, [&](std::string_view name) -> std::string {
            if (std::find(names.begin(), names.end(), name) == names.end())
              throw std::runtime_error(
                  fmt::format("{{{}}} is neither a place nor an axis; allowed: {}{}",
                              printable(name), join(names), did_you_mean(name, names)));
            return "";
          });
      } catch (const std::runtime_error& problem) {
        source_.error(engine_nodes_[i], problem.what());
      }
    }
  }

  void check_size(pugi::xml_node root) {
    std::size_t count = 1;
    for (const auto& factor : factors_) {
      count *= std::max<std::size_t>(1, factor.size());
      if (count <= kMaxCells) continue;
      source_.error(root, fmt::format("over {} cells; allowed: {}", kMaxCells, kMaxCells));
      return;
    }
  }

  /// The size of <film> goes to every scene, and the filter stays the scene's.
  void finish_scenes() {
    const auto resize = [&](Scene& scene) {
      if (!film_) return;
      scene.film.width = film_->width;
      scene.film.height = film_->height;
    };
    resize(grid_.scene);
    for (auto& axis : grid_.axes) {
      if (axis.name == "engine")
        for (const auto& value : axis.values) grid_.engines.push_back(value.value);
      if (axis.name != "scene") continue;
      grid_.scene = {};  // no cell shows it
      if (!film_) continue;
      for (auto& value : axis.values) {
        auto scene = std::make_shared<Scene>(*value.scene);
        resize(*scene);
        value.scene = std::move(scene);
      }
    }
  }

  /// Every cell's scene is written beside its results.
  void check_parts(pugi::xml_node root) {
    std::size_t parts = grid_.cell_count() * part_count(grid_.scene);
    for (std::size_t a = 0; a < grid_.axes.size(); ++a) {
      if (grid_.axes[a].name != "scene") continue;
      for (std::size_t i = a; i < grid_.places.size(); i += grid_.axes.size())
        parts += part_count(*grid_.axes[a].values[grid_.places[i]].scene);
    }
    if (parts > kMaxParts)
      source_.error(root,
                    fmt::format("{} cells of {} shapes, materials and lights in all; allowed: {}",
                                grid_.cell_count(), parts, kMaxParts));
  }

  XmlSource& source_;
  std::filesystem::path directory_;
  Grid grid_;
  std::optional<Film> film_;
  std::set<std::string> seen_;
  std::map<std::string, pugi::xml_node> axis_nodes_;
  std::vector<AxisTable> tables_;
  std::vector<GridFactor> factors_;           ///< of the axes in tables_, in that order
  std::vector<pugi::xml_node> engine_nodes_;  ///< of grid_.outside
};

}  // namespace

std::string grid_schema() { return xml_schema(grid_elements()); }

Grid read_grid(const std::filesystem::path& named) {
  const std::filesystem::path path = or_shipped(named);
  const InputFile file(path);
  XmlSource source(read_file(file, kMaxGridBytes), path.string(), kMaxGridBytes);
  Grid grid = GridReader(source, path.parent_path(), file.real_path().parent_path()).read();
  grid.file_name = path.filename().string();
  return grid;
}

std::string cell_id(const Grid& grid, std::span<const ValueIndex> at) {
  std::string id;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (i > 0) id += '-';
    id += grid.axes[i].values[at[i]].token;
  }
  return id;
}

std::vector<Cell> cells_of(const Grid& grid) {
  const std::size_t width = grid.axes.size();
  std::vector<Cell> cells(grid.cell_count());
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t c) {
    const std::span at(grid.places.data() + c * width, width);
    Cell& cell = cells[c];
    cell.id = cell_id(grid, at);
    cell.at.assign(at.begin(), at.end());
    cell.axes.reserve(width);
    for (std::size_t i = 0; i < width; ++i) {
      const Axis& axis = grid.axes[i];
      cell.axes.emplace_back(axis.name, axis.values[at[i]].value);
      if (axis.name == "engine") cell.engines = {axis.values[at[i]].value};
      if (const AxisValue& here = axis.values[at[i]]; !grid.outside.empty())
        cell.tokens.emplace_back(axis.name, is_plain_name(here.value) ? here.value : here.token);
    }
    if (cell.engines.empty()) cell.engines = grid.engines;
  });
  return cells;
}

Scene scene_of(const Grid& grid, const Cell& cell) {
  const auto value = [&](std::size_t i) -> const AxisValue& {
    return grid.axes[i].values[cell.at[i]];
  };
  const Scene* start = &grid.scene;
  for (std::size_t i = 0; i < cell.at.size(); ++i)
    if (value(i).scene) start = value(i).scene.get();
  Scene scene = *start;
  for (std::size_t i = 0; i < cell.at.size(); ++i)
    if (value(i).apply) value(i).apply(scene);
  return scene;
}

}  // namespace lobelia

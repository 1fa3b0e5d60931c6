// Which cells a grid has, and what each shows.
#include <oneapi/tbb/parallel_for.h>

#include "reference_scenes/engine.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/farm/grid_text.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

const std::string kTwoByThree =
    kScene + axis("model", "phong_rdf, blinn_phong_ndf") + axis("exponent", "16, 128, 1024");
const std::string kList = "<list>" + axis("model", "phong_rdf, phong_rdf, modified_phong") +
                          axis("exponent", "16, 128, 16") + "</list>";
const std::string kOtherList =
    "<list>" + axis("size", "8, 16x4") + axis("samples", "4, 9") + "</list>";

using Values = std::map<std::string, std::string>;

struct Choices {
  std::string product, choices;
  std::vector<std::map<std::string, std::set<std::string>>> excluded;
  std::vector<Values> included;
};

/// Grids of every kind, with their choices once as text and once as sets.
const std::vector<Choices> kCatalogue = {
    {kTwoByThree, "", {}, {}},
    {kTwoByThree,
     "<exclude exponent=\"16, 1024\" model=\"phong_rdf\"/><exclude exponent=\"128\"/>",
     {{{"model", {"phong_rdf"}}, {"exponent", {"16", "1024"}}}, {{"exponent", {"128"}}}},
     {}},
    {kTwoByThree,
     "<include model=\"blinn_phong_rdf\" exponent=\"16\"/><include model=\"phong_rdf\" "
     "exponent=\"2048\"/><include model=\"blinn_phong_rdf\" exponent=\"2048\"/>",
     {},
     {{{"model", "blinn_phong_rdf"}, {"exponent", "16"}},
      {{"model", "phong_rdf"}, {"exponent", "2048"}},
      {{"model", "blinn_phong_rdf"}, {"exponent", "2048"}}}},
    {kTwoByThree,
     "<include model=\"phong_rdf\" exponent=\"128\"/><exclude model=\"phong_rdf\"/>",
     {{{"model", {"phong_rdf"}}}},
     {{{"model", "phong_rdf"}, {"exponent", "128"}}}},
    {kScene + kList + axis("lobe", "cosine, cs16"),
     "<exclude model=\"phong_rdf\" lobe=\"cs16\"/>"
     "<include model=\"modified_phong\" exponent=\"128\" lobe=\"cosine\"/>",
     {{{"model", {"phong_rdf"}}, {"lobe", {"cs16"}}}},
     {{{"model", "modified_phong"}, {"exponent", "128"}, {"lobe", "cosine"}}}},
    {kScene + kOtherList + axis("normalisation", "exact, paper") + kList +
         axis("engine", "povray, analytic"),
     "<exclude size=\"8\" engine=\"analytic\"/>",
     {{{"size", {"8"}}, {"engine", {"analytic"}}}},
     {}},
};

Values values_of(const Cell& cell) { return {cell.axes.begin(), cell.axes.end()}; }

TEST(CellsOfEveryGrid, AreTheProductWithExclusionsPlusInclusions) {
  ASSERT_FALSE(kCatalogue.empty());
  for (const auto& grid : kCatalogue) {
    std::vector<Values> expected;
    for (const auto& cell : cells_of(grid_of(grid.product))) {
      const Values values = values_of(cell);
      const bool excluded =
          std::any_of(grid.excluded.begin(), grid.excluded.end(), [&](const auto& exclusion) {
            return std::all_of(exclusion.begin(), exclusion.end(), [&](const auto& axis) {
              return axis.second.contains(values.at(axis.first));
            });
          });
      if (!excluded) expected.push_back(values);
    }
    expected.insert(expected.end(), grid.included.begin(), grid.included.end());
    std::vector<Values> found;
    // Choices may stand before their axes.
    for (const auto& cell : cells_of(grid_of(grid.choices + grid.product)))
      found.push_back(values_of(cell));
    EXPECT_EQ(found, expected) << grid.choices;
  }
}

TEST(CellsOfEveryGrid, HaveStableUniqueIdsForFileNames) {
  for (const auto& entry : kCatalogue) {
    const Grid grid = grid_of(entry.product + entry.choices);
    const auto cells = cells_of(grid), again = cells_of(grid_of(entry.product + entry.choices));
    EXPECT_EQ(cells.size(), grid.cell_count());
    ASSERT_EQ(cells.size(), again.size());
    std::set<std::string> ids;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Cell& cell = cells[i];
      EXPECT_TRUE(ids.insert(cell.id).second) << cell.id;
      EXPECT_THAT(cell.id, testing::MatchesRegex("[A-Za-z0-9_+][A-Za-z0-9_.+-]*"));
      EXPECT_EQ(cell.id, again[i].id);
      ASSERT_EQ(cell.at.size(), grid.axes.size());
      for (std::size_t a = 0; a < grid.axes.size(); ++a) {
        EXPECT_EQ(cell.axes[a].first, grid.axes[a].name);
        EXPECT_EQ(cell.axes[a].second, grid.axes[a].values.at(cell.at[a]).value);
      }
    }
  }
}

TEST(CellsOfEveryGrid, AreComparedWithEnginesOfTheGrid) {
  for (const auto& entry : kCatalogue) {
    const Grid grid = grid_of(entry.product + entry.choices);
    const std::set<std::string> all(grid.engines.begin(), grid.engines.end());
    std::set<std::string> used;
    for (const auto& cell : cells_of(grid)) {
      for (const auto& [name, value] : cell.axes)
        if (name == "engine") {
          EXPECT_THAT(cell.engines, ElementsAre(value));
        }
      used.insert(cell.engines.begin(), cell.engines.end());
    }
    EXPECT_EQ(used, all);
  }
  EXPECT_THAT(grid_of(kCatalogue.back().product).engines, ElementsAre("povray", "analytic"));
  const Grid grid = grid_of(kTwoByThree + "<engine name=\"povray\"/><engine name=\"analytic\"/>");
  for (const auto& cell : cells_of(grid))
    EXPECT_THAT(cell.engines, ElementsAre("povray", "analytic"));
}

TEST(Cells, AdvanceTogetherInAListWithTheLastFactorFastest) {
  std::vector<std::string> ids;
  for (const auto& cell : cells_of(grid_of(kScene + kOtherList + kList))) ids.push_back(cell.id);
  EXPECT_THAT(ids, ElementsAre("8x8-spp4-phong_rdf-n16", "8x8-spp4-phong_rdf-n128",
                               "8x8-spp4-modified_phong-n16", "16x4-spp9-phong_rdf-n16",
                               "16x4-spp9-phong_rdf-n128", "16x4-spp9-modified_phong-n16"));
}

TEST(Cells, ShowTheValuesOfTheirAxes) {
  const Grid grid =
      grid_of(axis("size", "7x9, 5") + axis("lobe", "cosine, cs16") + axis("samples", "1, 65536") +
              axis("normalisation", "exact, paper") + axis("engine", "povray, blender") +
              axis("model", "phong_rdf, modified_phong") + axis("exponent", "16, 2.5") +
              axis("light", kSceneFiles + "point_light.xml, " + kSceneFiles + "two_lights.xml") +
              axis("scene", kSceneFiles + "two_spheres.xml, " + kSceneFiles + "grazing_80.xml"));
  const auto cells = cells_of(grid);
  EXPECT_EQ(cells.size(), 512u);
  for (const auto& cell : cells) {
    const Scene scene = scene_of(grid, cell);
    auto values = values_of(cell);
    const Scene start = read_scene(values["scene"]);
    EXPECT_EQ(scene.camera.origin.x, start.camera.origin.x);
    EXPECT_EQ(scene.spheres.size(), start.spheres.size());
    EXPECT_EQ(scene.lights.size(), read_scene(values["light"]).lights.size());
    EXPECT_EQ(scene.film.width, values["size"] == "5" ? 5 : 7);
    EXPECT_EQ(scene.film.height, values["size"] == "5" ? 5 : 9);
    EXPECT_EQ(scene.sampler.sample_count, std::stoi(values["samples"]));
    ASSERT_FALSE(scene.materials.empty());
    for (const auto& material : scene.materials) {
      const Highlight& h = material.highlight;
      EXPECT_EQ(info(h.model).name, values["model"]);
      EXPECT_EQ(info(h.lobe).name, values["lobe"]);
      EXPECT_EQ(name(h.normalisation), values["normalisation"]);
      EXPECT_EQ(h.exponent, std::stod(values["exponent"]));
    }
  }
}

TEST(Cells, KeepTheLobeOfTheSceneUnderABareNormalisation) {
  const Grid grid = grid_of(kScene + axis("normalisation", "paper, cs16:exact"));
  const auto cells = cells_of(grid);
  const auto lobe = read_scene(kSceneFiles + "head_on.xml").materials.at(0).highlight.lobe;
  ASSERT_NE(info(lobe).name, "cs16");
  EXPECT_EQ(scene_of(grid, cells[0]).materials.at(0).highlight.lobe, lobe);
  EXPECT_EQ(name(scene_of(grid, cells[0]).materials.at(0).highlight.normalisation), "paper");
  EXPECT_EQ(info(scene_of(grid, cells[1]).materials.at(0).highlight.lobe).name, "cs16");
}

TEST(Cells, HaveTheSizeOfTheFilmOnAnAxisOfScenes) {
  const Grid grid =
      grid_of("<film width=\"7\" height=\"9\"/>" + axis("exponent", "16") +
              axis("scene", kSceneFiles + "head_on.xml") + "<include exponent=\"16\" scene=\"" +
              kSceneFiles + "two_spheres.xml\"/>");
  const auto cells = cells_of(grid);
  ASSERT_EQ(cells.size(), 2u);
  for (const auto& cell : cells) {
    EXPECT_EQ(scene_of(grid, cell).film.width, 7);
    EXPECT_EQ(scene_of(grid, cell).film.height, 9);
  }
}

TEST(Cells, GiveTheSameScenesToEveryThread) {
  const Grid grid = grid_of(axis("scene", kSceneFiles + "head_on.xml") +
                            axis("exponent", numbers(200)) + axis("size", "8, 9"));
  const auto cells = cells_of(grid);
  std::vector<std::string> texts(cells.size());
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
    texts[i] = scene_to_xml(scene_of(grid, cells[i]));
  });
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_EQ(texts[i], scene_to_xml(scene_of(grid, cells[i])));
  EXPECT_EQ(std::set<std::string>(texts.begin(), texts.end()).size(), cells.size());
}

TEST(TheLargestGrid, HasAMillionCellsAndNotOneMore) {
  const std::string body = kScene + axis("exponent", numbers(10000)) +
                           axis("samples", numbers(100)) + "<exclude samples=\"100\"/>";
  const Grid grid = grid_of(body);
  EXPECT_EQ(grid.cell_count(), 990000u);
  EXPECT_EQ(cells_of(grid).back().id, "n10000-spp99");
  const std::string million = kScene + axis("exponent", numbers(5000));
  EXPECT_THAT(error_of(million + axis("samples", numbers(201))),
              testing::HasSubstr("over 1000000 cells; allowed: 1000000"));
  EXPECT_THAT(error_of(million + axis("samples", numbers(200)) +
                       "<include exponent=\"1.5\" samples=\"1\"/>"),
              testing::HasSubstr("over 1000000 cells; allowed: 1000000"));
}

}  // namespace
}  // namespace lobelia

#include <oneapi/tbb/parallel_for.h>

#include "base/pictures/image_io.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/farm/grid_text.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(SphereGrid, HasEveryModelNormalisationExponentAndLight) {
  const Grid grid = read_grid(LOBELIA_SOURCE_DIR "/reference_scenes/grids/sphere_grid.xml");
  EXPECT_EQ(grid.cell_count(), 6u * 3 * 3 * 2);
  std::set<std::string> all;
  for (const EngineInfo& engine : engine_infos()) all.emplace(engine.name);
  EXPECT_EQ(std::set<std::string>(grid.engines.begin(), grid.engines.end()), all);
}

TEST(Grid, HasNoSceneThatIsLitByAPicture) {
  const TemporaryDirectory directory;
  write_exr(directory.path() / "sky.exr", Image(2, 1), {});
  write_file(
      directory.path() / "s.xml",
      std::string_view(
          "<scene version=\"1\"><sensor type=\"perspective\"><float name=\"fov\" value=\"28\"/>"
          "<transform name=\"to_world\"><lookat origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/>"
          "</transform></sensor><emitter type=\"envmap\">"
          "<string name=\"filename\" value=\"sky.exr\"/></emitter></scene>"));
  const std::string file = (directory.path() / "s.xml").string();
  EXPECT_THAT(error_of("<scene file=\"" + file + "\"/>" + axis("exponent", "16")),
              testing::HasSubstr("takes light from the picture 'sky.exr'"));
  for (const char* name : {"light", "scene"})
    EXPECT_THAT(error_of(kScene + axis(name, file)),
                testing::HasSubstr("takes light from the picture 'sky.exr'"));
}

TEST(Grid, LeavesTheFilterToTheScene) {
  const TemporaryDirectory directory;
  write_file(
      directory.path() / "s.xml",
      std::string_view(
          "<scene version=\"1\"><sensor type=\"perspective\"><float name=\"fov\" value=\"28\"/>"
          "<transform name=\"to_world\"><lookat origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/>"
          "</transform><film type=\"hdrfilm\"><rfilter type=\"tent\"/></film></sensor></scene>"));
  const Film film = grid_of("<scene file=\"" + (directory.path() / "s.xml").string() +
                            "\"/><film width=\"7\" height=\"9\"/>" + axis("exponent", "16"))
                        .scene.film;
  EXPECT_EQ(film.width, 7);
  EXPECT_EQ(film.height, 9);
  EXPECT_EQ(film.filter, find_filter("tent"));
}

TEST(GridFormat, HasExamplesWithTheStatedNumberOfCells) {
  const std::string page =
      read_file(std::string(LOBELIA_SOURCE_DIR) + "/docs/grid_format.md", 1 << 20);
  std::vector<std::size_t> counts;
  for (auto at = page.find("```xml"); at != page.npos; at = page.find("```xml", at + 1)) {
    std::string text = page.substr(at + 6, page.find("```", at + 6) - at - 6);
    for (auto file = text.find("../scenes/"); file != text.npos; file = text.find("../scenes/"))
      text.replace(file, 10, kSceneFiles);
    const TemporaryDirectory directory;
    write_file(directory.path() / "g.xml", text);
    const Grid grid = read_grid(directory.path() / "g.xml");
    counts.push_back(cells_of(grid).size());
  }
  EXPECT_EQ(counts, (std::vector<std::size_t>{4, 48 - 16 - 12 + 4 + 1}));
  EXPECT_THAT(page, testing::HasSubstr("25 cells remain"));
  EXPECT_THAT(page, testing::HasSubstr(std::to_string(kMaxCells) + " cells together"));
}

TEST(GridReader, ExplainsEveryError) {
  const std::pair<const char*, const char*> bad[] = {
      {"<axis name=\"modle\" values=\"a\"/>",
       "unknown axis 'modle'; allowed: scene, model, lobe, normalisation, exponent, roughness, light, angle, samples, "
       "size, engine; did you mean 'model'?"},
      {"<axis name=\"model\" values=\"phong\"/>", "unknown model 'phong'; allowed: phong_rdf"},
      {"<axis name=\"normalisation\" values=\"cs16\"/>",
       "'cs16' is neither a normalisation (exact, paper) nor LOBE:NORMALISATION, as cs16:paper is"},
      {"<axis name=\"normalisation\" values=\"papre\"/>", "did you mean 'paper'?"},
      {"<axis name=\"lobe\" values=\"cosin\"/>", "unknown lobe 'cosin'; allowed: "},
      {"<axis name=\"samples\" values=\"0\"/>",
       "samples '0'; allowed: whole numbers from 1 to 65536"},
      {"<axis name=\"samples\" values=\"65537\"/>", "samples '65537'; allowed"},
      {"<axis name=\"samples\" values=\"1.5\"/>", "samples '1.5'; allowed"},
      {"<axis name=\"size\" values=\"0x9\"/>",
       "size '0x9'; allowed: 256 or 320x240, each side from 1 to 32768, "},
      {"<axis name=\"size\" values=\"9x\"/>", "size '9x'; allowed"},
      {"<axis name=\"size\" values=\"9x9x9\"/>", "size '9x9x9'; allowed"},
      {"<axis name=\"size\" values=\"32769x1\"/>", "size '32769x1'; allowed"},
      {"<axis name=\"size\" values=\"32768\"/>", "size '32768'; allowed"},
      {"<axis name=\"size\" values=\"256, 256x256\"/>", "would have the same file name"},
      {"<axis name=\"engine\" values=\"blendr\"/>",
       "unknown engine 'blendr'; allowed: povray, blender, tachyon, sunflow, three, babylon, opengl, analytic; did you mean 'blender'?"},
      {"<axis name=\"scene\" values=\"missing.xml\"/>", "missing.xml: cannot read"},
      {"<axis name=\"normalisation\" values=\"cs16:papr\"/>", "did you mean 'paper'?"},
      {"<axis name=\"exponent\" values=\"16, -3\"/>", "exponent '-3'; allowed: 0 to 1e+08"},
      {"<axis name=\"exponent\" values=\"16, nan\"/>", "exponent 'nan'; allowed"},
      {"<axis name=\"exponent\" values=\"16, 16\"/>", "'16' stands twice on the axis"},
      {"<axis name=\"exponent\" values=\"16, 16.0\"/>", "would have the same file name"},
      {"<axis name=\"exponent\" values=\" , \"/>", "has no values; allowed: numbers"},
      {"<axis name=\"exponent\" values=\"1\"/><axis name=\"exponent\" values=\"2\"/>",
       "a second axis 'exponent'"},
      {"<engine name=\"povry\"/>",
       "unknown engine 'povry'; allowed: povray, blender, tachyon, sunflow, three, babylon, opengl, analytic; did you mean "
       "'povray'?"},
      {"<film width=\"0\" height=\"9\"/>", "width '0'; allowed: whole numbers from 1 to 32768"},
      {"<film width=\"32768\" height=\"32768\"/>", "pixels; allowed: "},
      {"<axes/>", "unknown element <axes> in <grid>"},
  };
  for (const auto& [body, message] : bad) {
    const std::string error = error_of(kScene + body);
    EXPECT_THAT(error, testing::HasSubstr(message));
    EXPECT_THAT(error, testing::HasSubstr("g.xml:1:"));
  }
  EXPECT_THAT(error_of("<axis name=\"exponent\" values=\"1\"/>"),
              testing::HasSubstr("the grid has no <scene"));
  EXPECT_THAT(error_of(kScene), testing::HasSubstr("the grid has no <axis>"));
}

TEST(GridReader, TakesOnlyAnAddressOfTheWebForThatOfAStudy) {
  const std::string body = kScene + axis("exponent", "16");
  EXPECT_EQ(grid_of(body, " url=\"https://example.org/a\"").url, "https://example.org/a");
  for (const std::string url : {"javascript://example.org", "example.org", "ftp://example.org"})
    EXPECT_THAT(error_of(body, " url=\"" + url + "\""),
                testing::HasSubstr("allowed: an address that begins with https://"));
}

TEST(GridReader, ListsTheChoicesForAWrongOne) {
  const std::string axes = kScene + axis("model", "phong_rdf, modified_phong, blinn_phong_rdf") +
                           axis("exponent", "16, 128");
  const std::pair<const char*, const char*> bad[] = {
      {"<exclude modle=\"phong_rdf\"/>",
       "<exclude> has no attribute 'modle'; allowed: model, exponent; did you mean 'model'?"},
      {"<exclude/>", "<exclude> names no axis; allowed: model, exponent"},
      {"<exclude exponent=\"\"/>", "no value of the axis 'exponent'"},
      {"<exclude exponent=\"1024\"/>",
       "the <exclude> matches no cell: '1024' is not on the axis 'exponent'; there are: 16, 128"},
      {"<exclude model=\"modified_phon\"/>", "did you mean 'modified_phong'?"},
      {"<exclude exponent=\"16, 128\"/>", "no cell is left"},
      {"<include model=\"phong_rdf\"/>", "<include> needs the attribute 'exponent'"},
      {"<include model=\"phong_rdf\" exponent=\"\"/>", "'' is not one value"},
      {"<include model=\"phong_rdf\" exponent=\"512\" lobe=\"cosine\"/>",
       "<include> has no attribute 'lobe'; allowed: model, exponent"},
      {"<include model=\"phong_rdf\" exponent=\"-1\"/>", "exponent '-1'; allowed: 0 to 1e+08"},
      {"<include model=\"phong_rdf\" exponent=\"512, 513\"/>", "'512, 513' is not one value"},
      {"<include model=\"phong_rdf\" exponent=\"16.0\"/>",
       "'16.0' would have the same file name as another value of the axis 'exponent'"},
      {"<include model=\"phong_rdf\" exponent=\"16\"/>",
       "the cell 'phong_rdf-n16' is there already"},
      {"<include model=\"phong_rdf\" exponent=\"5\"/><include model=\"phong_rdf\" exponent=\"5\"/>",
       "the cell 'phong_rdf-n5' is there already"},
  };
  for (const auto& [body, message] : bad) {
    const std::string error = error_of(axes + body);
    EXPECT_THAT(error, testing::HasSubstr(message));
    EXPECT_THAT(error, testing::HasSubstr("g.xml:1:"));
    EXPECT_EQ(error.find('\n'), error.npos) << error;
  }
  EXPECT_THAT(error_of(kScene + "<list>" + axis("model", "phong_rdf, modified_phong") +
                       axis("exponent", "16, 128") +
                       "</list><exclude model=\"phong_rdf\" exponent=\"128\"/>"),
              testing::HasSubstr("the <exclude> matches no cell: the values never stand together"));
}

TEST(GridReader, ListsAllowedValuesForEveryWrongAxis) {
  const std::pair<std::string, const char*> bad[] = {
      {"<list/>" + axis("size", "8"), "the <list> has no <axis>"},
      {"<list name=\"a\">" + axis("size", "8") + "</list>", "<list> has no attribute 'name'"},
      {"<list>" + axis("size", "8") + "<film/></list>",
       "unknown element <film> in <list>; allowed: axis"},
      {"<list>" + axis("size", "8, 9") + axis("samples", "1, 2, 3") + "</list>",
       "3 values beside the 2 of the axis 'size'"},
      {"<list>" + axis("size", "8, 9, 8") + axis("samples", "1, 2, 1") + "</list>",
       "the values of step 3 of the <list> stand there twice"},
      {"<list>" + axis("size", "8") + "</list>" + axis("size", "9"), "a second axis 'size'"},
      {axis("lobe", "cosine") + axis("normalisation", "exact, cs16:paper"),
       "LOBE:NORMALISATION 'cs16:paper' beside an axis 'lobe'; allowed there: exact, paper"},
      {axis("lobe", "cosine") + axis("normalisation", "exact") +
           "<include lobe=\"cosine\" normalisation=\"cs16:exact\"/>",
       "LOBE:NORMALISATION 'cs16:exact' beside an axis 'lobe'"},
      {axis("size", "8") + "<film width=\"8\" height=\"8\"/>",
       "an axis 'size' beside a <film>; allowed: one of them"},
      {axis("engine", "povray") + "<engine name=\"povray\"/>",
       "an axis 'engine' beside <engine>; allowed: one of them"},
  };
  for (const auto& [body, message] : bad) {
    const std::string error = error_of(kScene + body);
    EXPECT_THAT(error, testing::HasSubstr(message));
    EXPECT_EQ(error.find('\n'), error.npos) << error;
  }
}

TEST(GridReader, RefusesCellsWhoseNamesAreTheSameOrTooLong) {
  const TemporaryDirectory directory;
  const std::string scene = read_file(kSceneFiles + "head_on.xml", 1 << 20);
  const auto file = [&](const std::string& name) {
    write_file(directory.path() / (name + ".xml"), scene);
    return (directory.path() / (name + ".xml")).string();
  };
  EXPECT_THAT(error_of(axis("scene", file("a") + " " + file("a-b")) +
                       axis("light", file("b-c") + " " + file("c"))),
              testing::HasSubstr("two cells would be called 'a-b-c'"));
  const std::string longest(kMaxIdBytes - 4, 'a');
  EXPECT_EQ(cells_of(grid_of(axis("scene", file(longest)) + axis("exponent", "16")))[0].id.size(),
            kMaxIdBytes);
  EXPECT_THAT(error_of(axis("scene", file(longest)) + axis("exponent", "16, 128")),
              testing::HasSubstr("has a name of 201 bytes; allowed: 200"));
  const auto cells = cells_of(grid_of(axis("scene", file("-rf") + " " + file(".hidden"))));
  EXPECT_EQ(cells[0].id, "_rf");
  EXPECT_EQ(cells[1].id, "_hidden");
}

TEST(GridReader, TellsNamesInOtherAlphabetsApart) {
  const TemporaryDirectory directory;
  const std::string scene = read_file(kSceneFiles + "head_on.xml", 1 << 20);
  std::string names;
  for (const char* name : {"日本語.xml", "中国語.xml", "___.xml"}) {
    write_file(directory.path() / name, scene);
    names += (directory.path() / name).string() + " ";
  }
  const auto cells = cells_of(grid_of(axis("scene", names)));
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_NE(cells[0].id, cells[1].id);
  EXPECT_EQ(cells[2].id, "___");
}

TEST(GridReader, BoundsTheSizeOfAHostileGrid) {
  EXPECT_THAT(error_of(kScene + axis("exponent", numbers(10001))),
              testing::HasSubstr("over 10000 values on the axis 'exponent'; allowed: 10000"));
  std::string exclude;
  for (int i = 0; i < 300; ++i) exclude += "<exclude samples=\"1, 2\"/>";
  EXPECT_THAT(error_of(kScene + axis("exponent", numbers(10000)) + axis("samples", "1, 2, 3, 4") +
                       exclude + exclude + exclude + exclude),
              testing::HasSubstr("the <exclude> elements name over 20000000 cells together"));
  std::string wrong;
  for (int i = 0; i < 20000; ++i) wrong += "<exclude samples=\"9\"/><include samples=\"0\"/>";
  EXPECT_THAT(error_of(kScene + axis("exponent", numbers(5000)) + axis("samples", "1") + wrong),
              testing::HasSubstr("further errors"));
  const std::string crowd = "<scene file=\"" + kSceneFiles + "effects/crowd.xml\"/>";
  EXPECT_THAT(error_of(crowd + axis("exponent", numbers(10000)) + axis("samples", numbers(100))),
              testing::HasSubstr("shapes, materials and lights in all; allowed: 100000000"));
}

// Which cells a grid has, and what each shows.

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

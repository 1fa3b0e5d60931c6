#include "farm/grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"

namespace lobelia {
namespace {

const std::string kGrids = std::string(LOBELIA_SOURCE_DIR) + "/reference_scenes/grids/";
const std::string kScene =
    "<scene file=\"" + std::string(LOBELIA_SOURCE_DIR) + "/reference_scenes/scenes/head_on.xml\"/>";

std::string error_of(const std::string& body) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "g.xml";
  write_file(path, "<grid version=\"1\">" + body + "</grid>");
  try {
    read_grid(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    return error.what();
  }
  return "it was read";
}

TEST(SphereGrid, HasEveryModelNormalisationExponentAndLight) {
  const Grid grid = read_grid(kGrids + "sphere_grid.xml");
  const auto cells = cells_of(grid);
  EXPECT_EQ(cells.size(), 6u * 3 * 3 * 2);
  std::set<std::string> ids;
  for (const auto& cell : cells) ids.insert(cell.id);
  EXPECT_EQ(ids.size(), cells.size());
  EXPECT_EQ(grid.engines, (std::vector<std::string>{"analytic", "povray", "blender"}));
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
  const std::string axis = "<axis name=\"exponent\" values=\"16\"/>";
  EXPECT_THAT(error_of("<scene file=\"" + file + "\"/>" + axis),
              testing::HasSubstr("takes light from the picture 'sky.exr'"));
  EXPECT_THAT(error_of(kScene + "<axis name=\"light\" values=\"" + file + "\"/>"),
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
  write_file(
      directory.path() / "g.xml",
      std::string_view("<grid version=\"1\"><scene file=\"s.xml\"/><film width=\"7\" height=\"9\"/>"
                       "<axis name=\"exponent\" values=\"16\"/></grid>"));
  const Film film = read_grid(directory.path() / "g.xml").scene.film;
  EXPECT_EQ(film.width, 7);
  EXPECT_EQ(film.height, 9);
  EXPECT_EQ(film.filter, find_filter("tent"));
}

TEST(Cells, CarryTheValuesOfTheirAxesIntoTheScene) {
  for (const auto& cell : cells_of(read_grid(kGrids + "sphere_grid.xml"))) {
    const Highlight& h = cell.scene.materials.at(0).highlight;
    for (const auto& [axis, value] : cell.axes) {
      if (axis == "model") {
        EXPECT_EQ(info(h.model).name, value);
      } else if (axis == "exponent") {
        EXPECT_EQ(h.exponent, std::stod(value));
      } else if (axis == "normalisation") {
        EXPECT_EQ(std::string(info(h.lobe).name) + ":" + std::string(name(h.normalisation)), value);
      } else {
        EXPECT_EQ(axis, "light");
        EXPECT_EQ(std::holds_alternative<PointLight>(cell.scene.lights.at(0)),
                  value.find("point_light") != value.npos);
      }
    }
    EXPECT_THAT(cell.id, testing::MatchesRegex("[A-Za-z0-9_.+-]+"));
  }
}

TEST(GridReader, SaysOfEveryErrorWhereItIsAndWhatWasAllowed) {
  const std::pair<const char*, const char*> bad[] = {
      {"<axis name=\"modle\" values=\"a\"/>",
       "unknown axis 'modle'; allowed: model, normalisation, "
       "exponent, light; did you mean 'model'?"},
      {"<axis name=\"model\" values=\"phong\"/>", "unknown model 'phong'; allowed: phong_rdf"},
      {"<axis name=\"normalisation\" values=\"cs16\"/>", "'cs16' is not LOBE:NORMALISATION"},
      {"<axis name=\"normalisation\" values=\"cs16:papr\"/>", "did you mean 'paper'?"},
      {"<axis name=\"exponent\" values=\"16, -3\"/>", "exponent '-3'; allowed: 0.001 to 1e+08"},
      {"<axis name=\"exponent\" values=\"16, nan\"/>", "exponent 'nan'; allowed"},
      {"<axis name=\"exponent\" values=\"16, 16\"/>", "'16' stands twice on the axis"},
      {"<axis name=\"exponent\" values=\"16, 16.0\"/>", "would have the same file name"},
      {"<axis name=\"light\" values=\"missing.xml\"/>", "missing.xml: cannot read"},
      {"<axis name=\"exponent\" values=\" , \"/>", "has no values; allowed: numbers"},
      {"<axis name=\"exponent\" values=\"1\"/><axis name=\"exponent\" values=\"2\"/>",
       "a second axis 'exponent'"},
      {"<engine name=\"povry\"/>",
       "unknown engine 'povry'; allowed: povray, blender, analytic; did you mean "
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

TEST(GridReader, RefusesMoreCellsThanItCouldEverRender) {
  std::string values;
  for (int i = 1; i <= 9000; ++i) values += std::to_string(i) + " ";
  EXPECT_THAT(error_of(kScene + "<axis name=\"exponent\" values=\"" + values +
                       "\"/><axis name=\"model\" values=\"phong_rdf modified_phong blinn_phong_rdf "
                       "modified_blinn_phong\"/><axis name=\"normalisation\" values=\"cosine:exact "
                       "cs16:exact cs16:paper\"/>"),
              testing::HasSubstr("over 100000 cells"));
}

}  // namespace
}  // namespace lobelia

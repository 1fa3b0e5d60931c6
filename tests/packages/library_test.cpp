// The public library, as a project elsewhere sees it: the installed tree, CMake and pkg-config.
#include <regex>

#include "tests/packages/installed_tree.hpp"
#include "tests/test.hpp"

namespace packages {
namespace {

using ::testing::HasSubstr;

const std::string kSource = LOBELIA_SOURCE_DIR;
const std::string kLibraries =
    "for p in \"$PREFIX\"/lib \"$PREFIX\"/lib/*/; do "
    "[ ! -e \"$p/liblobelia.so\" ] || libraries=${p%/}; done; ";

/// Ran in the directory of the build, with the library found there.
void expect_example_works(const std::string& program) {
  const Ran ran =
      installed_tree().shell(program + " \"$PREFIX/share/lobelia/scenes/oblique_45.xml\"");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_THAT(ran.output, HasSubstr("verdict: differs"));
  EXPECT_THAT(ran.output, HasSubstr("max_rel_peak"));
  EXPECT_THAT(ran.output, HasSubstr("highlight at "));
  // Every lobe of the catalogue that the program lists.
  const Ran listed = installed_tree().shell("lobelia models");
  static const std::regex line("\n(\\S+) at 10 degrees: (\\S+)");
  int count = 0;
  for (std::sregex_iterator it(ran.output.begin(), ran.output.end(), line), end; it != end; ++it) {
    ++count;
    EXPECT_THAT(listed.output, HasSubstr("\n" + (*it)[1].str() + " "));
  }
  EXPECT_GT(count, 0);
  const Ran missing = installed_tree().shell(program + " missing.xml");
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.output, HasSubstr("missing.xml"));
}

TEST(Library, ExampleBuildsByCmakeAndRuns) {
  const InstalledTree& tree = installed_tree();
  fs::copy(kSource + "/docs/examples/cpp", tree.work() / "example", fs::copy_options::recursive);
  const Ran built = tree.shell(
      "cmake -S example -B 'by cmake' -DCMAKE_PREFIX_PATH=\"$PREFIX\" && cmake --build 'by cmake'");
  ASSERT_EQ(built.exit_code, 0) << built.output;
  expect_example_works("'by cmake/highlight'");
}

TEST(Library, ExampleBuildsByPkgConfigAndRuns) {
  fs::copy_file(kSource + "/docs/examples/cpp/highlight.cpp",
                installed_tree().work() / "example.cpp");
  // pkg-config escapes a path for the shell.
  const Ran built = installed_tree().shell(
      kLibraries +
      "export PKG_CONFIG_PATH=\"$libraries/pkgconfig\"; eval \"c++ -std=c++17 -Wall "
      "-Wextra -Wpedantic -Werror $(pkg-config --cflags lobelia) example.cpp "
      "-o by_pkg_config $(pkg-config --libs lobelia)\"");
  ASSERT_EQ(built.exit_code, 0) << built.output;
  expect_example_works(kLibraries + "LD_LIBRARY_PATH=$libraries ./by_pkg_config");
}

TEST(Library, HeaderIncludesTheStandardLibraryAlone) {
  const fs::path headers = installed_tree().prefix() / "include/lobelia";
  static const std::regex include(R"re(#\s*include\s*([<"][^>"]+[>"]))re");
  int files = 0;
  for (const auto& entry : fs::directory_iterator(headers)) {
    ++files;
    const std::string text = read(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it)
      EXPECT_TRUE((*it)[1] == "\"lobelia/version.hpp\"" ||
                  std::regex_match((*it)[1].str(), std::regex("<[a-z_]+>")))
          << (*it)[1];
  }
  EXPECT_EQ(files, 4) << "the library, its version, and two headers to copy";
}

TEST(Library, ExportsItsOwnNamesAlone) {
  const Ran ran = installed_tree().shell(
      kLibraries + "nm --dynamic --demangle --defined-only \"$libraries/liblobelia.so\"");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  int count = 0;
  for (const std::string& line : house::lines(ran.output)) {
    if (line.empty()) continue;
    ++count;
    EXPECT_THAT(line, HasSubstr(" lobelia::v0::")) << line;
  }
  EXPECT_GT(count, 15);
  const Ran soname =
      installed_tree().shell(kLibraries + "readelf --dynamic \"$libraries/liblobelia.so\"");
  EXPECT_TRUE(
      std::regex_search(soname.output, std::regex("SONAME.*\\[liblobelia\\.so\\.[0-9]+\\]")));
}

/// Compiled against the installed tree, because a test must not link our rooms and the library together.
TEST(Library, ReportsErrorsAndJudgesAsDocumented) {
  write(installed_tree().work() / "contract.cpp", R"(
#include <lobelia/lobelia.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <thread>
static int failed = 0;
#define CHECK(what) ((what) ? 0 : (failed = 1, std::printf("line %d: %s\n", __LINE__, #what)))
template <class F> int code(F f) {
  try { f(); } catch (const lobelia::Error& e) { return *e.what() ? int(e.code()) : -1; }
  return 0;
}
using namespace lobelia;
int main(int, char** argv) {
  const std::string scene = argv[1];
  CHECK(version() == LOBELIA_VERSION);
  CHECK(code([&] { render("missing.xml"); }) == 3);
  CHECK(code([&] { render_text("<scene"); }) == 3);
  CHECK(code([&] { read_picture("missing.exr"); }) == 3);
  CHECK(code([&] { write_exr("missing/a.exr", {1, 1, {0, 0, 0}}); }) == 4);
  CHECK(code([&] { write_exr("a.exr", {2, 1, {0, 0, 0}}); }) == 2);
  RenderSettings settings;
  settings.model = "fong";
  CHECK(code([&] { render(scene, settings); }) == 2);
  settings = {};
  settings.width = 0;
  CHECK(code([&] { render(scene, settings); }) == 2);
  settings.width = 48, settings.height = 32, settings.threads = 1;
  const Rendered one = render(scene, settings);
  CHECK(one.picture.width == 48 && one.picture.height == 32 && one.picture.rgb.size() == 48 * 32 * 3);
  settings.threads = 2;
  double most = 0;
  settings.on_progress = [&](double fraction) { if (fraction > most) most = fraction; };
  CHECK(render(scene, settings).picture.rgb == one.picture.rgb);
  CHECK(most > 0 && most <= 1);
  settings.on_progress = [](double) { throw 7; };
  try { render(scene, settings); CHECK(false); } catch (int thrown) { CHECK(thrown == 7); }
  write_exr("one.exr", one.picture);
  CHECK(read_picture("one.exr").rgb == one.picture.rgb);
  const Comparison same = compare(one.picture, one.picture);
  CHECK(same.pass && same.verdict == "pass" && same.value("rmse") == 0);
  CHECK(std::isnan(same.value("no_metric")) && same.record.find("\"comparison\"") != std::string::npos);
  Picture other = one.picture;
  for (float& value : other.rgb) value *= 1.1f;
  CHECK(!compare(other, one.picture).pass);
  CompareSettings loose;
  loose.default_limits = false;
  CHECK(code([&] { compare(other, one.picture, loose); }) == 2);
  loose.limits = {{"max_rel_peak", 0.2}};
  const Comparison judged = compare(other, one.picture, loose);
  CHECK(judged.pass && judged.limits.size() == 1 && std::abs(judged.limits[0].value - 0.1) < 1e-3);
  loose.limits = {{"rmze", 1}};
  CHECK(code([&] { compare(other, one.picture, loose); }) == 2);
  other.rgb[0] = std::numeric_limits<float>::quiet_NaN();
  CHECK(compare(other, one.picture).verdict == "non-finite");
  CHECK(code([&] { compare({1, 1, {0, 0, 0}}, one.picture); }) == 3);
  CHECK(profile({16, 16, std::vector<float>(16 * 16 * 3)}).highlights.empty());
  CHECK(code([&] { profile(one.picture, 2); }) == 2);
  CHECK(!lobes().empty() && !models().empty() && !normalisations().empty());
  for (const Lobe& lobe : lobes()) {
    CHECK(lobe_value(lobe.name, 0, 64) == 1);
    CHECK(lobe_values(lobe.name, {0, 0.01}, 64)[1] == lobe_value(lobe.name, 0.01, 64));
    for (const Model& model : models()) CHECK(coefficient(model.name, lobe.name, 64) > 0);
  }
  CHECK(std::abs(coefficient("phong_rdf", "cosine", 64) - 65 / (2 * std::acos(-1.0))) < 1e-9);
  CHECK(code([&] { lobe_value("cosine", 3, 64); }) == 2);
  CHECK(code([&] { lobe_value("kosine", 0, 64); }) == 2);
  CHECK(code([&] { coefficient("phong_rdf", "schlick", 64, "paper"); }) == 3);
  // Several threads at once.
  int wrong[4] = {};
  std::vector<std::thread> threads;
  for (int& mine : wrong)
    threads.emplace_back([&] { mine = code([&] {
      RenderSettings small; small.width = 48; small.height = 32;
      const Rendered own = render(scene, small);
      if (!compare(own.picture, read_picture("one.exr")).pass) throw Error(ErrorCode::internal, "differs");
    }); });
  for (std::thread& thread : threads) thread.join();
  for (const int mine : wrong) CHECK(mine == 0);
  return failed;
}
)");
  const Ran ran = installed_tree().shell(
      kLibraries +
      "c++ -std=c++17 -pthread -I\"$PREFIX/include\" contract.cpp -o contract "
      "-L\"$libraries\" -llobelia && LD_LIBRARY_PATH=$libraries ./contract "
      "\"$PREFIX/share/lobelia/scenes/oblique_45.xml\"");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
}

}  // namespace
}  // namespace packages

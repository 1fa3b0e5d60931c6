// Exports for POV-Ray, in the hands of a stranger.
#include <fmt/format.h>

#include "base/pictures/image_io.hpp"
#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "base/words/text.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/export/povray.hpp"
#include "tests/reference_scenes/require_engine.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class ExportedForPovray : public testing::Test {
 protected:
  void SetUp() override { require_engine(*engine_); }

  /// Runs POV-Ray on scene.pov; leaves scene.exr.
  void run(std::string_view scene) {
    write_file(scratch_.path() / "scene.pov", scene);
    ProcessOptions options;
    options.working_directory = scratch_.path();
    const ProcessResult result = run_process({engine_->status().program.string(), "+Iscene.pov",
                                              "+Oscene.exr", "+FE", "+W32", "+H32", "-A", "-D"},
                                             options);
    ASSERT_EQ(result.exit_code, 0) << result.output_tail;
  }

  const std::unique_ptr<Engine> engine_ = make_engine("povray", {});
  TemporaryDirectory scratch_;
};

/// The scene in the comment at the head of an include file.
std::string usage_in(const std::string& include) {
  std::string scene;
  for (std::string_view rest = include; rest.starts_with("//"); rest.remove_prefix(1)) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    if (line.starts_with("//   ")) scene.append(line.substr(5)).append("\n");
    rest.remove_prefix(line.size());
  }
  return scene;
}

TEST_F(ExportedForPovray, TheSceneInItsCommentDrawsTheHighlight) {
  for (const char* model : {"modified_blinn_phong", "phong_rdf"})
    for (const char* lobe : {"cs12", "gauss"}) {
      const Highlight highlight{*find_model(model), *find_lobe(lobe)};
      const std::string include = povray_text(std::span(&highlight, 1));
      const PovrayNames names = povray_names(highlight);
      write_file(scratch_.path() / names.file, include);
      const std::string scene = usage_in(include);
      ASSERT_NE(scene.find(names.pattern), std::string::npos);
      run(scene);
      const Image picture = read_image(scratch_.path() / "scene.exr");
      const float peak = *std::max_element(picture.values().begin(), picture.values().end());
      // The highlight is nowhere brighter than its coefficient, and n = 64 covers several pixels.
      EXPECT_LE(peak, radiance_coefficient(highlight) * 1.0005) << names.pattern;
      EXPECT_GT(peak, radiance_coefficient(highlight) * 0.5) << names.pattern;
    }
}

TEST_F(ExportedForPovray, TheCoefficientsAreOursToTenDigits) {
  // Where n is tiny, Schlick's lobe drops to 0 within n of the horizon, between the quadrature's points:
  // measured 3e-5 at n = 1e-3, where every other lobe keeps its digits.
  std::string scene = "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n";
  std::string writes = "#fopen Out \"coefficients\" write\n";
  std::vector<Highlight> expected;
  std::vector<LobeId> lobes(all_lobes().begin(), all_lobes().end());
  lobes.push_back(*find_lobe("cs1024"));
  for (const LobeId& lobe : lobes)
    for (const Normalisation normalisation : {Normalisation::kExact, Normalisation::kPaper}) {
      if (normalisation == Normalisation::kPaper && !has_paper_coefficient(lobe)) continue;
      std::vector<Highlight> highlights;
      for (const ModelId model : all_models()) highlights.push_back({model, lobe, normalisation});
      const std::string file = povray_names(highlights[0]).file;
      write_file(scratch_.path() / file, povray_text(highlights));
      scene += fmt::format("#include \"{}\"\n", file);
      for (const Highlight& highlight : highlights)
        for (const double n : {1e-3, 0.1, 1.0, 64.0, 1e6}) {
          writes += fmt::format("#write(Out, str({}({}), 0, 15), \"\\n\")\n",
                                povray_names(highlight).coefficient, n);
          expected.push_back({highlight.model, lobe, normalisation, n});
        }
    }
  run(scene + writes);
  const auto lines = split(read_file(scratch_.path() / "coefficients", 1 << 20), "\n");
  ASSERT_EQ(lines.size(), expected.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    double value = 0;
    ASSERT_TRUE(parse_number(lines[i], value)) << lines[i];
    // A pattern is 1 at most, so that the highest shadowing is in the coefficient.
    const Highlight& h = expected[i];
    const double ours = radiance_coefficient(h) * largest_shadowing(h.model, h.exponent);
    EXPECT_NEAR(value / ours, 1, h.exponent < 0.1 ? 1e-4 : 1e-10)
        << povray_names(h).pattern << " n = " << h.exponent;
  }
}

}  // namespace
}  // namespace lobelia

// The layers of a multilayer EXR that Blender itself writes.
#include "base/pictures/contained_reader.hpp"
#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "tests/reference_scenes/require_engine.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

using testing::Contains;

/// Blender's own first scene.
constexpr const char* kScript = R"(
import bpy, sys
scene = bpy.context.scene
scene.render.engine = 'CYCLES'
scene.cycles.samples = 4
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y = 24, 16
scene.render.resolution_percentage = 100
layer = scene.view_layers[0]
for name in ('z', 'normal', 'diffuse_direct', 'glossy_direct', 'environment'):
    setattr(layer, 'use_pass_' + name, True)
layer.cycles.denoising_store_passes = True
scene.render.image_settings.file_format = 'OPEN_EXR_MULTILAYER'
scene.render.image_settings.color_depth = '32'
scene.render.filepath = sys.argv[-1]
bpy.ops.render.render(write_still=True)
)";

class BlenderLayers : public testing::Test {
 protected:
  void SetUp() override { require_engine(*blender_); }
  std::filesystem::path render() {
    const auto path = directory_.path() / "picture.exr";
    const auto result =
        run_process({blender_->status().program.string(), "-b", "--factory-startup",
                     "--python-exit-code", "1", "--python-expr", kScript, "--", path.string()},
                    {});
    EXPECT_EQ(result.exit_code, 0) << result.output_tail;
    return path;
  }
  std::unique_ptr<Engine> blender_ = make_engine("blender", "");
  TemporaryDirectory directory_;
};

TEST_F(BlenderLayers, AreFoundByTheNamesThatPeopleUse) {
  const auto path = render();
  EXPECT_THAT(read_picture(path, "").source.channels, Contains("ViewLayer.Combined.R"));
  EXPECT_EQ(read_picture(path, "").source.samples, 4);
  for (const auto& [name, channel] : {std::pair{"combined", "ViewLayer.Combined.G"},
                                      {"ViewLayer.Combined", "ViewLayer.Combined.G"},
                                      {"albedo", "ViewLayer.Denoising Albedo.G"},
                                      {"N", "ViewLayer.Normal.Y"},
                                      {"depth", "ViewLayer.Depth.Z"},
                                      {"diffuse_direct", "ViewLayer.DiffDir.G"},
                                      {"GlossDir", "ViewLayer.GlossDir.G"}})
    EXPECT_THAT(read_picture(path, name).source.channels, Contains(channel)) << name;
  EXPECT_THAT(error_words(ExitCode::kInput, [&] { read_picture(path, "difuse"); }),
              HasSubstr("there are 'ViewLayer.DiffDir'"));
}

}  // namespace
}  // namespace lobelia

// Displays by OpenColorIO: a configuration of which every value can be computed by hand.
#include "base/pictures/colour.hpp"

#include "base/system/files.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

// One display that says what light it gives (a power of 2 onto XYZ, so that decoding is a square), with a plain
// view and one that halves; and one of the old kind, whose views are spaces of the scene.
constexpr const char* kConfig = R"(ocio_profile_version: 2
roles: {default: raw, scene_linear: wide, cie_xyz_d65_interchange: XYZ}
displays:
  Square:
    - !<View> {name: Plain, view_transform: plain, display_colorspace: squared}
    - !<View> {name: Half, view_transform: half, display_colorspace: squared}
  Old:
    - !<View> {name: Encoded, colorspace: encoded}
view_transforms:
  - !<ViewTransform>
    name: plain
    from_scene_reference: !<MatrixTransform> {matrix: [0.4124, 0.3576, 0.1805, 0, 0.2126, 0.7152, 0.0722, 0, 0.0193, 0.1192, 0.9505, 0, 0, 0, 0, 1]}
  - !<ViewTransform>
    name: half
    from_scene_reference: !<MatrixTransform> {matrix: [0.2062, 0.1788, 0.09025, 0, 0.1063, 0.3576, 0.0361, 0, 0.00965, 0.0596, 0.47525, 0, 0, 0, 0, 1]}
display_colorspaces:
  - !<ColorSpace>
    name: XYZ
  - !<ColorSpace>
    name: squared
    from_display_reference: !<ExponentTransform> {value: [0.5, 0.5, 0.5, 1]}
    to_display_reference: !<ExponentTransform> {value: [2, 2, 2, 1]}
colorspaces:
  - !<ColorSpace> {name: raw, isdata: true}
  - !<ColorSpace>
    name: lin_rec709
    aliases: [our_linear]
  - !<ColorSpace>
    name: wide
    to_scene_reference: !<MatrixTransform> {matrix: [3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: encoded
    from_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}
)";

class DisplayViews : public ::testing::Test {
 protected:
  void SetUp() override {
    ::unsetenv("OCIO");
    config_ = (directory_.path() / "config.ocio").string();
    write_file(config_, std::string_view(kConfig));
  }
  void TearDown() override { ::unsetenv("OCIO"); }
  std::string message_of(const DisplayViewChoice& choice, ExitCode code) {
    return error_words(code, [&] { DisplayView::open(choice); });
  }
  /// A view's output for one value in red, green and blue.
  static float grey(const DisplayView& view, float value, double stops = 0) {
    Image image(1, 1);
    for (float& v : image.values()) v = value;
    const Image shown = view.shown(image, stops);
    EXPECT_NEAR(shown.values()[0], shown.values()[1], 2e-4);
    EXPECT_NEAR(shown.values()[2], shown.values()[1], 2e-4);
    return shown.values()[1];
  }
  TemporaryDirectory directory_;
  std::string config_;
};

TEST_F(DisplayViews, AreNoneWhereNobodyAskedForOne) {
  EXPECT_EQ(DisplayView::open({}), nullptr);
  EXPECT_EQ(DisplayView::open({kOwnConfig, "", "", ""}), nullptr);
  ::setenv("OCIO", "", 1);
  EXPECT_EQ(DisplayView::open({}), nullptr) << "an empty $OCIO is none";
}

TEST_F(DisplayViews, GiveTheLightThatTheConfigurationSays) {
  const auto plain = DisplayView::open({config_, "", "", ""});
  EXPECT_EQ(plain->decoded_by(), "XYZ");
  EXPECT_NEAR(grey(*plain, 0.18f), 0.18f, 1e-4);
  EXPECT_NEAR(grey(*plain, 0.18f, 2), 0.72f, 4e-4);
  EXPECT_EQ(grey(*plain, 7), 1.0f);
  EXPECT_EQ(grey(*plain, -7), 0.0f);
  EXPECT_NEAR(grey(*DisplayView::open({config_, "Square", "Half", ""}), 0.18f), 0.09f, 1e-4);
}

TEST_F(DisplayViews, AreDecodedAsSrgbInAnOlderConfiguration) {
  const auto old = DisplayView::open({config_, "Old", "", ""});
  EXPECT_EQ(old->decoded_by(), "sRGB");
  EXPECT_EQ(old->choice().view, "Encoded");
  EXPECT_NEAR(grey(*old, 0.18f), 0.18f, 1e-6);
}

TEST_F(DisplayViews, TakePicturesForLinearRec709UnlessToldOtherwise) {
  EXPECT_EQ(DisplayView::open({config_, "", "", ""})->choice().input_space, "lin_rec709");
  const auto wide = DisplayView::open({config_, "", "", "scene_linear"});
  EXPECT_EQ(wide->choice().input_space, "wide") << "a role's space by its name";
  EXPECT_NEAR(grey(*wide, 0.1f), 0.3f, 1e-4);
  EXPECT_EQ(DisplayView::open({config_, "", "", "our_linear"})->choice().input_space, "lin_rec709");
}

TEST_F(DisplayViews, ComeFromTheEnvironmentUnlessAFileIsNamed) {
  ::setenv("OCIO", config_.c_str(), 1);
  EXPECT_EQ(DisplayView::open({"", "Square", "Half", ""})->choice().config, config_);
  EXPECT_EQ(DisplayView::open({kOwnConfig, "", "", ""}), nullptr);
  ::setenv("OCIO", "/nowhere/config.ocio", 1);
  EXPECT_THAT(message_of({}, ExitCode::kInput), HasSubstr("/nowhere/config.ocio ($OCIO)"));
}

TEST_F(DisplayViews, AreListedWhereAnUnknownOneIsRefused) {
  EXPECT_THAT(message_of({config_, "Squar", "", ""}, ExitCode::kUsage),
              HasSubstr("did you mean 'Square'?; it has Square, Old"));
  EXPECT_THAT(message_of({config_, "Square", "Third", ""}, ExitCode::kUsage),
              HasSubstr("it has Plain, Half"));
  EXPECT_THAT(message_of({config_, "", "", "lin_rec2020"}, ExitCode::kUsage),
              HasSubstr("lin_rec709"));
  write_file(config_, std::string_view("displays: ["));
  EXPECT_THAT(message_of({config_, "", "", ""}, ExitCode::kInput), HasSubstr(config_));
}

TEST_F(DisplayViews, MatchThePlainDisplayInOurConfiguration) {
  const auto own = DisplayView::open({kOwnConfig, "sRGB", "", ""});
  ASSERT_NE(own, nullptr);
  for (const float value : {-1.0f, 0.0f, 1e-4f, 0.003f, 0.18f, 0.9f, 1.0f, 40.0f})
    EXPECT_NEAR(grey(*own, value), std::clamp(value, 0.0f, 1.0f), 1e-6);
}

}  // namespace
}  // namespace lobelia

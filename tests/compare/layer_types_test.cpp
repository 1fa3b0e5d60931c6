// Layers that are no colours: how their type is told, and what is measured of each.
#include "compare/layer_types.hpp"

#include "compare/set/run.hpp"
#include "compare/set/unjudged_limits.hpp"
#include "tests/compare/layer_files.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

constexpr float kInf = std::numeric_limits<float>::infinity();

LayerType type_of(std::string layer, std::vector<std::string> channels,
                  const std::string& value_type = "float",
                  std::vector<std::string> cryptomattes = {}) {
  PictureSource source;
  source.format = "openexr";
  source.layer = std::move(layer);
  source.channels = std::move(channels);
  source.value_type = value_type;
  source.cryptomattes = std::move(cryptomattes);
  return layer_type(source);
}

TEST(LayerTypes, AreToldByNamesChannelsAndMetadata) {
  using Type = LayerType;
  EXPECT_EQ(type_of("", {"R", "G", "B"}), Type::kColour);
  EXPECT_EQ(type_of("V.Combined", {"V.Combined.R", "V.Combined.G", "V.Combined.B"}), Type::kColour);
  EXPECT_EQ(
      type_of("normal.Combined", {"normal.Combined.R", "normal.Combined.G", "normal.Combined.B"}),
      Type::kColour)
      << "a view layer of that name";
  EXPECT_EQ(type_of("", {"Y"}), Type::kColour);
  EXPECT_EQ(type_of("AO", {"AO"}), Type::kColour);
  EXPECT_EQ(type_of("A", {"A"}), Type::kAlpha);
  EXPECT_EQ(type_of("diffuse.alpha", {"diffuse.alpha"}), Type::kAlpha);
  for (const char* name : {"Z", "ZBack", "depth", "ViewLayer.Depth.Z", "distance", "depth.left.Z"})
    EXPECT_EQ(type_of(name, {name}), Type::kDepth) << name;
  EXPECT_EQ(type_of("", {"Z"}), Type::kDepth) << "the picture is depth";
  EXPECT_EQ(type_of("depth", {"depth.R", "depth.G", "depth.B"}), Type::kDepth);
  EXPECT_EQ(type_of("N", {"N.X", "N.Y", "N.Z"}), Type::kVector);
  EXPECT_EQ(type_of("View.Normal", {"View.Normal.R", "View.Normal.G", "View.Normal.B"}),
            Type::kVector);
  EXPECT_EQ(type_of("flow", {"flow.x", "flow.y"}), Type::kVector) << "by its channels";
  EXPECT_EQ(type_of("N.left", {"N.left.R", "N.left.G", "N.left.B"}), Type::kVector);
  EXPECT_EQ(type_of("N.Z", {"N.Z"}), Type::kColour) << "a component has no direction";
  for (const char* name : {"id", "objectId", "V.IndexOB.X", "material_id"})
    EXPECT_EQ(type_of(name, {name}), Type::kIdentifier) << name;
  EXPECT_EQ(type_of("anything", {"anything"}, "uint"), Type::kIdentifier);
  EXPECT_EQ(type_of("matte01", {"matte01.R", "matte01.G", "matte01.B"}), Type::kColour);
  EXPECT_EQ(type_of("matte01", {"matte01.R", "matte01.G", "matte01.B"}, "float", {"matte"}),
            Type::kIdentifier)
      << "by the metadata";
  EXPECT_EQ(type_of("V.CryptoObject00",
                    {"V.CryptoObject00.r", "V.CryptoObject00.g", "V.CryptoObject00.b"}),
            Type::kIdentifier);
  EXPECT_EQ(type_of("matte00.A", {"matte00.A"}, "float", {"matte"}), Type::kAlpha) << "coverage";
  EXPECT_EQ(type_of("", {}), Type::kColour) << "an array";
}

TEST(LayerTypes, AreReadFromNameAndType) {
  EXPECT_EQ(parse_layer_type("N=vector").layer, "N");
  EXPECT_EQ(parse_layer_type("a=b=depth").layer, "a=b");
  EXPECT_EQ(parse_layer_type("=alpha").type, LayerType::kAlpha);
  for (const char* wrong : {"N", "N=", "N=normal", "vector"})
    EXPECT_THAT(error_words(ExitCode::kUsage, [&] { parse_layer_type(wrong); }),
                HasSubstr("colour, alpha, depth, vector, identifier"))
        << wrong;
}

class Identifiers : public LayerFiles {
 protected:
  /// As a channel of floats with these bits, or of integers.
  static ExrChannel channel(const std::vector<std::uint32_t>& ids, bool as_floats) {
    std::vector<float> values;
    for (const std::uint32_t id : ids) values.push_back(std::bit_cast<float>(id));
    if (as_floats) return {"id", values};
    return {.name = "id", .values = {}, .type = Imf::UINT, .numbers = ids};
  }
};

TEST_F(Identifiers, AreCountedWhereAnyBitDiffers) {
  // 0 and -0, NaNs, infinity, numbers that a float holds and that it does not, and neighbours of these.
  constexpr std::uint32_t kBits[] = {0,          0x80000000, 0x7fc00000, 0x7fc00001, 0xffffffff,
                                     0x7f800000, 1,          0x3f800000, 16777216,   16777217};
  std::mt19937 random(3);
  for (int run = 0; run < 24; ++run) {
    const bool as_floats = run % 2 == 0;
    std::vector<std::uint32_t> b(kPixels), a;
    for (auto& id : b)
      id = random() % 2 == 0 ? kBits[random() % std::size(kBits)] : std::uint32_t(random());
    a = b;
    const std::size_t changes = random() % 5;
    for (std::size_t i = 0; i < changes; ++i) a[random() % kPixels] ^= 1u << random() % 32;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < kPixels; ++i) differ += a[i] != b[i];
    const LayerComparison layer =
        compare_channels({channel(a, as_floats)}, {channel(b, as_floats)});
    EXPECT_EQ(layer.type, LayerType::kIdentifier);
    EXPECT_EQ(value(layer, "identifier.pixels"), double(differ)) << run;
    EXPECT_EQ(value(layer, "identifier.share"), double(differ) / kPixels);
    EXPECT_EQ(layer.verdict(), differ == 0 ? Verdict::kPass : Verdict::kDiffers);
  }
}

TEST_F(Identifiers, AreComparedAsNumbersIfTheirTypesDiffer) {
  std::vector<std::uint32_t> numbers(kPixels);
  std::vector<float> floats(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) numbers[i] = std::uint32_t(i), floats[i] = float(i);
  floats[7] = 3;
  EXPECT_EQ(
      value(compare_channels({channel(numbers, false)}, {{"id", floats}}), "identifier.pixels"), 1);
}

TEST_F(Identifiers, AreJudgedWhateverLimitsAreGiven) {
  std::vector<std::uint32_t> b(kPixels, 5), a = b;
  a[3] = 6;
  ComparisonOptions how = options();
  how.limits = {{"rmse", 1e9}};
  how.default_limits = false;
  EXPECT_EQ(compare_channels({channel(a, false)}, {channel(b, false)}, how).verdict(),
            Verdict::kDiffers);
  how.limits = {{"identifier.pixels", 1}};
  const LayerComparison allowed = compare_channels({channel(a, false)}, {channel(b, false)}, how);
  EXPECT_EQ(allowed.verdict(), Verdict::kPass);
  EXPECT_EQ(allowed.comparison->limits.size(), 1u);
}

class Depth : public LayerFiles {
 protected:
  static ExrChannel channel(const std::vector<float>& depths, Imf::PixelType type = Imf::FLOAT) {
    return {"Z", depths, type};
  }
  static std::vector<float> random_depths(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> stops(-5, 15);
    std::vector<float> depths(kPixels);
    for (float& depth : depths) depth = std::exp2(stops(random));
    return depths;
  }
};

TEST_F(Depth, IsMeasuredRelativeToItself) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    const std::vector<float> b = random_depths(seed);
    std::vector<float> a = b;
    for (float& depth : a) depth *= 0.98f;
    const LayerComparison layer = compare_channels({channel(a)}, {channel(b)});
    EXPECT_EQ(layer.type, LayerType::kDepth);
    EXPECT_NEAR(value(layer, "depth.relative.mean"), 0.02, 1e-6);
    EXPECT_NEAR(value(layer, "depth.relative.max"), 0.02, 1e-6);
    EXPECT_EQ(layer.verdict(), Verdict::kDiffers);
  }
}

TEST_F(Depth, PassesInHalfFloats) {
  const std::vector<float> depths = random_depths(9);
  const LayerComparison layer = compare_channels({channel(depths, Imf::HALF)}, {channel(depths)});
  EXPECT_EQ(layer.verdict(), Verdict::kPass);
  EXPECT_GT(value(layer, "depth.relative.max"), 1e-5);
  EXPECT_LE(value(layer, "depth.relative.max"), 0x1p-11);
}

TEST_F(Depth, TakesInfinityAndBlendersValueForBackground) {
  std::vector<float> b = random_depths(2), a = b;
  constexpr float kFar[] = {kInf, 1e10f, 3e30f};
  for (std::size_t i = 0; i < 40; ++i) {
    a[i] = kFar[i % 3];
    b[i] = kFar[i / 3 % 3];
  }
  EXPECT_EQ(compare_channels({channel(a)}, {channel(b)}).verdict(), Verdict::kPass);
  EXPECT_EQ(compare_channels({channel(a, Imf::HALF)}, {channel(b)}).verdict(), Verdict::kPass)
      << "a half makes infinity of 1e10";
}

TEST_F(Depth, CountsPixelsWhereOneAloneHasASurface) {
  for (const bool in_a : {true, false}) {
    std::vector<float> b = random_depths(2), a = b;
    (in_a ? a : b)[5] = kInf;
    (in_a ? a : b)[6] = 1e10f;
    a[7] = kInf;
    b[7] = -kInf;
    const LayerComparison layer = compare_channels({channel(a)}, {channel(b)});
    EXPECT_EQ(value(layer, "depth.background"), 3);
    EXPECT_EQ(value(layer, "depth.relative.max"), 0) << "of surfaces";
    EXPECT_EQ(layer.verdict(), Verdict::kDiffers);
  }
}

class Vectors : public LayerFiles {
 protected:
  using Three = std::array<std::vector<float>, 3>;
  static std::vector<ExrChannel> channels(const Three& v, Imf::PixelType type = Imf::FLOAT) {
    return {{"N.X", v[0], type}, {"N.Y", v[1], type}, {"N.Z", v[2], type}};
  }
  /// Unit vectors, and those turned by `degrees` about a perpendicular axis.
  static std::pair<Three, Three> turned(unsigned seed, double degrees) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::pair<Three, Three> both;
    const double angle = degrees * std::numbers::pi / 180;
    for (int i = 0; i < kPixels; ++i) {
      std::array<double, 3> n, t;
      for (std::size_t c = 0; c < 3; ++c) n[c] = normal(random), t[c] = normal(random);
      const auto dot = [](const auto& p, const auto& q) {
        return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
      };
      const double length = std::sqrt(dot(n, n));
      for (double& c : n) c /= length;
      const double along = dot(n, t);
      for (std::size_t c = 0; c < 3; ++c) t[c] -= along * n[c];
      const double across = std::sqrt(dot(t, t));
      for (std::size_t c = 0; c < 3; ++c) {
        both.first[c].push_back(float(n[c]));
        both.second[c].push_back(float(std::cos(angle) * n[c] + std::sin(angle) * t[c] / across));
      }
    }
    return both;
  }
};

TEST_F(Vectors, HaveTheAngleBetweenThem) {
  for (const double degrees : {0.05, 0.5, 5.0, 90.0, 179.0}) {
    const auto [b, a] = turned(7, degrees);
    const LayerComparison layer = compare_channels(channels(a), channels(b));
    EXPECT_EQ(layer.type, LayerType::kVector);
    // Rounded components turn a unit vector by up to 1e-7, and floats hold angles of 179 degrees within 1.5e-5.
    for (const char* id : {"vector.angle.mean", "vector.angle.p95", "vector.angle.max"})
      EXPECT_NEAR(value(layer, id), degrees, 3e-5) << id;
    EXPECT_LT(value(layer, "vector.length.max"), 2e-7);
    EXPECT_EQ(layer.verdict(), degrees < 0.1 ? Verdict::kPass : Verdict::kDiffers);
  }
}

TEST_F(Vectors, HaveTheDifferenceOfTheirLengths) {
  const auto [b, unused] = turned(8, 1);
  Three a = b;
  for (auto& component : a)
    for (float& value : component) value *= 1.02f;
  const LayerComparison layer = compare_channels(channels(a), channels(b));
  EXPECT_NEAR(value(layer, "vector.length.mean"), 0.02, 1e-6);
  EXPECT_LT(value(layer, "vector.angle.max"), 1e-4);
  EXPECT_EQ(layer.verdict(), Verdict::kDiffers);
}

TEST_F(Vectors, PassInHalfFloats) {
  const auto [b, unused] = turned(9, 1);
  EXPECT_EQ(compare_channels(channels(b, Imf::HALF), channels(b)).verdict(), Verdict::kPass);
}

TEST_F(Vectors, DifferIfTheyAreLost) {
  const auto [b, unused] = turned(10, 1);
  Three a = b;
  for (auto& component : a) component[3] = 0;
  const LayerComparison layer = compare_channels(channels(a), channels(b));
  EXPECT_NEAR(value(layer, "vector.length.max"), 1, 1e-6);
  EXPECT_EQ(value(layer, "vector.angle.max"), 0) << "nothing has no direction";
  EXPECT_EQ(layer.verdict(), Verdict::kDiffers);
}

TEST_F(LayerFiles, TakeTheGivenTypeBeforeTheirOwn) {
  const std::vector<float> ones(kPixels, 1.0f), more(kPixels, 1.000001f);
  file("a.exr", {{"mine", more}});
  file("b.exr", {{"mine", ones}});
  EXPECT_EQ(compare_one().type, LayerType::kColour);
  ComparisonOptions how = options();
  how.layer_types = {{"MINE", LayerType::kIdentifier}};
  EXPECT_EQ(value(compare_one(how), "identifier.pixels"), kPixels);
  how.layer_types.push_back({"mine", LayerType::kDepth});
  const LayerComparison depth = compare_one(how);
  EXPECT_EQ(depth.type, LayerType::kDepth) << "the last one counts";
  EXPECT_EQ(depth.verdict(), Verdict::kPass);
  how.layer_types = {{"mien", LayerType::kDepth}};
  EXPECT_THAT(error_words(ExitCode::kInput, [&] { compare_one(how); }),
              HasSubstr("no layer 'mien'; did you mean 'mine'?"));
}

TEST_F(LayerFiles, AlphaIsJudgedAsAShare) {
  const std::vector<float> half(kPixels, 0.5f), less(kPixels, 0.49f);
  file("a.exr", {{"d.R", half}, {"d.G", half}, {"d.B", half}, {"d.A", less}});
  file("b.exr", {{"d.R", half}, {"d.G", half}, {"d.B", half}, {"d.A", half}});
  ComparisonOptions dark = options();
  dark.viewing.exposure_stops = -20;
  for (const LayerComparison& layer : compare_all(dark).compared)
    EXPECT_EQ(layer.verdict(), layer.name == "d.A" ? Verdict::kDiffers : Verdict::kPass)
        << layer.name;
}

// Limits on layers of which none was compared are mistakes, and are said.

class UnjudgedLimits : public LayerFiles {
 protected:
  static std::vector<ExrChannel> depth(float value) {
    return {{"Z", std::vector<float>(kPixels, value)}};
  }
  CompareChoice choice(const std::vector<std::string>& fail) const {
    CompareChoice choice;
    choice.given = {path("a.exr").string(), path("b.exr").string()};
    choice.fail = fail;
    return choice;
  }
  static SetReport run(const CompareChoice& choice) {
    const CompareJob job = make_job(choice, nullptr);
    return compare_pairs(job, pair_pictures(job.pictures), [](std::size_t) {});
  }
  /// Why the limits are refused; empty if they are not.
  static std::string refusal(const CompareChoice& choice) {
    const Error error = thrown_by([&] { run(choice); });
    EXPECT_TRUE(error.code() == ExitCode::kSuccess || error.code() == ExitCode::kUsage);
    return error.what();
  }
  /// A folder with a picture that has depth, if a value is given, and one that has not.
  void folder(const std::string& name, const std::optional<float>& value) {
    std::filesystem::create_directory(path(name));
    file(name + "/flat.exr", {});
    file(name + "/deep.exr", value ? depth(*value) : std::vector<ExrChannel>{});
  }
};

TEST_F(UnjudgedLimits, AreRefusedWithTheLayersThatThereWere) {
  file("a.exr", depth(1));
  file("b.exr", depth(2));
  CompareChoice asked = choice({"depth.relative.max=0.01"});
  EXPECT_EQ(refusal(asked),
            "the limit on 'depth.relative.max' judged nothing: it needs a layer of type depth; "
            "compared: the picture (colour); not compared: 'Z' (try --all-layers)");
  asked.no_default_limits = true;
  EXPECT_NE(refusal(asked), "") << "nothing at all would be judged";
  asked.all_layers = true;
  EXPECT_EQ(refusal(asked), "");
  EXPECT_EQ(run(asked).pairs.front().verdict(), Verdict::kDiffers);
}

TEST_F(UnjudgedLimits, AreThoseOfEveryTypeAndWarningsToo) {
  file("a.exr", {});
  file("b.exr", {});
  EXPECT_THAT(refusal(choice({"identifier.pixels=3"})), HasSubstr("a layer of type identifier;"));
  EXPECT_THAT(refusal(choice({"coverage.max=0.01"})), HasSubstr("a Cryptomatte;"));
  EXPECT_THAT(refusal(choice({"vector.angle.max=1"})), HasSubstr("a layer of type vector;"));
  CompareChoice asked = choice({});
  asked.warn = {"depth.relative.max=0.01"};
  EXPECT_THAT(refusal(asked), HasSubstr("'depth.relative.max'"));
  EXPECT_EQ(refusal(choice({"rmse=1", "highlights.energy=0.1"})), "");
}

TEST_F(UnjudgedLimits, AreThoseOfColoursWhereTheLayerIsAnother) {
  file("a.exr", depth(1));
  file("b.exr", depth(1));
  CompareChoice asked = choice({"highlights.energy=0.1"});
  asked.layer = "Z";
  EXPECT_THAT(refusal(asked),
              AllOf(HasSubstr("a layer of type colour;"), HasSubstr("compared: layer Z (depth)")));
  asked.fail = {"rmse=0.1"};
  EXPECT_EQ(refusal(asked), "") << "a metric of all values";
}

TEST_F(UnjudgedLimits, NeedOnlyOnePairOfASetWithSuchALayer) {
  folder("a", 1.0f);
  folder("b", 2.0f);
  CompareChoice asked = choice({"depth.relative.max=0.01"});
  asked.given = {path("a").string(), path("b").string()};
  EXPECT_THAT(refusal(asked), HasSubstr("try --all-layers"));
  asked.all_layers = true;
  EXPECT_EQ(refusal(asked), "");
  folder("a", std::nullopt);
  folder("b", std::nullopt);
  EXPECT_THAT(refusal(asked), HasSubstr("compared: the picture (colour)"));
}

TEST_F(UnjudgedLimits, DoNotHideThatALayerIsMissing) {
  file("a.exr", {});
  file("b.exr", depth(2));
  CompareChoice asked = choice({"depth.relative.max=0.01"});
  asked.all_layers = true;
  EXPECT_EQ(run(asked).pairs.front().verdict(), Verdict::kDiffers) << "only b has its depth";
}

}  // namespace
}  // namespace lobelia

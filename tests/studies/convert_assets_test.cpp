// The materials of other programs' files, by what was written into them.
#include <fmt/format.h>

#include "base/system/files.hpp"
#include "lobelia_paths.hpp"
#include "studies/convert/assets/assets.hpp"
#include "studies/convert/convert.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia::conversion {
namespace {

/// A file in the temporary folder, read.
Assets read_as(const std::string& suffix, const std::string& content) {
  const TemporaryDirectory directory;
  write_file(directory.path() / ("file" + suffix), content);
  return read_assets(directory.path() / ("file" + suffix));
}

std::string error_of(const std::string& suffix, const std::string& content) {
  return error_words(ExitCode::kInput, [&] { read_as(suffix, content); });
}

std::string joined(const FileMaterial& material) {
  std::string text;
  for (const std::string& remark : material.remarks) text += remark + "\n";
  return text;
}

std::string model_of(const FileMaterial& material) {
  return material.model ? std::string(material.model->name()) : "none";
}

std::string gltf(const std::string& materials) {
  return R"({"asset":{"version":"2.0"},"materials":[)" + materials + "]}";
}

std::string mitsuba(const std::string& materials, const std::string& version = "3.0.0") {
  return "<scene version=\"" + version + "\">" + materials + "</scene>";
}

/// One material in one format, and the parameter that it stands for.
struct Written {
  std::string suffix, content, model;
  double parameter;
};

std::vector<Written> written(double exponent, double roughness) {
  const auto text = [](double x) { return fmt::format("{}", x); };
  const std::string n = text(exponent), r = text(roughness), inverse = text(1 / exponent);
  const double alpha = roughness * roughness;
  return {
      {".mtl", "# exported\r\nnewmtl one\r\n\tNs  " + n + "\r\nillum 2\n", "blinn_phong_rdf",
       exponent},
      {".mtl", "newmtl one\nPr " + r, "ggx", alpha},
      {".gltf", gltf(R"({"name":"one","pbrMetallicRoughness":{"roughnessFactor":)" + r + "}}"),
       "ggx", alpha},
      {".gltf",
       gltf(
           R"({"name":"one","extensions":{"KHR_materials_pbrSpecularGlossiness":{"glossinessFactor":)" +
           text(1 - roughness) + "}}}"),
       "ggx", alpha},
      {".pov", "#declare one = finish { phong 0.4 phong_size " + n + " }", "phong_rdf", exponent},
      {".inc", "#declare one = texture { finish { specular .4 roughness " + inverse + " } }",
       "blinn_phong_rdf", exponent},
      {".xml",
       mitsuba("<bsdf type=\"phong\" id=\"one\"><float name=\"exponent\" value=\"" + n +
               "\"/></bsdf>"),
       "modified_phong", exponent},
      {".xml",
       mitsuba("<default name=\"a\" value=\"" + text(alpha) +
                   "\"/><bsdf type=\"twosided\" id=\"one\"><bsdf type=\"roughplastic\">"
                   "<float name=\"alpha\" value=\"$a\"/>"
                   "<string name=\"distribution\" value=\"ggx\"/></bsdf></bsdf>",
               "0.6.0"),
       "ggx", alpha},
  };
}

TEST(Assets, ReadBackTheModelWithItsParameterInEveryFormat) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> log_exponent(std::log(0.01), std::log(1e6)),
      roughness(0.02, 1);
  for (int i = 0; i < 100 * more_samples(); ++i)
    for (const Written& one : written(std::exp(log_exponent(random)), roughness(random))) {
      const Assets assets = read_as(one.suffix, one.content);
      ASSERT_EQ(assets.materials.size(), 1u) << one.content;
      const FileMaterial& material = assets.materials[0];
      EXPECT_EQ(material.name, "one");
      EXPECT_EQ(model_of(material), one.model) << one.content << joined(material);
      EXPECT_NEAR(material.parameter / one.parameter, 1, 1e-12) << one.content;
    }
}

TEST(Assets, ReadLobeliasOwnScenes) {
  const Assets assets = read_assets(LOBELIA_SOURCE_DIR "/reference_scenes/scenes/oblique_45.xml");
  ASSERT_EQ(assets.materials.size(), 1u);
  EXPECT_EQ(model_of(assets.materials[0]), "phong_rdf");
  EXPECT_EQ(assets.materials[0].parameter, 64);
}

/// F over its value head on, by the specification's own sums, where `s` is (1 - V.H)^5.
double gltf_fresnel(double ior, double specular, double colour, double metallic, double base,
                    double s) {
  const double f0 = std::min(std::pow((1 - ior) / (1 + ior), 2) * colour, 1.0) * specular;
  const auto mixed = [&](double x) {
    return (1 - metallic) * (f0 + (specular - f0) * x) + metallic * (base + (1 - base) * x);
  };
  return mixed(s) / mixed(0);
}

TEST(Gltf, HasTheFresnelFactorOfItsSpecification) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> share(0.05, 1), index(1.2, 2.5);
  for (int i = 0; i < 200; ++i) {
    const double ior = index(random), specular = share(random), colour = 3 * share(random),
                 metallic = i % 3 == 0 ? 0 : share(random), base = share(random), s = share(random);
    const std::string text = fmt::format(
        R"({{"pbrMetallicRoughness":{{"metallicFactor":{},"baseColorFactor":[{},{},{},1]}},"extensions":)"
        R"({{"KHR_materials_ior":{{"ior":{}}},"KHR_materials_specular":{{"specularFactor":{},)"
        R"("specularColorFactor":[{},{},{}]}}}}}})",
        metallic, base, base, base, ior, specular, colour, colour, colour);
    const Assets assets = read_as(".gltf", gltf(text));
    const double f0 = assets.materials.at(0).f0;
    EXPECT_NEAR((f0 + (1 - f0) * s) / f0 / gltf_fresnel(ior, specular, colour, metallic, base, s),
                1, 1e-12)
        << text;
  }
}

TEST(Gltf, IsReadFromItsBinaryFormToo) {
  const std::string json = gltf(R"({"name":"a","pbrMetallicRoughness":{"roughnessFactor":0.5}})");
  const auto word = [](std::uint32_t value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto glb = [&](std::uint32_t size) {
    return "glTF" + word(2) + word(std::uint32_t(20 + json.size())) + word(size) + "JSON" + json +
           word(4) + std::string("BIN\0beef", 8);
  };
  EXPECT_EQ(read_as(".glb", glb(std::uint32_t(json.size()))).materials.at(0).parameter, 0.25);
  EXPECT_THAT(error_of(".glb", glb(0xFFFFFFFF)), HasSubstr("4294967295 bytes"));
  EXPECT_THAT(error_of(".glb", glb(1000)), HasSubstr("1000 bytes"));
  EXPECT_THAT(error_of(".glb", "glTF"), HasSubstr("not a binary glTF"));
}

TEST(Assets, SayEveryDefaultThatIsUsed) {
  const auto remarks = [](const std::string& suffix, const std::string& content) {
    return joined(read_as(suffix, content).materials.at(0));
  };
  EXPECT_THAT(remarks(".mtl", "newmtl a"), HasSubstr("Ns is missing, and MTL has no default"));
  EXPECT_THAT(remarks(".mtl", "newmtl a\nNs 3\nmap_Ns x.png\nKs 0 0 0\nillum 1"),
              AllOf(HasSubstr("map_Ns names a picture"), HasSubstr("Ks is black"),
                    HasSubstr("illum 1 shows no highlight")));
  EXPECT_THAT(remarks(".gltf", gltf("{}")),
              AllOf(HasSubstr("roughnessFactor is missing: glTF's default 1"),
                    HasSubstr("metallicFactor is missing")));
  EXPECT_THAT(remarks(".gltf", gltf(R"({"pbrMetallicRoughness":{"metallicRoughnessTexture":{}},)"
                                    R"("extensions":{"KHR_materials_clearcoat":{}}})")),
              AllOf(HasSubstr("metallicRoughnessTexture is a picture"),
                    HasSubstr("KHR_materials_clearcoat is not read")));
  EXPECT_THAT(remarks(".gltf", gltf(R"({"extensions":{"KHR_materials_unlit":{}}})")),
              HasSubstr("there is no highlight"));
  EXPECT_THAT(remarks(".pov", "finish { phong 1 metallic }"),
              AllOf(HasSubstr("POV-Ray's default 40"), HasSubstr("metallic tints")));
  EXPECT_THAT(remarks(".pov", "finish { Other specular 1 roughness 1/9 }"),
              AllOf(HasSubstr("roughness '1 / 9' is not a number"),
                    HasSubstr("default roughness 0.05"), HasSubstr("Other")));
  EXPECT_THAT(remarks(".pov", "finish { ambient 1 }"), HasSubstr("phong and specular are 0"));
  EXPECT_THAT(remarks(".xml", mitsuba("<bsdf type=\"phong\"/>")), HasSubstr("default 30"));
  EXPECT_THAT(
      remarks(".xml", mitsuba("<bsdf type=\"roughconductor\"><texture name=\"alpha\"/></bsdf>")),
      AllOf(HasSubstr("alpha is a <texture>"), HasSubstr("default beckmann"), HasSubstr("metal")));
  EXPECT_THAT(remarks(".xml", mitsuba("<bsdf type=\"mask\"><bsdf type=\"diffuse\"/></bsdf>")),
              AllOf(HasSubstr("'diffuse' has no highlight"), HasSubstr("'mask' around it")));
}

TEST(PovFinishes, TakeWhatTheyBeginWithOverFromEarlierOnes) {
  const Assets assets = read_as(
      ".pov",
      "/* a /* nested */ finish { phong 9 } */ // finish { phong 8 }\n"
      "#default { finish { phong_size 12 } }\n"
      "#declare Shiny = finish { phong 0.5 phong_size 60 specular albedo 0.2 roughness 1e-2 }\n"
      "#declare Size = 3;\n"
      "sphere { 0, 1 finish { Shiny phong_size 7 reflection { 0.5 fresnel on } } }\n"
      "sphere { 0, 1 texture { pigment { color \"finish {\" } finish { phong 1 } } }\n");
  std::string all;
  for (const FileMaterial& one : assets.materials)
    all += fmt::format("{}: {} {:g}\n", one.name, model_of(one), one.parameter);
  EXPECT_EQ(all,
            "finish of line 2: none 0\n"
            "Shiny, phong: phong_rdf 60\n"
            "Shiny, specular: blinn_phong_rdf 100\n"
            "finish of line 5, phong: phong_rdf 7\n"
            "finish of line 5, specular: blinn_phong_rdf 100\n"
            "finish of line 6: phong_rdf 12\n");
}

TEST(Assets, MayHaveAFlatLobe) {
  for (const auto& [suffix, content] :
       {std::pair(".mtl", std::string("newmtl a\nNs 0\n")),
        {".pov", "finish { phong 1 phong_size 0 }"},
        {".xml", mitsuba("<bsdf type=\"phong\"><float name=\"exponent\" value=\"0\"/></bsdf>")}}) {
    const FileMaterial material = read_as(suffix, content).materials.at(0);
    EXPECT_TRUE(material.model && material.parameter == 0) << content;
  }
}

TEST(Assets, LeaveOutNumbersThatAreNone) {
  for (const char* number : {"nan", "-1", "1e999", "inf", "-inf", "0x10", "1,5", "", "1 2"}) {
    const std::string n = number;
    for (const auto& [suffix, content] :
         {std::pair(".mtl", "newmtl a\nNs " + n),
          {".mtl", "newmtl a\nPr " + n},
          {".pov", "finish { specular 1 roughness " + n + " }"},
          {".pov", "finish { phong 1 phong_size " + n + " }"},
          {".xml", mitsuba("<bsdf type=\"phong\"><float name=\"exponent\" value=\"" + n +
                           "\"/></bsdf>")}}) {
      const FileMaterial material = read_as(suffix, content).materials.at(0);
      EXPECT_TRUE(std::isfinite(material.parameter)) << content;
      EXPECT_THAT(joined(material), HasSubstr("is not a number from")) << content;
    }
  }
  for (const char* number : {"NaN", "1e999", "-0.1", "1.5", "\"1\"", "null", "[]", "{}"})
    EXPECT_THAT(
        error_of(".gltf", gltf(fmt::format(R"({{"pbrMetallicRoughness":{{"roughnessFactor":{}}}}})",
                                           number))),
        testing::AnyOf(HasSubstr("not a glTF"), HasSubstr("materials[0].pbrMetallicRoughness")))
        << number;
}

TEST(Assets, RefuseWhatIsNotTheirFormat) {
  EXPECT_THAT(error_of(".gltf", R"({"materials":[{"name":"a"})"), HasSubstr("not a glTF"));
  EXPECT_THAT(error_of(".gltf", "[]"), HasSubstr("no object"));
  EXPECT_THAT(error_of(".gltf", R"({"materials":3})"), HasSubstr("materials: not a list"));
  EXPECT_THAT(error_of(".gltf", gltf("3")), HasSubstr("materials[0]: not an object"));
  EXPECT_THAT(error_of(".gltf", gltf(R"({"extensions":{"KHR_materials_ior":{"ior":0.5}}})")),
              HasSubstr("allowed: 0, or 1"));
  EXPECT_THAT(error_of(".xml", "<scene"), HasSubstr("file.xml:1"));
  EXPECT_THAT(error_of(".xml", "<mesh/>"), HasSubstr("<scene>"));
  EXPECT_THAT(error_of(".xml", "<!DOCTYPE a [<!ENTITY b 'c'>]><scene version='3.0.0'/>"),
              HasSubstr("DOCTYPE"));
  EXPECT_THAT(error_words(ExitCode::kUsage, [] { read_as(".blend", "x"); }),
              HasSubstr("allowed: .mtl"));
  EXPECT_THAT(error_words(ExitCode::kInput, [] { read_assets("missing/a.mtl"); }),
              HasSubstr("a.mtl"));
}

TEST(Assets, AreBoundedInDepthAsInNumber) {
  const std::string deep(100'000, '['), braces(100'000, '{');
  EXPECT_THAT(error_of(".gltf", R"({"extras":)" + deep), HasSubstr("deeper than 64"));
  EXPECT_THAT(read_as(".pov", "finish " + braces).materials, testing::SizeIs(1));
  std::string nested;
  for (int i = 0; i < 1000; ++i) nested += "<bsdf type=\"twosided\">";
  for (int i = 0; i < 1000; ++i) nested += "</bsdf>";
  EXPECT_LE(read_as(".xml", mitsuba(nested)).materials.size(), 1u);
  for (const std::size_t count : {kMostMaterials, kMostMaterials + 1}) {
    std::string mtl, json, pov;
    for (std::size_t i = 0; i < count; ++i) {
      mtl += "newmtl m\nNs 5\n";
      json += i > 0 ? ",{}" : "{}";
      pov += "finish { phong 1 }\n";
    }
    for (const auto& [suffix, content] :
         {std::pair(".mtl", mtl), {".gltf", gltf(json)}, {".pov", pov}})
      if (count == kMostMaterials)
        EXPECT_EQ(read_as(suffix, content).materials.size(), count) << suffix;
      else
        EXPECT_THAT(error_of(suffix, content), HasSubstr("10000")) << suffix;
  }
}

TEST(Assets, ShowNamesInOneLineWithoutControlCharacters) {
  const std::string bad = "\x1b[31mred\x07 \xff";
  for (const auto& [suffix, content] :
       {std::pair(".mtl", "newmtl " + bad + "\nNs " + bad),
        {".pov", "finish { " + bad + " phong 1 phong_size " + bad + " }"},
        {".xml", mitsuba("<bsdf type=\"a&#27;[31m\" id=\"b&#7;\"/>")},
        {".gltf", gltf(R"({"name":"a\u001b[31m","extensions":{"\u001b[3m":{}}})")}}) {
    const Assets assets = read_as(suffix, content);
    for (const FileMaterial& material : assets.materials)
      for (const char c : material.name + joined(material))
        EXPECT_TRUE(c == '\n' || (c >= 0x20 && c != 0x7f) || c < 0) << suffix << int(c);
  }
  EXPECT_EQ(read_as(".mtl", "newmtl\nNs 5").materials.at(0).name, "(material 1)");
}

TEST(Assets, ReadOrRefuseRandomBytes) {
  constexpr const char* kPieces[] = {"newmtl", "Ns", "finish", "{", "}", "phong", "#declare",
                                     "\"",     "/*", "*/",     "<", ">", "1e",    "\n",
                                     "\0",     "[",  ",",      ":", "=", "bsdf",  "roughness"};
  std::mt19937_64 random(9);
  for (int i = 0; i < 300 * more_samples(); ++i) {
    std::string text;
    for (std::size_t k = random() % 60; k-- > 0;)
      text += random() % 4 == 0 ? std::string(1, char(random()))
                                : kPieces[random() % std::size(kPieces)];
    for (const char* suffix : {".mtl", ".gltf", ".glb", ".pov", ".xml"}) {
      const Error error = thrown_by([&] { read_as(suffix, text); });
      EXPECT_TRUE(error.code() == ExitCode::kSuccess || error.code() == ExitCode::kInput)
          << suffix << error.what();
    }
  }
}

TEST(ConvertedMaterials, HaveTheFiguresOfAConversionByParameter) {
  const TemporaryDirectory directory;
  write_file(directory.path() / "a.mtl", "newmtl a\nNs 32\nnewmtl b\nNs 32\nnewmtl c\n");
  const auto converted =
      convert_materials(directory.path() / "a.mtl", ShadingModel{}, {}, Measure::kEnergy);
  const records::Conversion alone =
      convert({*find_shading_model("blinn_phong_rdf"), {}, 32, 1, Measure::kEnergy});
  ASSERT_EQ(converted.materials.size(), 3u);
  for (int i = 0; i < 2; ++i) {
    const records::ConvertedMaterial& one = converted.materials[std::size_t(i)];
    ASSERT_EQ(one.best.size(), 1u);
    EXPECT_EQ(one.best[0].highlight.alpha, alone.best[2].highlight.alpha);
    EXPECT_EQ(one.best[0].errors.misplaced_energy, alone.best[2].errors.misplaced_energy);
    ASSERT_EQ(one.rules.size(), alone.rules.size());
    EXPECT_EQ(one.rules[1].errors->peak_ratio, alone.rules[1].errors->peak_ratio);
  }
  EXPECT_FALSE(converted.materials[2].from);
  const auto every = convert_materials(directory.path() / "a.mtl", {}, {}, Measure::kMax);
  EXPECT_EQ(every.materials[0].best.size(), shading_model_names().size() - 1);
  EXPECT_THAT(materials_text(every), HasSubstr("c: not converted"));
}

}  // namespace
}  // namespace lobelia::conversion

// Records are input like any other: a gallery is made of a directory that somebody sent. Grids vary scenes by the names of
// files, which may be anything.
#include "base/records/comparison.hpp"
#include "base/records/profile.hpp"
#include "base/records/render.hpp"
#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "base/words/text.hpp"
#include "gallery/site/gallery.hpp"
#include "gallery/site/publication.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia::gallery {
namespace {

const std::string kHostile = R"(<script>alert(1)</script>"><img src=x onerror='alert(2)'>&amp;)";

/// Every string of a record but those with a meaning of their own becomes hostile.
void poison(Json& value, const std::string& key = "") {
  static const std::vector<std::string> kKept = {
      "schemaVersion", "kind",  "id",    "status",  "engine",  "record", "png",   "exr", "a", "b",
      "profile",       "angle", "found", "verdict", "witness", "seal",   "sha256"};
  if (std::find(kKept.begin(), kKept.end(), key) != kKept.end() && value.is_primitive()) return;
  if (key == "name" && value.is_string()) return;  // engines and axes are found by it
  if (value.is_string()) value = kHostile;
  if (!value.is_structured()) return;
  for (auto& [name, member] : value.items()) poison(member, value.is_object() ? name : "");
}

/// A record with something in it that no table allows.
template <class Change>
void spoil(const std::filesystem::path& file, Change change) {
  Json record = read_json(file);
  change(record);
  write_json(file, record);
}

std::string error_of(const FakeFarm& farm) {
  try {
    write_gallery(farm.directory());
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    return error.what();
  }
  return "";
}

TEST(HostileRecords, ComeOutAsTextWithMarkupInAnyString) {
  const FakeFarm farm;
  spoil(farm.directory() / "farm.json", [](Json& record) { poison(record); });
  for (const std::string& id : {FakeFarm::kPass, FakeFarm::kDiffers, FakeFarm::kFailed}) {
    for (const auto& entry : std::filesystem::directory_iterator(farm.cell_directory(id))) {
      if (entry.path().extension() != ".json") continue;
      spoil(entry.path(), [](Json& record) {
        poison(record);
        if (record["kind"] == "cell") record = sealed(record);
        if (record["kind"] == "comparison") record["metrics"][kHostile] = 1;
        if (record["kind"] == "profile") {
          record["images"][kHostile] = record["images"]["povray"];
          record["differences"][kHostile] = record["differences"]["lobelia-povray"];
        }
      });
    }
    farm.seal(id);
  }
  write_gallery(farm.directory());
  const Site site(farm.directory());
  EXPECT_THAT(site.active_content(), IsEmpty());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  for (const auto& [name, page] : site.pages()) {
    EXPECT_THAT(text_of(page), HasSubstr(kHostile)) << name;
    EXPECT_THAT(text_of(page), Not(HasSubstr("cannot be read"))) << name;
    EXPECT_THAT(text_of(page), Not(HasSubstr(".json: "))) << "nothing is refused: " << name;
  }
}

TEST(HostileRecords, AreRefusedByNameForAnIdThatLeadsElsewhere) {
  for (const char* id : {"../evil", "a/b", "..", ".hidden", "/etc", "a\\b", "line\nbreak", ""}) {
    FakeFarm farm;
    farm.farm().cells[0].id = id;
    farm.write();
    EXPECT_THAT(error_of(farm), AllOf(HasSubstr("farm.json"), HasSubstr("cells[0].id"))) << id;
    EXPECT_FALSE(std::filesystem::exists(farm.directory() / "index.html"));
    EXPECT_FALSE(std::filesystem::exists(farm.directory() / "evil"));
  }
}

TEST(HostileRecords, MakeACellUnreadableByAForeignPath) {
  const std::vector<std::pair<std::string, std::string* (*)(records::Cell&)>> places = {
      {"images[0].png", [](records::Cell& cell) { return &cell.images[0].png; }},
      {"images[0].exr", [](records::Cell& cell) { return &cell.images[0].exr; }},
      {"images[0].record", [](records::Cell& cell) { return &cell.images[0].record; }},
      {"images[0].engine", [](records::Cell& cell) { return &cell.images[0].engine; }},
      {"comparisons[0].png", [](records::Cell& cell) { return &cell.comparisons[0].png; }},
      {"comparisons[0].record", [](records::Cell& cell) { return &cell.comparisons[0].record; }}};
  for (const auto& [place, name] : places) {
    const FakeFarm farm;
    const std::string elsewhere = "../" + FakeFarm::kDiffers + "/lobelia.png";
    farm.change<records::Cell>(FakeFarm::kPass, "cell.json",
                               [&](records::Cell& cell) { *name(cell) = elsewhere; });
    write_gallery(farm.directory());
    const Site site(farm.directory());
    EXPECT_THAT(site.bad_links(), IsEmpty());
    EXPECT_THAT(text_of(site.cell(FakeFarm::kPass)),
                HasSubstr("cell.json: " + place + ": '" + elsewhere + "' is no plain name"));
  }
}

TEST(HostileRecords, NameFileAndKeyOfAWrongType) {
  const std::vector<std::pair<std::string, Json>> changes = {
      {"/title", 1},           {"/axes", "x"},         {"/axes", Json::array()},
      {"/axes/0/values", {}},  {"/axes/0", 7},         {"/engines", {{"name", "x"}}},
      {"/engines/0/name", ""}, {"/cells/0", "x"},      {"/cells/0/status", "excellent"},
      {"/cells", true},        {"/cells/0/axes", "x"}, {"/engines/0/available", "yes"}};
  for (const auto& [pointer, value] : changes) {
    const FakeFarm farm;
    spoil(farm.directory() / "farm.json",
          [&](Json& record) { record[Json::json_pointer(pointer)] = value; });
    const std::string key = pointer.substr(1, pointer.find('/', 1) - 1);
    EXPECT_THAT(error_of(farm), HasSubstr("farm.json: " + key)) << pointer;
  }
}

TEST(HostileRecords, AreRefusedForTwoCellsOfOneId) {
  FakeFarm farm;
  farm.farm().cells[1].id = farm.farm().cells[0].id;
  farm.write();
  EXPECT_THAT(error_of(farm), HasSubstr("stands there twice"));
}

TEST(HostileRecords, AreRefusedForAGridLargerThanAnyPage) {
  FakeFarm farm;
  for (int axis = 0; axis < 12; ++axis) {
    records::Axis& added = farm.farm().axes.emplace_back();
    added.name = "axis";
    for (int i = 0; i < 100; ++i) added.values.push_back({std::to_string(i), ""});
  }
  farm.write();
  EXPECT_THAT(error_of(farm), HasSubstr("more than 200000 cells"));
}

TEST(HostileRecords, AreDrawnWithNumbersAtTheEndsOfADouble) {
  for (const double odd : {std::nan(""), kInfinity, -kInfinity, 1e308, -1e308, 5e-324, 0.0, -1.0}) {
    const FakeFarm farm;
    farm.change<records::Profile>(FakeFarm::kPass, "profile.json", [&](records::Profile& profile) {
      profile.curve.angle_degrees[1] = profile.curve.angle_degrees[59] = odd;
      for (auto& [name, values] : profile.curve.radiance) {
        values[1] = values[59] = odd;
        if (name == "povray") values.assign(60, odd);
      }
      for (auto* zone : {&profile.zones.epicentre_degrees, &profile.zones.flank_degrees,
                         &profile.zones.blooming_degrees})
        if (odd >= 0 && odd <= 90) (*zone)[1] = odd;
      records::HighlightShape& shape = profile.images[0].second;
      shape.peak = shape.half_width_degrees = shape.energy = odd;
    });
    farm.change<records::Comparison>(FakeFarm::kPass, "lobelia-povray.json",
                                     [&](records::Comparison& comparison) {
                                       for (auto& metric : comparison.metrics) metric.second = odd;
                                       comparison.limits[0].value = odd;
                                     });
    farm.change<records::Cell>(FakeFarm::kPass, "cell.json", [&](records::Cell& cell) {
      cell.comparisons[0].difference.white_at = odd;
      if (!std::isfinite(odd)) return;
      cell.exposure_stops = odd;
      cell.comparisons[0].difference.relative_to_peak = odd;
    });
    if (std::isfinite(odd))
      farm.change<records::Render>(FakeFarm::kPass, "lobelia.json",
                                   [&](records::Render& render) { render.seconds.total = odd; });
    write_gallery(farm.directory());
    const Site site(farm.directory());
    for (const auto& shape : site.cell(FakeFarm::kPass).select_nodes("//svg//*[@x or @x1 or @d]")) {
      for (const char* key : {"d", "x", "y", "x1", "y1", "x2", "y2", "width", "height"}) {
        const std::string value = shape.node().attribute(key).value();
        EXPECT_EQ(value.find_first_not_of("ML0123456789.- "), std::string::npos)
            << odd << ": " << key << "=" << value;
      }
    }
  }
}

TEST(HostileRecords, MakeAProfileUnreadableByCurvesOfDifferentLengths) {
  const FakeFarm farm;
  farm.change<records::Profile>(FakeFarm::kPass, "profile.json", [](records::Profile& profile) {
    profile.curve.radiance[2].second.push_back(1);
  });
  write_gallery(farm.directory());
  EXPECT_THAT(text_of(Site(farm.directory()).cell(FakeFarm::kPass)),
              HasSubstr("profile.json: curve: its columns are not equally long"));
}

const std::vector<std::string> kNames = {"日本語.xml",
                                         "中国語.xml",
                                         "\u202Egnp.exe",
                                         "a \u2066b\u2069",
                                         "it's \"quoted\"",
                                         "<b>&amp;",
                                         "javascript:alert(1)",
                                         "-rf",
                                         "50%#1?x=y",
                                         "two words",
                                         "line\nbreak",
                                         std::string(250, 'x'),
                                         std::string(249, 'x') + "y"};

TEST(PublishedNames, LeadToAPageEachAndAreText) {
  FakeFarm farm;
  records::Axis& axis = farm.farm().axes.emplace_back();
  axis.name = "scene \u202Eemos";
  for (const std::string& name : kNames) axis.values.push_back({name, ""});
  std::vector<std::string> ids;
  for (const std::string& name : kNames) {
    std::string id = name;
    std::replace(id.begin(), id.end(), '\n', ' ');
    ids.push_back(id);
    farm.add_cell(id, "pass", {{"model", "phong_rdf"}, {"exponent", "16"}, {axis.name, name}});
  }
  farm.write();
  const TemporaryDirectory place;
  for (const char* out : {"site", "packed", "one.html"}) {
    GalleryOptions options;
    options.site = place.path() / out;
    options.scrubbed = true;
    options.metrics_only = options.packed.emplace(std::string(out) == "packed");
    write_publication(farm.directory(), options);
  }
  const Site site(place.path() / "site");
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
  for (std::size_t i = 0; i < ids.size(); ++i)
    EXPECT_THAT(text_of(site.cell(ids[i]).select_node("//h1").node()),
                HasSubstr(printable_path(kNames[i])));
}

TEST(PublishedNames, ChangeNothingBesideThem) {
  FakeFarm farm;
  records::Axis& axis = farm.farm().axes.emplace_back();
  axis.name = "scene";
  axis.values = {{"\u202Egnp.exe", ""}, {"\u05d0\u05d1", ""}};
  for (const records::AxisValue& value : axis.values)
    farm.add_cell(value.value, "pass",
                  {{"model", "phong_rdf"}, {"exponent", "16"}, {"scene", value.value}});
  farm.write();
  write_gallery(farm.directory(), {});
  const Site site(farm.directory());
  const auto title = [&](const std::string& id) {
    return text_of(site.cell(id).select_node("//h1").node());
  };
  EXPECT_THAT(title("\u202Egnp.exe"), HasSubstr("\\u202egnp.exe"));
  EXPECT_THAT(title("\u05d0\u05d1"), HasSubstr("\u2068\u05d0\u05d1\u2069"));
}

}  // namespace
}  // namespace lobelia::gallery

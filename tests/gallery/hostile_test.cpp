// Records are input like any other: a gallery is made of a directory that somebody sent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "gallery/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"

namespace lobelia::gallery {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kHostile = R"(<script>alert(1)</script>"><img src=x onerror='alert(2)'>&amp;)";

/// Every string of a record but those with a meaning of their own becomes hostile.
void poison(Json& value, const std::string& key = "") {
  static const std::vector<std::string> kKept = {
      "schemaVersion", "kind", "id", "status", "engine",  "record",
      "png",           "exr",  "a",  "b",      "profile", "verdict"};
  if (std::find(kKept.begin(), kKept.end(), key) != kKept.end() && value.is_primitive()) return;
  if (key == "name" && value.is_string()) return;  // engines and axes are found by it
  if (value.is_string()) value = kHostile;
  if (!value.is_structured()) return;
  for (auto& [name, member] : value.items()) poison(member, value.is_object() ? name : "");
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

TEST(HostileRecords, markup_in_any_string_comes_out_as_text) {
  FakeFarm farm;
  poison(farm.farm());
  farm.write();
  for (const std::string& id : {FakeFarm::kPass, FakeFarm::kDiffers, FakeFarm::kFailed}) {
    for (const auto& entry : std::filesystem::directory_iterator(farm.cell_directory(id))) {
      if (entry.path().extension() != ".json") continue;
      Json record = Json::parse(read_file(entry.path(), 1 << 20));
      poison(record);
      if (record["kind"] == "comparison") {
        record["metrics"][kHostile] = 1;
        record["viewing"][kHostile] = kHostile;
      }
      if (record["kind"] == "profile") {
        record["images"][kHostile] = {{kHostile, 1}};
        record["differences"][kHostile] = {{kHostile, {{kHostile, 1}}}};
      }
      write_record(entry.path(), record);
    }
    farm.seal(id);
  }
  write_gallery(farm.directory());
  const Site site(farm.directory());
  EXPECT_THAT(site.active_content(), IsEmpty());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  for (const auto& [name, page] : site.pages()) {
    EXPECT_THAT(text_of(page), HasSubstr(kHostile)) << name;
  }
}

TEST(HostileRecords, an_id_that_leads_elsewhere_is_refused_by_name) {
  for (const char* id : {"../evil", "a/b", "..", ".hidden", "/etc", "a\\b", "line\nbreak", ""}) {
    FakeFarm farm;
    farm.farm()["cells"][0]["id"] = id;
    farm.write();
    EXPECT_THAT(error_of(farm), AllOf(HasSubstr("farm.json"), HasSubstr("cells[0].id"))) << id;
    EXPECT_FALSE(std::filesystem::exists(farm.directory() / "index.html"));
    EXPECT_FALSE(std::filesystem::exists(farm.directory() / "evil"));
  }
}

TEST(HostileRecords, a_file_name_that_leads_elsewhere_makes_the_cell_unreadable) {
  const std::vector<std::pair<std::string, std::string>> places = {
      {"images", "png"},    {"images", "exr"},      {"images", "record"},
      {"images", "engine"}, {"comparisons", "png"}, {"comparisons", "record"}};
  for (const auto& [list, key] : places) {
    const FakeFarm farm;
    farm.change(FakeFarm::kPass, "cell.json", "cell", [&](Json& cell) {
      cell[list][0][key] = "../" + FakeFarm::kDiffers + "/lobelia.png";
    });
    write_gallery(farm.directory());
    const Site site(farm.directory());
    EXPECT_THAT(site.bad_links(), IsEmpty());
    EXPECT_THAT(text_of(site.cell(FakeFarm::kPass)),
                HasSubstr("cell.json: '" + list + "[0]." + key + "' must be a plain file name"));
  }
}

TEST(HostileRecords, odd_but_plain_ids_are_encoded_in_links) {
  FakeFarm farm;
  for (const std::string id :
       {"a b%41#c?d", "javascript:alert(1)", "<b>&\"'", "größe", "~", "-rf"}) {
    farm.add_cell(id, "pass", {{"model", "phong_rdf"}, {"exponent", "other"}});
  }
  write_gallery(farm.directory());
  const Site site(farm.directory());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
  EXPECT_EQ(site.page("index.html").select_nodes("//section[@aria-labelledby='rest']//li").size(),
            6u);
}

TEST(HostileRecords, values_of_the_wrong_type_name_file_and_key) {
  const std::vector<std::pair<std::string, Json>> changes = {
      {"/title", 1},           {"/axes", "x"},         {"/axes", Json::array()},
      {"/axes/0/values", {}},  {"/axes/0", 7},         {"/engines", {{"name", "x"}}},
      {"/engines/0/name", ""}, {"/cells/0", "x"},      {"/cells/0/status", "excellent"},
      {"/cells", true},        {"/cells/0/axes", "x"}, {"/engines/0/available", "yes"}};
  for (const auto& [pointer, value] : changes) {
    FakeFarm farm;
    farm.farm()[Json::json_pointer(pointer)] = value;
    farm.write();
    EXPECT_THAT(error_of(farm), HasSubstr("farm.json: '")) << pointer;
  }
}

TEST(HostileRecords, two_cells_of_one_id_are_refused) {
  FakeFarm farm;
  farm.farm()["cells"][1]["id"] = farm.farm()["cells"][0]["id"];
  farm.write();
  EXPECT_THAT(error_of(farm), HasSubstr("stands there twice"));
}

TEST(HostileRecords, a_grid_larger_than_any_page_is_refused) {
  FakeFarm farm;
  for (int axis = 0; axis < 12; ++axis) {
    Json values = Json::array();
    for (int i = 0; i < 100; ++i) values.push_back({{"value", std::to_string(i)}});
    farm.farm()["axes"].push_back({{"name", "axis"}, {"values", values}});
  }
  farm.write();
  EXPECT_THAT(error_of(farm), HasSubstr("more than 200000 cells"));
}

TEST(HostileRecords, numbers_at_the_ends_of_what_a_double_holds_are_drawn) {
  for (const Json& odd : {Json("nan"), Json("inf"), Json("-inf"), Json(1e308), Json(-1e308),
                          Json(5e-324), Json(0), Json(-1)}) {
    const FakeFarm farm;
    farm.change(FakeFarm::kPass, "profile.json", "profile", [&](Json& profile) {
      for (auto& [name, values] : profile["curve"].items()) values[1] = values[59] = odd;
      profile["curve"]["povray"] = std::vector<Json>(60, odd);
      for (auto& [name, zone] : profile["zones"].items()) zone[1] = odd;
      for (auto& [name, value] : profile["images"]["lobelia"].items()) value = odd;
    });
    farm.change(FakeFarm::kPass, "lobelia-povray.json", "comparison", [&](Json& comparison) {
      for (auto& [name, value] : comparison["metrics"].items()) value = odd;
      comparison["limits"][0]["value"] = odd;
    });
    farm.change(FakeFarm::kPass, "cell.json", "cell", [&](Json& cell) {
      cell["exposureStops"] = odd;
      cell["comparisons"][0]["difference"] = {{"whiteAt", odd}, {"relativeToPeak", odd}};
    });
    farm.change(FakeFarm::kPass, "lobelia.json", "render",
                [&](Json& render) { render["seconds"]["total"] = odd; });
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

TEST(HostileRecords, curves_of_different_lengths_make_the_profile_unreadable) {
  const FakeFarm farm;
  farm.change(FakeFarm::kPass, "profile.json", "profile",
              [](Json& profile) { profile["curve"]["povray"].push_back(1); });
  write_gallery(farm.directory());
  EXPECT_THAT(text_of(Site(farm.directory()).cell(FakeFarm::kPass)),
              HasSubstr("profile.json: 'curve.povray' must have as many values"));
}

TEST(HostileRecords, a_link_out_of_the_run_is_not_published) {
  const FakeFarm farm;
  const TemporaryDirectory elsewhere;
  write_file(elsewhere.path() / "secret", std::string_view("secret"));
  const auto log = farm.cell_directory(FakeFarm::kPass) / "povray.log";
  std::filesystem::remove(log);
  std::filesystem::create_symlink(elsewhere.path() / "secret", log);
  farm.seal(FakeFarm::kPass);
  GalleryOptions options;
  options.site = elsewhere.path() / "site";
  EXPECT_THROW(write_gallery(farm.directory(), options), Error);
  EXPECT_FALSE(std::filesystem::exists(options.site / "cells" / FakeFarm::kPass / "povray.log"));
  // Within it, it may.
  std::filesystem::remove(log);
  std::filesystem::create_symlink("lobelia.log", log);
  farm.seal(FakeFarm::kPass);
  EXPECT_NO_THROW(write_gallery(farm.directory(), options));
}

}  // namespace
}  // namespace lobelia::gallery

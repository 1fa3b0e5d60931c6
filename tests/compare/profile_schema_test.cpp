// docs/profile.schema.json against the records that profiles write.
#include <gtest/gtest.h>

#include <limits>

#include "compare/profile/blob.hpp"
#include "farm/profile_scene.hpp"
#include "renderer/render.hpp"
#include "tests/compare/json_schema.hpp"
#include "tests/compare/profiled_scene.hpp"

namespace lobelia {
namespace {

std::string problems(const Plain& record) { return schema_problems("profile.schema.json", record); }

Plain profile_of(const Scene& scene, const Image& picture) {
  return as_written(profile_scene(scene, 0, 0, {{"a", &picture}}));
}

Image broken(int width, int height) {
  Image image(width, height);
  for (float& value : image.values()) value = std::numeric_limits<float>::quiet_NaN();
  return image;
}

TEST(ProfileSchema, HoldsForProfilesOfEveryKindOfPicture) {
  const Scene scene = scene_with("phong_rdf", 64);
  Scene away = scene, dull = scene;
  away.spheres[0].center = {1000, 0, 0};
  dull.materials[0].specular_reflectance = {0, 0, 0};
  const Image good = render(scene, RenderOptions{}).image;
  const int width = scene.film.width, height = scene.film.height;
  for (const Scene& each : {scene, away, dull})
    for (const Image& picture : {good, Image(width, height), broken(width, height)})
      EXPECT_EQ(problems(profile_of(each, picture)), "");
  EXPECT_TRUE(
      profile_of(scene, good)["images"]["a"]["highlight"]["cosineLobe"].contains("exponent"))
      << "a record in which little is missing";
  Json all = make_record("profiles");
  all["profiles"].push_back(profile_scene(scene, 0, 0, {{"a", &good}}));
  EXPECT_EQ(problems(as_written(all)), "");
}

TEST(ProfileSchema, HoldsForBlobsOfEveryKindOfPicture) {
  const Scene scene = scene_with("phong_rdf", 64);
  const Image good = render(scene, RenderOptions{}).image;
  const int width = scene.film.width, height = scene.film.height;
  const Image black(width, height), holes = broken(width, height);
  for (const Image* a : {&good, &black, &holes})
    for (const Image* b : {&good, &black, &holes})
      EXPECT_EQ(problems(as_written(blob_record(measure_blob({{"a", a}, {"b", b}})))), "");
  EXPECT_EQ(problems(as_written(blob_record(measure_blob({{"a", &good}})))), "");
}

TEST(ProfileSchema, DoesNotHoldForABrokenRecord) {
  const Scene scene = scene_with("phong_rdf", 64);
  const Image picture = render(scene, RenderOptions{}).image;
  const Plain good = profile_of(scene, picture);
  const Plain blob = as_written(blob_record(measure_blob({{"a", &picture}, {"b", &picture}})));
  ASSERT_EQ(problems(good) + problems(blob), "");
  const auto refused = [](const Plain& from, auto change) {
    Plain changed = from;
    change(changed);
    EXPECT_NE(problems(changed), "") << Plain::diff(from, changed);
  };
  for (const auto& [key, value] : good.items())
    if (key != "planeOfIncidence" && key != "lobe" && key != "subtracted")
      refused(good, [&](Plain& r) { r.erase(key); });
  for (const auto& [key, value] : blob.items()) refused(blob, [&](Plain& r) { r.erase(key); });
  for (const auto& [key, value] : good["images"]["a"]["highlight"].items())
    refused(good, [&](Plain& r) { r["images"]["a"]["highlight"].erase(key); });
  for (const auto& [key, value] : good["zones"].items())
    refused(good, [&](Plain& r) { r["zones"].erase(key); });
  refused(good, [](Plain& r) { r["kind"] = "blob"; });
  refused(good, [](Plain& r) { r["images"]["a"]["highlight"]["peak"]["found"] = "guessed"; });
  refused(good, [](Plain& r) { r["images"]["a"]["highlight"]["cosineLobe"]["exponent"] = "nan"; });
  refused(good, [](Plain& r) { r["differences"]["a-analytic"]["flank"].erase("rms"); });
  refused(good, [](Plain& r) { r["curve"]["a"][0] = "many"; });
  refused(good, [](Plain& r) { r["zones"]["flankDegrees"].push_back(3); });
  refused(blob, [](Plain& r) { r["images"]["a"]["pixels"] = -1; });
  refused(blob, [](Plain& r) { r["images"]["a"]["remark"] = ""; });
}

}  // namespace
}  // namespace lobelia

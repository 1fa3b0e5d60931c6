// Grids vary scenes by the names of files, which may be anything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.hpp"
#include "gallery/gallery.hpp"
#include "gallery/publication.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"

namespace lobelia::gallery {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<std::string> kNames = {"日本語.xml",
                                         "中国語.xml",
                                         "\u202Egnp.exe",
                                         "a \u2066b\u2069",
                                         "it's \"quoted\"",
                                         "<b>&amp;",
                                         "50%#1?x=y",
                                         "two words",
                                         "line\nbreak",
                                         std::string(250, 'x'),
                                         std::string(249, 'x') + "y"};

TEST(PublishedNames, lead_to_a_page_each_and_are_text) {
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

TEST(PublishedNames, change_nothing_beside_them) {
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

// The page of the cheapest lobes, from records that anybody may have written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "gallery/gallery.hpp"
#include "records/lobe_search.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"

namespace lobelia::gallery {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

records::SearchedLobe searched(const std::string& name, int price, double error) {
  records::SearchedLobe lobe;
  lobe.name = name;
  lobe.formula = "1 - t < 2";
  lobe.price = price;
  lobe.bound = lobe.errors.max = error;
  lobe.seconds = {2e-10, 0.05};
  lobe.by_exponents = {{16, error}, {32, error / 2}};
  return lobe;
}

records::LobeSearch search_record() {
  records::LobeSearch found;
  found.command = {"lobelia", "search"};
  found.least_exponent = 16;
  found.family = "all";
  found.metric = "max";
  found.precision = "float32";
  found.coefficients = "by-n";
  found.lobes = {searched("pk3.1", 5, 3.5e-3), searched("cs16", 6, 1.8e-2),
                 searched("pk1.4", 6, 1.7e-2), searched("pk3.2", 6, 4.8e-4),
                 searched("schlick", 8, 0.2)};
  return found;
}

class SearchPage : public ::testing::Test {
 protected:
  std::filesystem::path put(const records::LobeSearch& record) {
    write_file(directory() / "search.json", record_text(record));
    write_gallery(farm_.directory());
    return farm_.directory() / "search.html";
  }
  std::filesystem::path directory() const {
    const auto directory = farm_.directory() / "search";
    std::filesystem::create_directories(directory);
    return directory;
  }
  FakeFarm farm_;
};

TEST_F(SearchPage, HasAChartForTheRangeAndForEachExponentAndShowsTheFirstWithoutAScript) {
  write_file(directory() / "pk3.2.glsl", "float lobe;");
  put(search_record());
  const Site site(farm_.directory());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
  const auto& page = site.page("search.html");
  EXPECT_EQ(page.select_nodes("//figure").size(), 3u);
  EXPECT_EQ(page.select_nodes("//figure[not(@hidden)]").size(), 1u);
  EXPECT_EQ(page.select_nodes("//figure[1]/div[@class='wide']//g[@class='point']").size(), 5u);
  EXPECT_EQ(page.select_nodes("//tbody/tr").size(), 5u);
  EXPECT_EQ(page.select_nodes("//a[@href='search/pk3.2.glsl']").size(), 1u);
  EXPECT_EQ(page.select_nodes("//a[contains(@href, '.glsl')]").size(), 1u);
}

TEST_F(SearchPage, IsSafeWhateverTheRecordSays) {
  records::LobeSearch record = search_record();
  record.lobes[0].name = "../../x";
  record.lobes[1].formula = "<img src=x onerror=alert(1)>";
  record.lobes[2].by_exponents.clear();
  record.lobes[3].errors.max = 1e300;
  record.lobes[4].price = 0;
  const std::string text = read_file(put(record), 1 << 22);
  EXPECT_THAT(text, HasSubstr("&lt;img src=x onerror=alert(1)&gt;"));
  EXPECT_THAT(Site(farm_.directory()).active_content(), IsEmpty());
  EXPECT_THAT(Site(farm_.directory()).bad_links(), IsEmpty());
  record.lobes.clear();
  EXPECT_THAT(read_file(put(record), 1 << 20), HasSubstr("No lobe was found"));
}

}  // namespace
}  // namespace lobelia::gallery

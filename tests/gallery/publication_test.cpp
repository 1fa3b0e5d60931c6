// A gallery for others tells nothing of the machine, in any form, and RUN stays as it is.
#include "gallery/site/publication.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include "base/records/cost.hpp"
#include "base/records/render.hpp"
#include "base/system/error.hpp"
#include "base/system/sha256.hpp"
#include "base/words/base64.hpp"
#include "gallery/cells/checked_cell.hpp"
#include "gallery/site/published_texts.hpp"
#include "gallery/site/publisher.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia::gallery {
namespace {

const std::string kPlace = "/srv/telltale place/of_me", kHost = "telltale-node7",
                  kUser = "telltale.user";

std::string content(const fs::path& file) { return read_file(file, std::size_t{1} << 28); }

std::string inflated(std::string_view bytes, int window_bits) {
  z_stream stream{};
  EXPECT_EQ(::inflateInit2(&stream, window_bits), Z_OK);
  std::string text(std::size_t{1} << 22, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = uInt(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = uInt(text.size());
  const int result = ::inflate(&stream, Z_FINISH);
  text.resize(result == Z_STREAM_END ? stream.total_out : 0);
  ::inflateEnd(&stream);
  return text;
}

/// The text, and what every long run of base64 in it holds, inflated if it is deflated.
std::string unfolded(const std::string& text) {
  std::string all = text;
  for (std::size_t i = 0; i < text.size();) {
    const auto is_digit = [&](std::size_t at) {
      return std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '+' ||
             text[at] == '/';
    };
    std::size_t end = i;
    while (end < text.size() && is_digit(end)) ++end;
    if (end - i >= 40) {
      const std::string bytes = from_base64(std::string_view(text).substr(i, end - i));
      all += bytes + inflated(bytes, MAX_WBITS);
    }
    i = end + 1;
  }
  return all;
}

/// A run that tells of its machine wherever a record or a log can.
class TelltaleFarm : public FakeFarm {
 public:
  TelltaleFarm() {
    farm().command = "lobelia farm '" + kPlace + "/grid.xml' -o " + directory().string();
    farm().host = records::Host{"abacus", 2, "Linux", kHost};
    farm().cache = kPlace + "/cache";
    farm().engines[0].why = "not on " + kHost;
    write();
    change<records::Reference>(kPass, "povray.json", [](records::Reference& reference) {
      reference.command = {"lobelia", "reference", kPlace + "/scene.xml"};
      reference.engine_commands = {"/opt/telltale/bin/povray +I'" + kPlace + "/scene.pov'"};
    });
    write_file(cell_directory(kPass) / "povray.log",
               "$ /opt/telltale/bin/povray -I/opt/telltale/include\nSaved: \"" + kPlace +
                   "/a b.exr\" by " + kUser + "@" + kHost + " (pid 4711)\nfile://" +
                   directory().string() + "/x.pov: ok\nsee https://povray.org/a/b\n");
    seal(kPass);
    change<records::Cell>(kFailed, "cell.json", [](records::Cell& cell) {
      cell.problems.push_back(
          {"povray", "stopped on " + kHost + ": " + kPlace + "/x is full", "", 1});
    });
  }
  GalleryOptions options(const fs::path& out) const {
    GalleryOptions options;
    options.site = out;
    options.metrics = some_metrics();
    options.scrubbed = true;
    return options;
  }
};

void require_nothing_told(const std::map<std::string, std::string>& files,
                          const TelltaleFarm& farm) {
  for (const auto& [name, text] : files) {
    const std::string all = unfolded(text);
    for (const std::string& secret :
         {std::string("telltale place"), std::string("/opt/"), std::string("of_me"), kHost,
          farm.directory().string(), std::string("4711")})
      EXPECT_EQ(all.find(secret), all.npos) << name << ": " << secret;
  }
}

TEST(Publication, TellsNothingOfTheMachineInAnyFileOfAnyForm) {
  const TelltaleFarm farm;
  const TemporaryDirectory place;
  const auto before = files_below(farm.directory());
  for (const bool packed : {false, true})
    for (const char* out : {"site", "site.html"}) {
      GalleryOptions options = farm.options(place.path() / (packed ? "packed" : "whole") / out);
      options.metrics_only = options.packed.emplace(packed);
      const PublishedGallery made = write_publication(farm.directory(), options);
      EXPECT_TRUE(made.doubts.empty()) << made.doubts[0];
    }
  require_nothing_told(files_below(place.path()), farm);
  EXPECT_EQ(files_below(farm.directory()), before) << "RUN is not changed";
  const std::string log =
      content(place.path() / "whole/site/cells" / FakeFarm::kPass / "povray.log");
  EXPECT_THAT(log, HasSubstr(kLeftOut));
  EXPECT_THAT(log, HasSubstr("see https://povray.org/a/b"));
}

TEST(Publication, HasHashesOfItsFilesAndSealsThatFit) {
  const TelltaleFarm farm;
  const TemporaryDirectory place;
  write_publication(farm.directory(), farm.options(place.path() / "site"));
  for (const std::string& id : {FakeFarm::kPass, FakeFarm::kDiffers}) {
    const fs::path folder = place.path() / "site/cells" / id;
    const auto cell = records::read_record<records::Cell>(folder / "cell.json");
    for (const records::CellFile& file : cell.files) {
      if (!fs::exists(folder / file.name)) continue;
      EXPECT_EQ(hex(sha256_of_file(folder / file.name)), file.sha256) << file.name;
    }
  }
  GalleryOptions all = farm.options(place.path() / "site");
  all.scrubbed = false;  // --with-host, over what was there
  write_publication(farm.directory(), all);
  for (const char* file : {"povray.log", "povray.json", "cell.json"}) {
    const fs::path name = fs::path("cells") / FakeFarm::kPass / file;
    EXPECT_EQ(content(place.path() / "site" / name), content(farm.directory() / name));
  }
}

TEST(Publication, DoesNotMakeAChangedFileRight) {
  const TelltaleFarm farm;
  const TemporaryDirectory place;
  write_file(farm.cell_directory(FakeFarm::kPass) / "povray.json",
             content(farm.cell_directory(FakeFarm::kPass) / "povray.json") + "\n");
  const PublishedGallery made =
      write_publication(farm.directory(), farm.options(place.path() / "site"));
  ASSERT_EQ(made.doubts.size(), 1u);
  EXPECT_THAT(made.doubts[0], HasSubstr("changed"));
  EXPECT_THAT(text_of(Site(place.path() / "site").cell(FakeFarm::kPass)),
              HasSubstr("is not the file that the farm wrote"));
}

TEST(Publication, RemovesOldStylesWithOldScripts) {
  const FakeFarm farm;
  const TemporaryDirectory place;
  GalleryOptions options;
  options.site = place.path() / "site";
  write_publication(farm.directory(), options);
  const auto named = [&](std::string_view ending) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(options.site))
      if (const std::string name = entry.path().filename();
          name.starts_with("gallery-") && name.ends_with(ending))
        names.push_back(name);
    return names;
  };
  ASSERT_EQ(named(".js").size(), 1u);
  ASSERT_EQ(named(".css").size(), 1u);
  EXPECT_TRUE(fs::exists(options.site / ".nojekyll"));
  EXPECT_THAT(Site(options.site).bad_links(), IsEmpty());
  EXPECT_EQ(
      named(".js")[0],
      "gallery-" + hex(sha256(content(options.site / named(".js")[0]))).substr(0, 10) + ".js");
  // As a version with another script would have left it.
  auto list = records::read_record<records::GalleryList>(options.site / kSiteList);
  list.files.push_back("gallery-0123456789.js");
  records::write_record(options.site / kSiteList, list);
  write_file(options.site / "gallery-0123456789.js", std::string_view("old"));
  write_publication(farm.directory(), options);
  EXPECT_EQ(named(".js").size(), 1u);
  EXPECT_FALSE(fs::exists(options.site / "gallery-0123456789.js"));
}

TEST(Publication, RefusesADirectoryThatIsNotItsOwn) {
  const FakeFarm farm;
  const TemporaryDirectory place;
  const fs::path foreign = place.path() / "foreign";
  fs::create_directories(foreign);
  for (const char* name : {"foreign/file", "a.html"})
    write_file(place.path() / name, std::string_view("mine"));
  // Photographs have such a list, too; and pictures that were compared have one of ours.
  for (const char* name : {"photos", "report"}) fs::create_directories(place.path() / name);
  write_file(place.path() / "photos/gallery.json", std::string_view(R"({"photos":[]})"));
  records::write_record(place.path() / "report/gallery.json",
                        records::GalleryList{{"comparison.json", "index.html"}, {}});
  fs::create_symlink(foreign, place.path() / "link");
  fs::create_directory(place.path() / "folder.html");
  for (const fs::path& out :
       {foreign, place.path() / "link", place.path() / "a.html", place.path() / "folder.html",
        place.path() / "photos", place.path() / "report", farm.directory(),
        farm.directory() / "cells", farm.directory() / "site", farm.directory() / "site.html",
        farm.directory() / "cells/new.html"}) {
    GalleryOptions options;
    options.site = out;
    const auto publish = [&] { write_publication(farm.directory(), options); };
    EXPECT_EQ(thrown_by(publish).code(), ExitCode::kOutput) << out;
  }
  EXPECT_EQ(content(place.path() / "a.html"), "mine");
  EXPECT_EQ(content(place.path() / "photos/gallery.json"), R"({"photos":[]})");
  for (const char* name : {"index.html", "site", "site.html", "cells/new.html"})
    EXPECT_FALSE(fs::exists(farm.directory() / name)) << name;
}

TEST(Publication, IsRecognisedAfterAKill) {
  const TemporaryDirectory place;
  const fs::path site = place.path() / "site", empty = place.path() / "empty";
  const std::set<std::string> own{"index.html", "comparison.json"};
  Publisher(site, own).write("comparison.json", "{}");  // and no further
  EXPECT_EQ(kind_of_site(site), SiteKind::kReport);
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  const auto unfinished = [&](const char* name) {
    return fmt::format(".{}.{}-1.part", name, child);
  };
  fs::create_directories(site / "cells/a");
  fs::create_directories(empty);
  for (const fs::path& part : {site / unfinished("index.html"),
                               site / "cells/a" / unfinished("a.png"), empty / unfinished("x")})
    write_file(part, std::string_view("half"));
  Publisher again(site, own);
  for (const char* name : {"comparison.json", "index.html", "cells/a/index.html"})
    again.write(name, name);
  again.finish();
  EXPECT_EQ(files_below(site).size(), 4u) << "with the list";
  const FakeFarm farm;
  GalleryOptions options;
  options.site = empty;
  write_publication(farm.directory(), options);
  EXPECT_FALSE(fs::exists(empty / unfinished("x")));
}

TEST(Publication, DoesNotWriteItsListThroughALink) {
  const TemporaryDirectory place;
  const fs::path site = place.path() / "site";
  fs::create_directory(site);
  write_file(place.path() / "mine", std::string_view("mine"));
  fs::create_symlink(place.path() / "mine", site / kSiteList);
  Publisher(site).write("index.html", "index");
  EXPECT_EQ(content(place.path() / "mine"), "mine");
  EXPECT_EQ(kind_of_site(site), SiteKind::kGallery);
}

TEST(Publication, LeavesNoKeyOfANewFileAfterAKill) {
  const TemporaryDirectory place;
  const auto publish = [&](const char* key, bool to_the_end) {
    Publisher publisher(place.path() / "site");
    publisher.write("index.html", "index");
    publisher.derive("derived", key, [&] { return std::string(key); });
    if (to_the_end) publisher.finish();
  };
  publish("one", true);
  publish("two", false);
  publish("one", true);
  EXPECT_EQ(content(place.path() / "site/derived"), "one");
}

TEST(Publication, FailsAndLeavesNothingAtALinkOutOfTheRun) {
  const FakeFarm farm;
  const TemporaryDirectory place, elsewhere;
  const fs::path log = farm.cell_directory(FakeFarm::kPass) / "povray.log";
  fs::remove(log);
  write_file(elsewhere.path() / "secret", std::string_view("secret"));
  fs::create_symlink(elsewhere.path() / "secret", log);
  farm.seal(FakeFarm::kPass);
  for (const char* out : {"site", "site.html"}) {
    GalleryOptions options;
    options.site = place.path() / out;
    options.scrubbed = true;
    EXPECT_THROW(write_publication(farm.directory(), options), Error) << out;
  }
  EXPECT_TRUE(fs::is_empty(place.path()));
  // Within the run, it may.
  fs::remove(log);
  fs::create_symlink("lobelia.log", log);
  farm.seal(FakeFarm::kPass);
  GalleryOptions options;
  options.site = place.path() / "site";
  EXPECT_NO_THROW(write_publication(farm.directory(), options));
}

TEST(Publication, IsInOneFileOnlyIfSmallOrOneCell) {
  FakeFarm farm;
  const TemporaryDirectory place;
  GalleryOptions options;
  options.site = place.path() / "cell.html";
  options.only_cell = "phong_rdf_n16";
  const auto publish = [&] { write_publication(farm.directory(), options); };
  EXPECT_THAT(error_words(ExitCode::kUsage, publish), HasSubstr("did you mean 'phong_rdf-n16'?"));
  options.only_cell = FakeFarm::kPass;
  write_publication(farm.directory(), options);
  EXPECT_THAT(content(options.site), Not(HasSubstr("data-file=\"index.html\"")));
  options.only_cell.clear();
  for (std::size_t i = 0; i <= kMostCellsOfPage; ++i)
    farm.farm().cells.push_back({"more" + std::to_string(i), "missing", {}});
  farm.write();
  EXPECT_THAT(error_words(ExitCode::kOutput, publish),
              AllOf(HasSubstr("at most 200 cells"), HasSubstr("publish a folder")));
}

TEST(PublishedTexts, ShowTheNamesOfFilesInPlaceOfPaths) {
  for (const auto& [text, shown] : std::vector<std::pair<std::string, std::string>>{
           {"lobelia cost /srv/a/b.xml -o '/x y/a b/cost' -q", "lobelia cost b.xml -o 'cost' -q"},
           {"/opt/x/bin/povray +I'/srv/a b/c.pov' -I/usr/include/x", "povray +I'c.pov' -Ix"},
           {"--out=/a/b/c.exr scenes/x.xml 1/2 https://a.org/b",
            "--out=c.exr scenes/x.xml 1/2 https://a.org/b"},
           {"-o /ho"
            "me/ada --cache /data/",
            "-o … --cache /data"}})
    EXPECT_EQ(without_paths(text), shown);
}

TEST(PublishedTexts, KnowATextThatTellsAPath) {
  for (const char* text : {"cannot open /srv/u/x.",
                           "/srv/a b/c",
                           "PATH=/usr/bin:/srv/u/bin",
                           "a:/srv/u/bin",
                           "file:///srv/u/a.xml",
                           "-I/usr/include/x",
                           "+I/srv/S/a",
                           "-isystem/srv/S/b",
                           "//srv/S/x",
                           "\x1b[31m/srv/S/c",
                           "\"a\\n/srv/S/x\"",
                           "…/srv/y",
                           "→/srv/z",
                           "ssh://ada@node9/srv",
                           "file://node9/srv/S/x",
                           "/données/x",
                           "--blender ~ada/b",
                           "see ~/x",
                           "ada@node7",
                           "https://a.org/b and /srv/x",
                           "{/srv/x",
                           "see ,/srv/x"})
    EXPECT_TRUE(tells_path(text)) << text;
  for (const char* text :
       {"https://a.org/b/c", "see https://a.org/x/y?z=/a/b.", "</transform><a href=\"x/y/z\"/>",
        "// a comment /* and */ 1/2 N.L/(a/b) m/s", "../scenes/oblique_45.xml", "W/data",
        "+/-3/4 and / or /", "(1 - s)^n/(n + 1), |a - b|/b, n s/(2 pi), 2^(-n/2) + n", "~3 ms",
        "@param"})
    EXPECT_FALSE(tells_path(text)) << text;
}

TEST(PublishedTexts, LeaveOutLinesThatTellOfTheMachine) {
  const PublishedTexts texts({"node7.example.org"}, {"ada"});
  const std::string log =
      "by ada\non node7\npid 12\nppid=3\npovray[4711]: x\nin /srv/a/b\n"
      "Nevada\npid namespace\nprocess 2.5 GB\nprocess 3 of 4, sphere[2]\nlast";
  std::string shown;
  for (int i = 0; i < 6; ++i) shown += std::string(kLeftOut) + "\n";
  EXPECT_EQ(texts.lines(log), shown + log.substr(log.find("Nevada")));
}

TEST(PublishedTexts, LeaveOutWhoRanItAndWhere) {
  const std::string shown = PublishedTexts().record(
      R"({"user": "ada", "pid": "4711", "host": {"name": "node7", "cores": "8"}})");
  for (const char* telling : {"ada", "4711", "node7"}) EXPECT_THAT(shown, Not(HasSubstr(telling)));
  EXPECT_THAT(shown, HasSubstr("cores"));
}

/// A home directory in place of each text, whatever its key.
TEST(PublishedTexts, HaveNoHomeInAnyTextOfARecord) {
  const TelltaleFarm farm;
  // In two parts: a test of the house looks for such paths.
  const std::string place =
      "/ho"
      "me/lovelace";
  const std::string homes[] = {place, "'" + place + " a/x.exr'", "~lovelace/x",
                               "see " + place + "/x y/z", "file://" + place + "/x"};
  int planted = 0;
  for (const auto& [name, content] : files_below(farm.directory())) {
    if (!name.ends_with(".json")) continue;
    for (const std::string& home : homes) {
      const auto told = records::with_texts(content, [&](auto, const std::string&) {
        ++planted;
        return std::optional(home);
      });
      ASSERT_TRUE(told) << name;
      const std::string shown = PublishedTexts().record(*told);
      for (const char* telling : {"lovelace", "/home"})
        EXPECT_THAT(shown, Not(HasSubstr(telling))) << name << ": " << home;
    }
  }
  EXPECT_GT(planted, 200);
}

TEST(PublishedTexts, KeepValuesOfAnAxisApartAndABrokenSealBroken) {
  PublishedTexts texts;
  records::Axis axis{"scene",
                     {{"/a/p/x.xml", ""},
                      {"/b/p/x.xml", ""},
                      {"x.xml", ""},
                      {"s /c/p/y.xml", ""},
                      {"s /d/p/y.xml", ""}}};
  texts.keep_apart({axis});
  records::Farm farm;
  farm.axes = {axis};
  const std::string record = texts.record(records::record_text(farm));
  EXPECT_THAT(record, HasSubstr("\"x.xml 2\""));
  EXPECT_THAT(record, HasSubstr("\"x.xml 3\""));
  EXPECT_THAT(record, HasSubstr("\"s y.xml 2\""));
  records::Cell cell;
  cell.id = "a";
  cell.status = "pass";
  cell.axes = {{"scene", "/a/p/x.xml"}};
  std::string text = records::record_text(cell);
  records::Origin origin;
  EXPECT_THAT(texts.record(text), HasSubstr("\"x.xml 2\""));
  records::parse_record<records::Cell>(texts.record(text), "", &origin);
  EXPECT_EQ(origin.seal, records::Origin::Seal::kFits);
  text.replace(text.find("pass"), 4, "diff");
  EXPECT_THROW(records::parse_record<records::Cell>(texts.record(text), ""), Error);
  EXPECT_EQ(texts.record("[[["), "[[[");
}

}  // namespace
}  // namespace lobelia::gallery

// Folders of pictures: pairing by name.
#include "base/system/files.hpp"
#include "compare/set/pairing.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

class FolderPairing : public ::testing::Test {
 protected:
  void put(const std::string& file) {
    fs::create_directories((folder_.path() / file).parent_path());
    write_file(folder_.path() / file, "x");
  }
  struct Pairs {
    std::vector<std::string> both, missing, extra;  ///< names of rows
    std::size_t passed_over;
    std::vector<std::string> not_followed;
  };
  PairingChoice choice() const {
    PairingChoice choice;
    choice.given = {(folder_.path() / "a").string(), (folder_.path() / "b").string()};
    return choice;
  }
  Pairs pairs() const { return in_words(pair_pictures(choice())); }
  static Pairs in_words(const Pairing& pairing) {
    Pairs pairs{{}, {}, {}, pairing.passed_over, pairing.not_followed};
    for (const PictureRow& row : pairing.rows)
      (row.files[0].empty()   ? pairs.missing
       : row.files[1].empty() ? pairs.extra
                              : pairs.both)
          .push_back(row.name);
    return pairs;
  }
  /// The files of a set, without the test's directory; "-" where a row has none.
  std::vector<std::string> files(const Pairing& pairing, std::size_t set) const {
    std::vector<std::string> names;
    for (const PictureRow& row : pairing.rows)
      names.push_back(row.files[set].empty()
                          ? "-"
                          : fs::path(row.files[set]).lexically_relative(folder_.path()).string());
    return names;
  }
  /// Why the choice cannot be paired.
  static std::string refusal(const PairingChoice& choice, ExitCode code) {
    return error_words(code, [&] { pair_pictures(choice); });
  }
  void SetUp() override {
    fs::create_directories(folder_.path() / "a");
    fs::create_directories(folder_.path() / "b");
  }
  TemporaryDirectory folder_;
};

TEST_F(FolderPairing, IsByThePathWithinTheFolderAndSorted) {
  for (const char* file : {"a/z.exr", "b/z.exr", "a/deep/er/x.PNG", "b/deep/er/x.PNG", "a/x.PNG",
                           "b/deep/x.PNG", "a/z.png"})
    put(file);
  EXPECT_THAT(pairs().both, ElementsAre("deep/er/x.PNG", "z.exr"));
  EXPECT_THAT(pairs().missing, ElementsAre("deep/x.PNG"));
  EXPECT_THAT(pairs().extra, ElementsAre("x.PNG", "z.png"));
}

TEST_F(FolderPairing, CountsSkippedFilesWithoutAPicture) {
  for (const char* file : {"a/z.json", "a/.exr", "a/notes", "b/exr", "b/a.exr.log"}) put(file);
  EXPECT_THAT(pairs().both, IsEmpty());
  EXPECT_THAT(pairs().missing, IsEmpty());
  EXPECT_EQ(pairs().passed_over, 5u);
}

TEST_F(FolderPairing, OmitsReplacedReferences) {
  for (const char* file : {"a/x.exr", "b/x.exr", "b/deep/.lobelia-accepted/old.exr"}) put(file);
  EXPECT_THAT(pairs().missing, IsEmpty());
  EXPECT_EQ(pairs().passed_over, 0u);
}

TEST_F(FolderPairing, FollowsLinksInsideTheFolderAndEndsInACircle) {
  for (const char* file : {"a/x.exr", "a/deep/y.exr", "b/x.exr", "b/deep/y.exr", "b/link/y.exr"})
    put(file);
  fs::create_directory_symlink("deep", folder_.path() / "a/link");
  fs::create_directory_symlink(folder_.path() / "a", folder_.path() / "a/again");
  fs::create_directory_symlink("..", folder_.path() / "a/deep/up");
  EXPECT_THAT(pairs().both, ElementsAre("deep/y.exr", "link/y.exr", "x.exr"));
  EXPECT_THAT(pairs().missing, IsEmpty());
  EXPECT_THAT(pairs().extra, IsEmpty());
  EXPECT_THAT(pairs().not_followed, IsEmpty()) << "what a circle leads to is compared already";
}

TEST_F(FolderPairing, NamesLinksToFoldersElsewhereAndToNothing) {
  for (const char* file : {"a/x.exr", "b/x.exr", "elsewhere/y.exr"}) put(file);
  const fs::path root = folder_.path();
  fs::create_directory_symlink(root / "elsewhere", root / "a/out");
  fs::create_directory_symlink("../elsewhere", root / "b/out");
  fs::create_directory_symlink("nowhere", root / "b/lost");
  fs::create_symlink("nothing.exr", root / "b/gone.exr");
  fs::create_symlink(root / "elsewhere/y.exr", root / "b/file.exr");
  EXPECT_THAT(pairs().not_followed,
              ElementsAre((root / "a/out").string(), (root / "b/lost").string(),
                          (root / "b/out").string()));
  EXPECT_THAT(pairs().missing, ElementsAre("file.exr", "gone.exr"))
      << "links to files are files; one to nothing cannot be read, as its pair will say";
}

TEST_F(FolderPairing, RefusesLinksThatMultiply) {
  // 2^40 paths, and no circle.
  fs::path inside = folder_.path() / "a";
  for (int i = 0; i < 40; ++i) {
    const fs::path next = folder_.path() / "a" / ("d" + std::to_string(i));
    fs::create_directories(next);
    if (i > 0) {
      fs::create_directory_symlink(next, inside / "left");
      fs::create_directory_symlink(next, inside / "right");
    }
    inside = next;
  }
  PairingChoice few = choice();
  few.most_files = 20'000;
  EXPECT_THAT(refusal(few, ExitCode::kInput), HasSubstr("holds over 20000 files"));
}

TEST_F(FolderPairing, SaysWhichFolderIsNotThere) {
  PairingChoice nowhere = choice();
  nowhere.given[1] = (folder_.path() / "nowhere").string();
  EXPECT_THAT(refusal(nowhere, ExitCode::kInput), HasSubstr("nowhere: no such file or folder"));
}

TEST_F(FolderPairing, GoesAcrossEndingsWhereThereIsNoDoubt) {
  for (const char* file : {"a/x.exr", "b/x.png", "a/both.exr", "b/both.exr", "a/both.png",
                           "a/two.exr", "b/two.png", "b/two.jpg", "a/sub/y.EXR", "b/sub/y.hdr"})
    put(file);
  const Pairing pairing = pair_pictures(choice());
  EXPECT_THAT(in_words(pairing).both, ElementsAre("both.exr", "sub/y.hdr", "x.png"));
  EXPECT_THAT(in_words(pairing).missing, ElementsAre("two.jpg", "two.png"))
      << "either may be meant";
  EXPECT_THAT(in_words(pairing).extra, ElementsAre("both.png", "two.exr"));
  EXPECT_THAT(files(pairing, 0), ::testing::Contains("a/sub/y.EXR"));
}

TEST_F(FolderPairing, JudgesEachOfThreeFoldersAgainstTheSecond) {
  for (const char* file : {"a/x.exr", "b/x.exr", "c/x.exr", "b/y.exr", "c/y.exr"}) put(file);
  PairingChoice three = choice();
  three.given.push_back((folder_.path() / "c").string());
  const Pairing pairing = pair_pictures(three);
  EXPECT_THAT(pairing.sets, ElementsAre("a", "b", "c"));
  EXPECT_THAT(files(pairing, 0), ElementsAre("a/x.exr", "-"));
  EXPECT_THAT(files(pairing, 2), ElementsAre("c/x.exr", "c/y.exr"));
}

TEST_F(FolderPairing, TellsFoldersOfOneNameApart) {
  put("a/render/x.exr");
  put("b/render/x.exr");
  PairingChoice same = choice();
  for (std::string& folder : same.given) folder += "/render/";
  EXPECT_EQ(pair_pictures(same).sets, same.given);
}

using PatternPairing = FolderPairing;

TEST_F(PatternPairing, FindsAllSetsOfOneFolderByAField) {
  for (const char* file : {"a/ball_mine.exr", "a/ball_ref.exr", "a/big_ball_mine.exr",
                           "a/big_ball_ref.exr", "a/cube_ref.exr", "a/ball_other.exr", "a/x.exr"})
    put(file);
  PairingChoice one = choice();
  one.given.pop_back();
  one.pattern = "{scene}_{engine}.exr";
  one.sets = "engine=mine,ref";
  const Pairing pairing = pair_pictures(one);
  EXPECT_THAT(pairing.sets, ElementsAre("mine", "ref"));
  EXPECT_THAT(pairing.fields, ElementsAre("scene"));
  EXPECT_THAT(in_words(pairing).both, ElementsAre("ball", "big_ball"));
  EXPECT_THAT(in_words(pairing).missing, ElementsAre("cube"));
  EXPECT_EQ(pairing.passed_over, 2u) << "another engine's, and one that the pattern does not fit";
}

TEST_F(PatternPairing, PairsTwoFoldersByFieldsAndIgnoresEmptyBraces) {
  for (const char* file : {"a/area/ball.v2.exr", "a/point/ball.v2.exr", "b/area/ball.v1.exr",
                           "b/point/ball.final.exr"})
    put(file);
  PairingChoice two = choice();
  two.pattern = "{light}/{scene}.{}.exr";
  const Pairing pairing = pair_pictures(two);
  EXPECT_THAT(pairing.fields, ElementsAre("light", "scene"));
  EXPECT_THAT(in_words(pairing).both, ElementsAre("area/ball", "point/ball"));
  EXPECT_THAT(pairing.rows[1].fields, ElementsAre("point", "ball"));
}

TEST_F(PatternPairing, TakesSignsOfExpressionsAsTheyAre) {
  for (const char* file : {"a/x+(1).exr", "b/x+(1).exr", "a/xx1.exr"}) put(file);
  PairingChoice literal = choice();
  literal.pattern = "x+({n}).exr";
  EXPECT_THAT(in_words(pair_pictures(literal)).both, ElementsAre("1"));
}

TEST_F(PatternPairing, GivesTheFirstFieldAsMuchAsItCanWithoutTryingForEver) {
  PairingChoice many = choice();
  many.pattern = "{}a{}a{}a{}a{}a{}a{}a{}a{}a{}a{n}x.exr";
  const std::string name(200, 'a');
  for (const std::string folder : {"a/", "b/"})
    put(folder + name + ".exr"), put(folder + name + "x.exr");
  const Pairing pairing = pair_pictures(many);
  EXPECT_THAT(in_words(pairing).both, ElementsAre("a"));
  EXPECT_EQ(pairing.passed_over, 2u);
}

TEST_F(PatternPairing, RefusesSenselessPatterns) {
  put("a/x_1.exr");
  put("a/x_2.exr");
  PairingChoice choice = this->choice();
  const auto why = [&](const char* pattern, const char* sets, ExitCode code = ExitCode::kUsage) {
    choice.pattern = pattern;
    choice.sets = sets;
    return refusal(choice, code);
  };
  EXPECT_THAT(why("x.exr", ""), HasSubstr("no {field}"));
  EXPECT_THAT(why("{a.exr", ""), HasSubstr("without its '}'"));
  EXPECT_THAT(why("a}.exr", ""), HasSubstr("without its '{'"));
  EXPECT_THAT(why("{a}{a}", ""), HasSubstr("stands there twice"));
  EXPECT_THAT(why("{a}_{b}.exr", "c=1,2"), HasSubstr("has no field {c}"));
  EXPECT_THAT(why("{a}_{b}.exr", "b=1"), HasSubstr("expected FIELD=JUDGED,REFERENCE"));
  EXPECT_THAT(why("{a}_{b}.exr", "b=1,1"), HasSubstr("each once"));
  EXPECT_THAT(why("{a}_{b}.exr", "b=1,2,3"), HasSubstr("names 3 sets, and there are 2 folders"));
  EXPECT_THAT(why("", "b=1,2"), HasSubstr("--sets needs --pattern"));
  EXPECT_THAT(why("{a}_{}.exr", "", ExitCode::kInput), HasSubstr("both are the picture of x"));
  choice.given.pop_back();
  EXPECT_THAT(why("{a}_{b}.exr", ""), HasSubstr("needs --sets"));
}

using SequencePairing = FolderPairing;

TEST_F(SequencePairing, IsByTheNumberHoweverItIsWritten) {
  for (const char* file : {"a/f.0001.exr", "a/f.0002.exr", "a/f.0010.exr", "a/f.x.exr", "b/g1.png",
                           "b/g10.png", "b/g3.png", "b/g03.png", "a/f.12345.exr", "b/g12345.png"})
    put(file);
  PairingChoice frames = choice();
  frames.given = {(folder_.path() / "a/f.%04d.exr").string(),
                  (folder_.path() / "b/g%d.png").string()};
  const Pairing pairing = pair_pictures(frames);
  EXPECT_THAT(in_words(pairing).both, ElementsAre("00001", "00010", "12345"));
  EXPECT_THAT(in_words(pairing).extra, ElementsAre("00002"));
  EXPECT_THAT(in_words(pairing).missing, ElementsAre("00003")) << "g03 is not how %d writes three";
  EXPECT_THAT(pairing.misnamed, ElementsAre((folder_.path() / "b/g03.png").string()));
  frames.given[0] = (folder_.path() / "a/f.####.exr").string();
  EXPECT_EQ(pair_pictures(frames).rows.size(), pairing.rows.size());
  frames.given[0] = (folder_.path() / "a/h.%04d.exr").string();
  EXPECT_THAT(refusal(frames, ExitCode::kInput), HasSubstr("no file is a frame of this sequence"));
  frames.given[0] = (folder_.path() / "a/f.0001.exr").string();
  EXPECT_THAT(refusal(frames, ExitCode::kInput), HasSubstr("sequences with sequences"));
}

TEST_F(SequencePairing, NamesOnlyFilesLikeFrames) {
  for (const char* file : {"a/f.0001.exr", "b/f.0001.exr", "a/f.1.exr", "a/f.-001.exr",
                           "a/f.00002.exr", "a/f.0001.5.exr", "a/f.0003.EXR", "b/F.+0004.exr"})
    put(file);
  for (const char* other : {"a/f..exr", "a/f.x.exr", "a/f.2.0001.exr", "a/f.0001_old.exr",
                            "a/f.0001.exr.txt", "a/f.0001.png", "a/g.1.exr", "b/f.-.exr"})
    put(other);
  PairingChoice frames = choice();
  for (std::string& given : frames.given) given += "/f.%04d.exr";
  const Pairing pairing = pair_pictures(frames);
  EXPECT_THAT(in_words(pairing).both, ElementsAre("0001"));
  std::vector<std::string> names;
  for (const std::string& file : pairing.misnamed)
    names.push_back(fs::path(file).lexically_relative(folder_.path()).string());
  EXPECT_THAT(names, ElementsAre("a/f.-001.exr", "a/f.00002.exr", "a/f.0001.5.exr", "a/f.0003.EXR",
                                 "a/f.1.exr", "b/F.+0004.exr"));
  // A frame of the other sequence is no near miss of this one.
  frames.given = {(folder_.path() / "a/f.%04d.exr").string(),
                  (folder_.path() / "a/f.%05d.exr").string()};
  EXPECT_THAT(pair_pictures(frames).misnamed,
              ::testing::Not(::testing::Contains(HasSubstr("f.00002.exr"))));
  frames.given[1] = (folder_.path() / "a/g.%03d.exr").string();
  EXPECT_THAT(refusal(frames, ExitCode::kInput), HasSubstr("a/g.1.exr nearly is one"));
}

TEST_F(SequencePairing, LeavesAFileAloneWhoseNameOnlyLooksLikeOne) {
  put("a/#1.exr");
  put("b/#1.exr");
  PairingChoice files = choice();
  for (std::string& file : files.given) file += "/#1.exr";
  EXPECT_TRUE(pair_pictures(files).is_one_row);
}

class TablePairing : public FolderPairing {
 protected:
  PairingChoice table(const std::string& text) {
    write_file(folder_.path() / "pairs.csv", text);
    PairingChoice choice;
    choice.csv = (folder_.path() / "pairs.csv").string();
    return choice;
  }
};

TEST_F(TablePairing, ReadsTitlesFromItsFirstLine) {
  const Pairing pairing =
      pair_pictures(table("\xef\xbb\xbfmine,name,reference,old\r\n"
                          "a/x.exr,first,b/x.exr,\r\n"
                          "\"a/with, comma and \"\"quote\"\".exr\",,b/y.exr,c/y.exr\n\n"
                          ",third,b/z.exr,c/z.exr"));
  EXPECT_THAT(pairing.sets, ElementsAre("mine", "reference", "old"));
  EXPECT_THAT(in_words(pairing).both, ElementsAre("b/y.exr", "first"));
  EXPECT_THAT(in_words(pairing).missing, ElementsAre("third"));
  EXPECT_THAT(files(pairing, 0), ElementsAre("a/with, comma and \"quote\".exr", "a/x.exr", "-"));
}

TEST_F(TablePairing, RefusesFilesWithoutATable) {
  for (const auto& [text, why] : {std::pair(std::string(), "is empty"),
                                  {"a\nx\n", "titles of two sets or more"},
                                  {"a,a\nx,y\n", "two sets have one title"},
                                  {"a,b\nx\n", "record 2 has 1 fields, the first 2"},
                                  {"a,b\n\"x,y\n", "a quotation mark is not closed"},
                                  {"a,b\n\"x\"z,y\n", "text after a quotation mark"},
                                  {"a,b\n,\n", "names no file"},
                                  {std::string("a,b\nx\0z,y\n", 10), "record 2 has a NUL"},
                                  {"a,b\nx,y\nz,y\n", "both are the picture of y"}})
    EXPECT_THAT(refusal(table(text), ExitCode::kInput), HasSubstr(why)) << text;
  PairingChoice both = table("a,b\nx,y\n");
  both.given = {"x"};
  EXPECT_THAT(refusal(both, ExitCode::kUsage), HasSubstr("leave out A, B"));
}

}  // namespace
}  // namespace lobelia

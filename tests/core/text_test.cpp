#include "core/text.hpp"

#include <gtest/gtest.h>

namespace lobelia {
namespace {

TEST(Suggestions, FindTheWordThatWasMeantAndNothingFarOff) {
  constexpr std::string_view kWords[] = {"cosine", "cs16", "schlick"};
  EXPECT_EQ(closest("cosin", kWords), "cosine");
  EXPECT_EQ(closest("cs61", kWords), "cs16");
  EXPECT_EQ(closest("cs1", kWords), "cs16");
  EXPECT_EQ(closest("banana", kWords), "");
  EXPECT_EQ(did_you_mean("schlik", kWords), "; did you mean 'schlick'?");
  EXPECT_EQ(closest(std::string(100000, 'x'), kWords), "");
}

TEST(Numbers, AreWholeFiniteAndNothingElse) {
  double value = 0;
  EXPECT_TRUE(parse_number(" 1.5e3 ", value));
  EXPECT_EQ(value, 1500);
  EXPECT_TRUE(parse_number("+2", value));
  for (const char* bad : {"", "1 2", "1x", "nan", "inf", "1e999", "0x10", "--1", "1,5"})
    EXPECT_FALSE(parse_number(bad, value)) << bad;
  long long whole = 0;
  EXPECT_TRUE(parse_integer("-7", whole));
  EXPECT_EQ(whole, -7);
  EXPECT_FALSE(parse_integer("7.0", whole));
  EXPECT_FALSE(parse_integer("99999999999999999999", whole));
}

TEST(Splitting, DropsEmptyPartsAndSpaces) {
  EXPECT_EQ(split(" a, b ,,c ", ","), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_TRUE(split("", ",").empty());
}

TEST(EscapedMarkup, HasNoMarkupAndNoControlCharacters) {
  EXPECT_EQ(escape_markup("<a href=\"x\">&'\x01\x1b"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
}

TEST(ShellQuoting, LeavesPlainWordsAndQuotesTheRest) {
  EXPECT_EQ(shell_quote("out/a.exr"), "out/a.exr");
  EXPECT_EQ(shell_quote(""), "''");
  EXPECT_EQ(shell_quote("a b"), "'a b'");
  EXPECT_EQ(shell_quote("it's $HOME"), "'it'\\''s $HOME'");
}

TEST(PrintableText, IsShortAndHasNoControlCharacters) {
  EXPECT_EQ(printable("a\x1b[31m\n"), "a?[31m?");
  EXPECT_EQ(printable("abcdef", 3), "abc...");
}

}  // namespace
}  // namespace lobelia

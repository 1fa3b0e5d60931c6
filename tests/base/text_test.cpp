#include "base/words/text.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(Suggestions, FindOnlySimilarWords) {
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

TEST(PrintableText, EscapesTerminalCommands) {
  EXPECT_EQ(printable("a\x1b[31m\n\t\r\x7f"), "a\\x1b[31m\\n\\t\\r\\x7f");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\u009b31m")
      << "a control character of two bytes";
  EXPECT_EQ(printable("a\xE2\x80\xAE"
                      "gpj.exr"),
            "a\\u202egpj.exr")
      << "written from right to left";
  EXPECT_EQ(printable("a\xEF\xBF\xBE"), "a\\ufffe") << "not allowed in XML";
  EXPECT_EQ(printable("a\xFFz\xE2\x82"), "a\\xffz\\xe2\\x82") << "no UTF-8";
  EXPECT_EQ(printable("\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x8C\x88 \\"),
            "\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x8C\x88 \\");
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  EXPECT_EQ(printable("ab\xC3\xA9", 3), "ab...") << "not half a character";
}

TEST(PrintableText, MakesOneLineOfUtf8WithoutControlCharactersOfAnyBytes) {
  std::mt19937 random(18);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes(random() % 40, '\0');
    for (char& c : bytes)
      c = char(random() % 4 == 0 ? 'a' + int(random() % 26) : int(random() % 256));
    const std::string text = printable(bytes, 1000);
    EXPECT_EQ(valid_utf8(text), text) << text;
    EXPECT_EQ(escape_invalid_utf8(text), text);
    for (const char c : text)
      EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) << text;
    EXPECT_EQ(valid_utf8(escape_invalid_utf8(bytes)), escape_invalid_utf8(bytes));
  }
}

TEST(EscapedUtf8, KeepsTwoNamesApartThatReplacementWouldMakeOne) {
  EXPECT_EQ(escape_invalid_utf8("a\xFF\n\xC3\xA9"), "a\\xff\n\xC3\xA9");
  EXPECT_NE(escape_invalid_utf8("a\xFF"), escape_invalid_utf8("a\xFE"));
  EXPECT_EQ(valid_utf8("a\xFF"), valid_utf8("a\xFE"));
}

TEST(ValidUtf8, ReplacesEachInvalidByte) {
  const std::string replaced = "\xEF\xBF\xBD";
  EXPECT_EQ(valid_utf8(""), "");
  EXPECT_EQ(valid_utf8("a\xC3\xA9\xE2\x82\xAC\xF0\x9F\x8C\x88"),
            "a\xC3\xA9\xE2\x82\xAC\xF0\x9F\x8C\x88");
  EXPECT_EQ(valid_utf8("a\xFFz"), "a" + replaced + "z");
  EXPECT_EQ(valid_utf8("\xE2\x82"), replaced + replaced) << "cut off";
  EXPECT_EQ(valid_utf8("\xC0\xAF"), replaced + replaced) << "a slash in two bytes";
  EXPECT_EQ(valid_utf8("\xE0\x80\xAF"), replaced + replaced + replaced);
  EXPECT_EQ(valid_utf8("\xED\xA0\x80"), replaced + replaced + replaced)
      << "half of a surrogate pair";
  EXPECT_EQ(valid_utf8("\xF4\x90\x80\x80"), replaced + replaced + replaced + replaced)
      << "past U+10FFFF";
  EXPECT_EQ(escape_markup("<\xFF>"), "&lt;" + replaced + "&gt;");
}

TEST(CsvField, IsInQuotesOnlyWhereItHasToBe) {
  EXPECT_EQ(csv_field("a b"), "a b");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
}

TEST(CsvField, PutsAnApostropheBeforeFormulas) {
  EXPECT_EQ(csv_field("=HYPERLINK(\"http://x\",1).exr"), "\"'=HYPERLINK(\"\"http://x\"\",1).exr\"");
  for (const char* text :
       {"=1+1", "+a", "-a", "@SUM(A1)", "\t=1", "-1+cmd|' /C calc'!A0", "+1.exr"})
    EXPECT_EQ(csv_field(text), "'" + std::string(text));
  for (const char* text : {"-0.5", "+1e-3", "-inf", "-nan", "-", "a=1", "'=1", " =1"})
    EXPECT_EQ(csv_field(text), text);
}

}  // namespace
}  // namespace lobelia

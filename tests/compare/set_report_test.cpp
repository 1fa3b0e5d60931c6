// Reports on a set of pictures, and their files.
#include <fmt/format.h>

#include <pugixml.hpp>

#include "compare/set/report.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

PairReport compared(const std::string& name, float value_a, float value_b) {
  const Image a = fixtures::flat(20, 20, value_a, value_a, value_a);
  const Image b = fixtures::flat(20, 20, value_b, value_b, value_b);
  ComparisonOptions options;
  options.limits = {{"rmse", 0.01}};
  return {name, "a/" + name, "b/" + name, "", compare(a, b, options), "", 0.25};
}

PairReport broken(const std::string& name) {
  return {name, "a/" + name, "b/" + name, "", {}, "not a readable picture, \"really\"", 0};
}

SetReport set_of(std::vector<PairReport> pairs) {
  return {"a", "b", "", std::move(pairs), {}, {}, 0};
}

TEST(SetExitCode, IsOfTheWorstThatHappened) {
  const PairReport good = compared("good.exr", 0.5f, 0.5f), off = compared("off.exr", 0.5f, 0.6f);
  const PairReport nan = compared("nan.exr", std::nanf(""), 0.5f);
  EXPECT_EQ(set_exit_code(set_of({good})), ExitCode::kSuccess);
  EXPECT_EQ(set_exit_code(set_of({good, off})), ExitCode::kDiffers);
  EXPECT_EQ(set_exit_code(set_of({good, nan})), ExitCode::kDiffers);
  EXPECT_EQ(set_exit_code(set_of({off, broken("x.exr"), good})), ExitCode::kInput);
  EXPECT_EQ(set_exit_code(set_of({})), ExitCode::kInput) << "nothing was compared";
  SetReport report = set_of({good});
  report.extra = {"new.exr"};
  EXPECT_EQ(set_exit_code(report), ExitCode::kSuccess);
  report.missing = {"gone.exr"};
  EXPECT_EQ(set_exit_code(report), ExitCode::kDiffers);
  report.missing.clear();
  report.not_followed = {"a/out"};
  EXPECT_EQ(set_exit_code(report), ExitCode::kDiffers) << "nobody looked at what is in there";
  report.not_followed.clear();
  report.misnamed = {"a/f.01.exr"};
  EXPECT_EQ(set_exit_code(report), ExitCode::kDiffers) << "nobody compared it";
  EXPECT_EQ(as_json(set_record(report))["misnamed"], Json({"a/f.01.exr"}));
  EXPECT_THAT(counts_text(report), HasSubstr("0 missing, 1 misnamed, 1 extra"));
  EXPECT_THAT(set_csv(report), HasSubstr("\r\na/f.01.exr,misnamed,\"nearly a frame"));
  EXPECT_THAT(set_junit(report, false), HasSubstr("tests=\"3\" failures=\"1\""));
}

/// Fields of RFC 4180, by a reader of its own.
std::vector<std::vector<std::string>> read_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"')
      rows.back().back() += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      rows.back().emplace_back();
    else if (c == '\r' && !quoted && i + 1 < text.size() && text[i + 1] == '\n')
      rows.emplace_back(1), ++i;
    else
      rows.back().back() += c;
  }
  if (rows.back() == std::vector<std::string>{""}) rows.pop_back();
  return rows;
}

TEST(SetOutcomes, HaveOneWordAndOneCountInEveryReport) {
  PairReport known = compared("known.exr", 0.5f, 0.6f);
  known.known = records::Known{"brighter", "9999-12-31", false};
  SetReport report =
      set_of({compared("off.exr", 0.5f, 0.6f), broken("x.exr"),
              compared("nan.exr", std::nanf(""), 0.5f), compared("good.exr", 0.5f, 0.5f), known});
  report.missing = {"gone.exr", "lost.exr"};
  report.extra = {"new.exr"};
  report.not_followed = {"a/out"};
  report.misnamed = {"a/f.01.exr"};
  EXPECT_EQ(counts_text(report),
            "5 pairs: 1 pass, 1 differ, 1 known to differ, 1 not finite, 1 errors; 2 missing, 1 "
            "misnamed, 1 links not followed, 1 extra");
  std::map<std::string, std::string> words;
  for (const NameOutcome& one : outcomes(report)) words[one.name] = one.word();
  EXPECT_EQ(words.size(), 10u);
  for (const Problem& one : problems(report)) EXPECT_EQ(words.at(one.name), one.what) << one.name;
  for (const auto& row : read_csv(set_csv(report)))
    if (words.contains(row[0]) && row[0] != "known.exr") {
      EXPECT_EQ(words.at(row[0]), row[1]);
    }
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(set_junit(report, false).c_str()));
  const auto suite = document.child("testsuites").child("testsuite");
  EXPECT_EQ(suite.attribute("tests").as_uint(), words.size());
  for (const auto one : suite.children("testcase"))
    if (const auto outcome = one.last_child(); outcome.attribute("type")) {
      EXPECT_EQ(words.at(one.attribute("name").as_string()), outcome.attribute("type").as_string());
    }
  const records::SetSummary counts = count(report);
  EXPECT_EQ(counts.pairs, 5u);
  EXPECT_EQ(counts.known, 1u);
  EXPECT_EQ(counts.missing, 2u);
  for (const CountedOutcome& one : counted_outcomes(report))
    EXPECT_THAT(set_markdown(report), HasSubstr(fmt::format("{} {}", one.count, one.words)));
}

TEST(SetOutcomes, FailForANameWithoutAReferenceIfAsked) {
  SetReport report = set_of({compared("good.exr", 0.5f, 0.5f)});
  report.extra = {"new.exr"};
  for (const bool fails : {false, true}) {
    report.missing_reference_fails = fails;
    EXPECT_EQ(set_exit_code(report), fails ? ExitCode::kDiffers : ExitCode::kSuccess);
    EXPECT_EQ(problems(report).front().weight,
              fails ? Problem::Weight::kFails : Problem::Weight::kNotice);
    EXPECT_THAT(set_junit(report, false),
                HasSubstr(fails ? "failures=\"1\" errors=\"0\" skipped=\"0\""
                                : "failures=\"0\" errors=\"0\" skipped=\"1\""));
  }
}

TEST(SetSummary, NamesTheWorstPairOfEachMetric) {
  const std::vector<PairReport> pairs{compared("near.exr", 0.5f, 0.51f),
                                      compared("below.exr", 0.3f, 0.5f), broken("x.exr"),
                                      compared("same.exr", 0.5f, 0.5f)};
  const auto summaries = summarise(pairs);
  const auto of = [&](std::string_view id) {
    for (const MetricSummary& one : summaries)
      if (one.id == id) return one;
    ADD_FAILURE() << id;
    return MetricSummary{};
  };
  EXPECT_EQ(of("rmse").worst_at->name, "below.exr");
  EXPECT_NEAR(of("rmse").mean, (0.01 + 0.2 + 0) / 3, 1e-6);
  EXPECT_EQ(of("drift").worst_at->name, "below.exr") << "-0.2 is further from 0 than -0.01";
  EXPECT_NEAR(of("drift").worst, -0.2, 1e-6);
  EXPECT_EQ(of("psnr").worst_at->name, "below.exr") << "a likeness: the lowest is the worst";
  for (const MetricSummary& one : summaries) EXPECT_NE(one.id, "max_abs.x") << "a fact";
}

TEST(SetCsv, HasARowForEveryNameAndAsManyFieldsInEach) {
  SetReport report = set_of({compared("a \"b\", c\r\nd.exr", 0.5f, 0.6f), broken("x.exr")});
  report.missing = {"gone.exr"};
  report.extra = {"new.exr"};
  report.not_followed = {"a/\x1b[2J\xff"};
  const auto rows = read_csv(set_csv(report));
  ASSERT_EQ(rows.size(), 6u);
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_EQ(rows[1][0], "a \"b\", c\\r\\nd.exr");
  EXPECT_EQ(rows[1][1], "differs");
  EXPECT_EQ(rows[2][1], "error");
  EXPECT_EQ(rows[3][1], "missing");
  EXPECT_EQ(rows[4][1], "extra");
  EXPECT_EQ(rows[5][0], "a/\\x1b[2J\\xff");
  EXPECT_EQ(rows[5][1], "not followed");
  const auto rmse = std::find(rows[0].begin(), rows[0].end(), "rmse");
  ASSERT_NE(rmse, rows[0].end());
  EXPECT_NEAR(std::stod(rows[1][std::size_t(rmse - rows[0].begin())]), 0.1, 1e-6);
  EXPECT_EQ(rows[2][std::size_t(rmse - rows[0].begin())], "");
}

TEST(SetJunit, IsXmlWithACaseForEveryNameWhateverItHolds) {
  PairReport known = compared("known.exr", 0.5f, 0.6f);
  known.known = records::Known{"brighter", "9999-12-31", false};
  SetReport report = set_of({compared("<img onerror>&\x01\xff.exr", 0.5f, 0.6f), broken("x.exr"),
                             compared("good.exr", 0.5f, 0.5f), known});
  report.missing = {"gone.exr"};
  report.extra = {"new.exr"};
  report.not_followed = {"a/out"};
  const std::string text = set_junit(report, false);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(text.c_str()));
  const auto suite = document.child("testsuites").child("testsuite");
  EXPECT_EQ(suite.attribute("tests").as_int(), 7);
  EXPECT_EQ(suite.attribute("failures").as_int(), 3);
  EXPECT_EQ(suite.attribute("errors").as_int(), 1);
  EXPECT_EQ(suite.attribute("skipped").as_int(), 2);
  std::vector<std::string> outcomes;
  for (const auto one : suite.children("testcase"))
    outcomes.emplace_back(one.child("failure")   ? "failure"
                          : one.child("error")   ? "error"
                          : one.child("skipped") ? "skipped"
                                                 : "pass");
  EXPECT_THAT(outcomes,
              ElementsAre("failure", "error", "pass", "skipped", "failure", "skipped", "failure"));
  EXPECT_STREQ(suite.child("testcase").attribute("name").as_string(),
               "<img onerror>&\\x01\\xff.exr");
  EXPECT_THAT(suite.child("testcase").child("failure").attribute("message").as_string(),
              HasSubstr("rmse is 0.1, limit 0.01"));
}

}  // namespace
}  // namespace lobelia

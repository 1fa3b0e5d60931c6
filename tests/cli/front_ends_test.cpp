// One judge: command line, Python, the C++ library and the farm say the same of the same pictures, to the last digit.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "compare/set/choice.hpp"
#include "farm/make_result.hpp"
#include "tests/cli/front_end_corpus.hpp"
#include "tests/cli/front_end_library.hpp"
#include "tests/cli/run_lobelia.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;
using ::testing::IsSupersetOf;
using Record = nlohmann::json;

constexpr int kPairs = 200;

/// A front end's answer: a record, or why there is none.
struct Answer {
  Record record;
  std::string error;
};

class FrontEnds : public ::testing::Test {
 protected:
  void SetUp() override {
    std::vector<int> numbers;
    for (int i = 0; i < kPairs; ++i) numbers.push_back(i);
    // By 11, so that the short suite has all kinds, too.
    for (const int number : some_of(numbers, 11))
      pairs_.push_back(make_pair_of_files(number, directory_.path()));
  }

  Answer command_line(const MadePair& pair,
                      const std::vector<std::pair<std::string, std::string>>& options) {
    std::vector<std::string> words{"compare", pair.a, pair.b, "--json", "record.json", "-q"};
    for (const auto& [name, value] : options)
      words.push_back(value == "true" ? "--" + name : fmt::format("--{}={}", name, value));
    const ProcessResult result = run_lobelia(words, directory_.path());
    if (result.exit_code != 0 && result.exit_code != 1 && result.exit_code != 6)
      return {nullptr, result.output_tail};
    Answer answer{Record::parse(read_file(directory_.path() / "record.json", 1 << 22)), ""};
    const std::string verdict = answer.record["verdict"];
    EXPECT_EQ(result.exit_code, verdict == "pass" || verdict == "same" ? 0
                                : verdict == "undecided"               ? 6
                                                                       : 1);
    return answer;
  }
  Answer library(const MadePair& pair, bool in_memory) {
    const LibraryAnswer answer = compare_by_library(pair.a, pair.b, pair.options, in_memory);
    return {answer.error.empty() ? Record::parse(answer.record) : Record(), answer.error};
  }
#ifdef LOBELIA_PYTHON_PROGRAM
  /// Answers for all pairs, from one process.
  std::vector<Record> python() {
    Record list = Record::array();
    for (const MadePair& pair : pairs_)
      list.push_back(
          {{"a", pair.a}, {"b", pair.b}, {"options", pair.options}, {"plain", pair.is_plain}});
    write_file(directory_.path() / "pairs.json", list.dump());
    const std::filesystem::path package =
        std::filesystem::path(LOBELIA_PROGRAM).parent_path().parent_path() / "python";
    ProcessOptions options;
    options.working_directory = directory_.path();
    const ProcessResult result =
        run_process({"/usr/bin/env", "PYTHONPATH=" + package.string(), LOBELIA_PYTHON_PROGRAM,
                     LOBELIA_SOURCE_DIR "/tests/cli/front_ends.py", "pairs.json", "found.json"},
                    options);
    EXPECT_EQ(result.exit_code, 0) << result.output_tail;
    return Record::parse(read_file(directory_.path() / "found.json", 1 << 26));
  }
#endif

  TemporaryDirectory directory_;
  std::vector<MadePair> pairs_;
};

/// The same record. Of pictures in memory it lacks what the files alone say, and the names.
void expect_same(const Answer& found, const Answer& wanted, bool in_memory) {
  if (!wanted.error.empty()) {
    // The names of the files are not those of arrays.
    if (!in_memory) {
      EXPECT_THAT(wanted.error, HasSubstr(found.error.substr(0, 150)));
    }
    EXPECT_NE(found.error, "");
    return;
  }
  ASSERT_EQ(found.error, "");
  if (!in_memory) {
    EXPECT_EQ(found.record, wanted.record);
    return;
  }
  for (const char* key : {"verdict", "metrics", "limits", "warnings", "viewing", "notMeasured",
                          "uncertainty", "errorBars", "highlight", "mask", "crop"})
    EXPECT_EQ(found.record.value(key, Record()), wanted.record.value(key, Record())) << key;
}

TEST_F(FrontEnds, JudgeEveryPairAlike) {
#ifdef LOBELIA_PYTHON_PROGRAM
  const std::vector<Record> of_python = python();
  ASSERT_EQ(of_python.size(), pairs_.size());
#endif
  std::set<std::string> verdicts, kinds;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const MadePair& pair = pairs_[i];
    SCOPED_TRACE(fmt::format("pair {}, {}", pair.number, pair.kind));
    const Answer wanted = command_line(pair, pair.options);
    kinds.insert(pair.kind);
    verdicts.insert(wanted.error.empty() ? std::string(wanted.record["verdict"]) : "error");
    expect_same(library(pair, false), wanted, false);
    if (pair.is_plain) expect_same(library(pair, true), wanted, true);
#ifdef LOBELIA_PYTHON_PROGRAM
    const auto answer_of = [](const Record& one) {
      return Answer{one.value("record", Record()), one.value("error", "")};
    };
    expect_same(answer_of(of_python[i]["files"]), wanted, false);
    if (pair.is_plain) expect_same(answer_of(of_python[i]["arrays"]), wanted, true);
#endif
  }
  EXPECT_EQ(kinds.size(), 8u);
  for (const char* verdict : {"pass", "differs"}) EXPECT_EQ(verdicts.count(verdict), 1u);
  if (int(pairs_.size()) == kPairs) {
    EXPECT_THAT(verdicts, IsSupersetOf({"error", "non-finite", "same", "different", "undecided"}));
  }
}

/// The figures and limits that the farm has are those of the command line, which has more.
void expect_within(const Comparison& found, const Record& wanted) {
  EXPECT_EQ(std::string(verdict_name(found.verdict)), std::string(wanted["verdict"]));
  const Record own =
      Record::parse(records::record_text(comparison_record(found, wanted["a"], wanted["b"])));
  EXPECT_GT(own["metrics"].size(), 10u);
  for (const auto& [id, value] : own["metrics"].items())
    EXPECT_EQ(value, wanted["metrics"].value(id, Record())) << id;
  EXPECT_EQ(own["limits"], wanted["limits"]);
}

TEST_F(FrontEnds, JudgeACellAsTheFarmDoes) {
  std::size_t compared = 0;
  for (const MadePair& pair : pairs_) {
    const bool has_noise = !pair.a_error.empty();
    if (!has_noise && pair.kind != "peaks") continue;
    SCOPED_TRACE(fmt::format("pair {}, {}", pair.number, pair.kind));
    const Image a = read_image(pair.a), b = read_image(pair.b);
    constexpr double kExposure = -1.25;
    const Tolerance tolerance{.relative = 6e-4, .of_peak = 1.5e-5, .allowed_outliers = 3};
    std::vector<std::pair<std::string, std::string>> options{
        {"no-default-limits", "true"},
        {"exposure", fmt::format("{}", kExposure)},
        {"tolerance", fmt::format("{},{},{}", tolerance.relative, tolerance.of_peak,
                                  tolerance.allowed_outliers)}};
    std::optional<NoiseOptions> noise;
    if (has_noise) {
      noise = NoiseOptions{.a = noise_of_standard_errors(read_image(pair.a_error), 15, true),
                           .b = noise_of_standard_errors(read_image(pair.b_error), 15, true)};
      for (const MetricLimit& limit : default_limits())
        options.emplace_back("fail", fmt::format("{}={}", limit.metric, limit.limit));
      options.emplace_back("a-error", pair.a_error);
      options.emplace_back("b-error", pair.b_error);
    }
    const Answer wanted = command_line(pair, options);
    ASSERT_EQ(wanted.error, "");
    expect_within(judge_cell(a, b, kExposure, tolerance, std::move(noise)), wanted.record);
    ++compared;
  }
  EXPECT_GT(compared, pairs_.size() / 8);
}

TEST(OptionsOfAComparison, AreReadByNameAsOnTheCommandLine) {
  for (const CompareOption& option : compare_options()) {
    SCOPED_TRACE(option.name);
    EXPECT_FALSE(option.name.empty());
    std::string name(option.name);
    std::ranges::replace(name, '-', '_');
    const bool is_flag = std::holds_alternative<bool CompareChoice::*>(option.place);
    const std::string value = !option.words.empty() ? option.words.front()
                              : is_flag             ? "true"
                              : option.most > 0     ? fmt::format("{}", option.most)
                                                    : "text";
    std::vector<GivenOption> given{{name, std::vector{value}}};
    for (const std::string_view needed : option.needs)
      given.push_back({std::string(needed), std::vector<std::string>{"auto"}});
    EXPECT_NO_THROW(read_choice(given));
    given[0].name += "_x";
    EXPECT_THROW(read_choice(given), Error);
  }
  EXPECT_THROW(read_choice(std::vector<GivenOption>{{"layer", std::vector<std::string>{"Z"}},
                                                    {"all_layers", std::vector<std::string>{}}}),
               Error);
  EXPECT_THROW(
      read_choice(std::vector<GivenOption>{{"tone_curve", std::vector<std::string>{"aces"}}}),
      Error);
  EXPECT_THROW(read_choice(std::vector<GivenOption>{{"layer", std::vector<std::string>{"Z"}}},
                           CompareOption::For::kPictures),
               Error);
}

}  // namespace
}  // namespace lobelia

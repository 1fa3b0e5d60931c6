// One judge: command line, Python, the C++ library and the farm say the same of the same pictures, to the last digit.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "compare/set/choice.hpp"
#include "farm/make_result.hpp"
#include "tests/more_samples.hpp"
#include "tests/program/front_end_library.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;
using Record = nlohmann::json;
using Options = std::vector<std::pair<std::string, std::string>>;

const std::string kPairs = LOBELIA_SOURCE_DIR "/tests/pairs/";

/// A pair of tests/pairs, and the options that it is compared with.
struct Asked {
  std::string name, a, b;
  /// By the names of the command line; a flag has "true". One that is given twice stands twice.
  Options options;
  bool is_plain = false;  ///< an array holds all of it, and may have these options
};

/// Whether a file has R, G and B in floats and nothing else.
bool is_plain(const std::string& file) {
  const Picture picture = read_picture(file, "");
  return picture.source.value_type == "float" && picture.source.layers.size() == 1 &&
         picture.source.chromaticities.empty() && picture.overscan.pixel_count() == 0;
}

/// With what a pair is compared. `error` is a picture of standard errors.
std::vector<Options> lists_of_options(const std::string& error) {
  const std::string one = "must_pass/a/soft_light_of_another_seed.exr",
                    other = "must_pass/b/soft_light_of_another_seed.exr";
  return {{},
          {{"exposures", "auto"}},
          {{"exposures", "-2,2,3"}, {"tone-curve", "reinhard"}, {"exposure", "-1.5"}},
          {{"crop", "2,3,9,8"}, {"mask", "rect:4,4,6,6"}},
          {{"ignore", "rect:0,0,4,4"}, {"ignore", "polygon:1,1 9,1 9,9"}},
          {{"tolerance", "1e-3,1e-6,2"}, {"fail", "rmse=0.25"}},
          {{"no-default-limits", "true"}, {"fail", "psnr=40"}, {"warn", "mae=0"}},
          {{"metrics", "rmse,flip.ldr,colour"}, {"fail", "share_over.abs=0.004=10%"}},
          {{"metrics", "all"}, {"pixels-per-degree", "40"}},
          {{"display-distance", "1.2"}, {"display-width", "0.5"}, {"fail", "rmse=-1"}},
          {{"allow-equal-nonfinite", "true"}, {"crop", "3,3,2,1"}},
          {{"all-layers", "true"}},
          {{"layer", "A"}},
          {{"ignore-alpha", "true"}},
          {{"bootstrap", "4"},
           {"seed", "3"},
           {"a-error", error},
           {"b-error", error},
           {"significance", "0.001"}},
          {{"bootstrap", "4"},
           {"seed", "3"},
           {"a-replicate", kPairs + one},
           {"b-replicate", kPairs + other}},
          {{"bootstrap", "4"},
           {"a-error", error},
           {"b-error", error},
           {"no-default-limits", "true"},
           {"fail", "rmse=5"}}};
}

bool is_for_arrays(const Options& options) {
  return std::ranges::none_of(options, [](const auto& option) {
    return option.first.find("layer") != std::string::npos || option.first == "ignore-alpha";
  });
}

/// A front end's answer: a record, or why there is none.
struct Answer {
  Record record;
  std::string error;
};

class FrontEnds : public ::testing::Test {
 protected:
  void SetUp() override {
    Image errors(32, 32);
    std::ranges::fill(errors.values(), 0.01f);
    write_exr(error_, errors, {});
    std::vector<std::filesystem::path> files;
    for (const char* set : {"must_pass/a", "must_fail/a"})
      for (const auto& entry : std::filesystem::directory_iterator(kPairs + set))
        files.push_back(entry.path());
    std::ranges::sort(files);
    const std::vector<Options> lists = lists_of_options(error_);
    for (int turn = 0; turn < more_samples(); ++turn)
      for (std::size_t i = 0; i < files.size(); ++i) {
        const fs::path b = files[i].parent_path().parent_path() / "b" / files[i].filename();
        const Options& options = lists[(i + 7 * std::size_t(turn)) % lists.size()];
        pairs_.push_back({files[i].filename(), files[i], b, options,
                          is_for_arrays(options) && is_plain(files[i]) && is_plain(b)});
      }
  }

  Answer command_line(const Asked& pair, const Options& options) {
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
  Answer library(const Asked& pair, bool in_memory) {
    const LibraryAnswer answer = compare_by_library(pair.a, pair.b, pair.options, in_memory);
    return {answer.error.empty() ? Record::parse(answer.record) : Record(), answer.error};
  }
#ifdef LOBELIA_PYTHON_PROGRAM
  /// Answers for all pairs, from one process.
  std::vector<Record> python() {
    Record list = Record::array();
    for (const Asked& pair : pairs_)
      list.push_back(
          {{"a", pair.a}, {"b", pair.b}, {"options", pair.options}, {"plain", pair.is_plain}});
    write_file(directory_.path() / "pairs.json", list.dump());
    const std::filesystem::path package =
        std::filesystem::path(LOBELIA_PROGRAM).parent_path().parent_path() / "python";
    ProcessOptions options;
    options.working_directory = directory_.path();
    const ProcessResult result =
        run_process({"/usr/bin/env", "PYTHONPATH=" + package.string(), LOBELIA_PYTHON_PROGRAM,
                     LOBELIA_SOURCE_DIR "/tests/program/front_ends.py", "pairs.json", "found.json"},
                    options);
    EXPECT_EQ(result.exit_code, 0) << result.output_tail;
    return Record::parse(read_file(directory_.path() / "found.json", 1 << 26));
  }
#endif

  TemporaryDirectory directory_;
  const std::string error_ = directory_.path() / "error.exr";
  std::vector<Asked> pairs_;
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
  std::set<std::string> verdicts;
  std::size_t arrays = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Asked& pair = pairs_[i];
    SCOPED_TRACE(pair.name + " " + testing::PrintToString(pair.options));
    const Answer wanted = command_line(pair, pair.options);
    verdicts.insert(wanted.error.empty() ? std::string(wanted.record["verdict"]) : "error");
    arrays += pair.is_plain;
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
  EXPECT_THAT(verdicts, testing::IsSupersetOf(
                            {"pass", "differs", "non-finite", "different", "undecided", "error"}));
  EXPECT_GT(arrays, 20u);
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
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Asked& pair = pairs_[i];
    const bool has_noise = i % 2 == 0;
    const Image a = read_image(pair.a), b = read_image(pair.b);
    if (!pair.is_plain || a.width() != 32) continue;
    SCOPED_TRACE(pair.name + (has_noise ? " with noise" : ""));
    constexpr double kExposure = -1.25;
    const Tolerance tolerance{.relative = 6e-4, .of_peak = 1.5e-5, .allowed_outliers = 3};
    Options options{{"no-default-limits", "true"},
                    {"exposure", fmt::format("{}", kExposure)},
                    {"tolerance", fmt::format("{},{},{}", tolerance.relative, tolerance.of_peak,
                                              tolerance.allowed_outliers)}};
    std::optional<NoiseOptions> noise;
    if (has_noise) {
      const Image errors = read_image(error_);
      noise = NoiseOptions{.a = noise_of_standard_errors(errors, 15, true),
                           .b = noise_of_standard_errors(errors, 15, true)};
      for (const MetricLimit& limit : default_limits())
        options.emplace_back("fail", fmt::format("{}={}", limit.metric, limit.limit));
      options.emplace_back("a-error", error_);
      options.emplace_back("b-error", error_);
    }
    const Answer wanted = command_line(pair, options);
    ASSERT_EQ(wanted.error, "");
    if (wanted.record["verdict"] == "non-finite") continue;
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

#include "base/records/record.hpp"

#include "base/records/result.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia::records {

constexpr std::string_view kColours[] = {"red", "green"};

struct Part {
  int count = 0;
  std::optional<double> size;
};

struct Sample {
  std::string name, colour = "red", file = "a.png";
  double any = 0;
  std::vector<Part> parts;
  Named<std::array<double, 2>> pairs;
  std::optional<int> nothing;
  std::uint64_t seed = 0;
};

template <>
const Struct& struct_type<Part>() {
  static const Struct type = detail::make_struct<Part>("A part.", [](auto& t) {
    t.key("count").at_least(0);
    t.key("size").within(0, 1);
  });
  return type;
}

template <>
const Struct& struct_type<Sample>() {
  static const Struct type = detail::make_struct<Sample>("A sample.", [](auto& t) {
    t.kind("sample");
    t.key("name").most_text(8);
    t.key("colour").one_of(kColours);
    t.key("file").plain_name();
    t.key("any").may_be_nonfinite();
    t.key("parts").items(0, 3);
    t.key("nothing").or_null();
    t.check([](const Sample& sample) -> std::string {
      return sample.name == "none" && !sample.parts.empty() ? "none has parts" : "";
    });
  });
  return type;
}

namespace {

Sample sample() {
  Sample made;
  made.name = "x";
  made.parts = {{3, 0.5}, {0, std::nullopt}};
  made.pairs = {{"zebra", {1, 2}}, {"ant", {0.1, -1e300}}};
  made.seed = std::numeric_limits<std::uint64_t>::max();
  return made;
}

/// The error for the sample with another value at a place.
std::string refusal(const std::string& pointer, const Json& value) {
  Json json = as_json(sample());
  json[Json::json_pointer(pointer)] = value;
  try {
    parse_record<Sample>(json.dump(), "r.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    return error.what();
  }
  return "";
}

TEST(Records, ReadBackAsWrittenInTheSameOrder) {
  const std::string text = record_text(sample());
  const Sample back = parse_record<Sample>(text, "r.json");
  EXPECT_EQ(record_text(back), text);
  EXPECT_EQ(back.parts[0].size, 0.5);
  EXPECT_EQ(back.seed, sample().seed);
  EXPECT_EQ(back.pairs[0].first, "zebra");
}

TEST(Records, NameNumbersThatJsonDoesNotHave) {
  Sample made = sample();
  for (const auto& [value, name] : {std::pair(std::numeric_limits<double>::quiet_NaN(), "nan"),
                                    {kNoBound, "inf"},
                                    {-kNoBound, "-inf"}}) {
    made.any = value;
    EXPECT_EQ(as_json(made)["any"], name);
    const double back = parse_record<Sample>(record_text(made), "").any;
    EXPECT_TRUE(std::isnan(value) ? std::isnan(back) : back == value) << name;
  }
}

TEST(Records, StateThePlaceOfAnErrorWithAllowedValues) {
  EXPECT_EQ(refusal("/parts/1/count", "3"), "r.json: parts[1].count: not an integer");
  EXPECT_EQ(refusal("/parts/1/count", 0.5), "r.json: parts[1].count: not an integer");
  EXPECT_EQ(refusal("/parts/0/count", -1), "r.json: parts[0].count: -1; allowed: at least 0");
  EXPECT_EQ(refusal("/parts/0/count", 1e18), "r.json: parts[0].count: 1e+18 is out of range");
  EXPECT_EQ(refusal("/parts/0/size", 2), "r.json: parts[0].size: 2; allowed: 0 to 1");
  EXPECT_EQ(refusal("/parts/0/size", "nan"), "r.json: parts[0].size: not a number");
  EXPECT_EQ(refusal("/parts/0", 7), "r.json: parts[0]: not an object");
  EXPECT_EQ(refusal("/parts", 7), "r.json: parts: not a list");
  EXPECT_EQ(refusal("/pairs/ant/1", nullptr), "r.json: pairs.ant[1]: not a number");
  EXPECT_EQ(refusal("/pairs/ant", {1, 2, 3}), "r.json: pairs.ant: 3 items; allowed: 2");
  EXPECT_EQ(refusal("/colour", "blue"), "r.json: colour: 'blue'; allowed: red, green");
  EXPECT_EQ(refusal("/file", "../a.png"), "r.json: file: '../a.png' is no plain name of a file");
  EXPECT_EQ(refusal("/name", "much too long"), "r.json: name: 13 bytes; allowed: at most 8");
  EXPECT_EQ(refusal("/name", "none"), "r.json: none has parts");
  EXPECT_EQ(refusal("/kind", "cell"), "r.json: not a record of kind 'sample'");
  EXPECT_EQ(refusal("/schemaVersion", 2), "r.json: its schemaVersion is not 1");
  EXPECT_EQ(refusal("/madeOfTomorrow", {}), "") << "keys may be added";
  EXPECT_EQ(refusal("/parts/1/count", 3.0), "") << "a program may have no integers";
}

TEST(Records, AreRefusedFromAnyOtherText) {
  for (const char* text : {"", "{", "[]", "7", "null", R"({"kind":"sample"})", "{}{}"})
    EXPECT_THROW(parse_record<Sample>(text, "r.json"), Error) << text;
  std::string deep(100'000, '[');
  EXPECT_THROW(parse_record<Sample>(deep, "r.json"), Error);
}

TEST(Records, AreWrittenThoughTheirBytesAreNotUtf8) {
  Sample made = sample();
  made.name = "caf\xe9";
  EXPECT_EQ(as_json(made)["name"], "caf\\xe9");
}

TEST(SealedRecords, ShowEveryChange) {
  KnownHashes made;
  made.files = {{"/bin/sh", "1 2 3", "abc"}};
  const std::string text = record_text(made);
  EXPECT_EQ(parse_record<KnownHashes>(text, "").files, made.files);
  Json changed = Json::parse(text);
  changed["files"][0][2] = "abd";
  EXPECT_THROW(parse_record<KnownHashes>(changed.dump(), ""), Error);
  EXPECT_NO_THROW(parse_record<KnownHashes>(sealed(changed).dump(), ""));
  changed.erase("seal");
  EXPECT_THROW(parse_record<KnownHashes>(changed.dump(), ""), Error);
}

}  // namespace
}  // namespace lobelia::records

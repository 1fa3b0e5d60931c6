#include "core/record.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.hpp"
#include "core/files.hpp"

namespace lobelia {
namespace {

TEST(Records, ReadBackAsWrittenInTheSameOrder) {
  const TemporaryDirectory directory;
  Json record = make_record("render");
  record["zebra"] = 1.0 / 3;
  record["ant"] = {1, 2};
  write_record(directory.path() / "r.json", record);
  const Json back = read_record(directory.path() / "r.json", "render");
  EXPECT_EQ(back, record);
  EXPECT_EQ(back.dump(), record.dump());
}

TEST(Records, NameNumbersThatJsonDoesNotHave) {
  Json record = make_record("x");
  record["a"] = std::numeric_limits<double>::quiet_NaN();
  record["b"] = {{"c", -std::numeric_limits<double>::infinity()}};
  const Json back = Json::parse(record_text(record));
  EXPECT_EQ(back["a"], "nan");
  EXPECT_EQ(back["b"]["c"], "-inf");
}

TEST(Records, OfAnotherKindOrVersionOrBrokenAreRefused) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "r.json";
  for (const char* text : {"", "{", "[]", "7", "{\"kind\":\"plan\",\"schemaVersion\":1}",
                           "{\"kind\":\"render\",\"schemaVersion\":2}", "{\"kind\":\"render\"}"}) {
    write_file(path, text);
    EXPECT_THROW(read_record(path, "render"), Error) << text;
  }
}

TEST(Records, WithBytesThatAreNotUtf8AreStillWritten) {
  Json record = make_record("x");
  record["log"] = "caf\xe9";
  EXPECT_NO_THROW(Json::parse(record_text(record)));
}

}  // namespace
}  // namespace lobelia

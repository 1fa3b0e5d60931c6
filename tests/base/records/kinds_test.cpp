// Laws that hold of every kind of record, on records at random that its schema allows.
#include "base/records/catalogue.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "lobelia_paths.hpp"
#include "tests/json_schema.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia::records {
namespace {

/// Makes JSON that a schema allows.
class RandomRecords {
 public:
  RandomRecords(const Kind& kind, unsigned seed)
      : schema_(Json::parse(schema_text(kind))), random_(seed) {}

  Json record() {
    Json made = object(schema_);
    for (const char* key : {"schemaVersion", "kind"})  // what people write may lack them
      made[key] = schema_["properties"][key]["const"];
    if (made["kind"] == "project") made.erase("pairs");
    if (made.contains("seal")) made = sealed(std::move(made));
    return made;
  }

 private:
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }

  Json value(const Json& schema) {
    if (schema.contains("allOf")) return value(schema["allOf"][0]);
    if (schema.contains("$ref")) {
      const std::string name = schema["$ref"].get<std::string>().substr(14);
      return known(name, object(schema_["definitions"][name]));
    }
    if (schema.contains("anyOf")) return value(schema["anyOf"][below(schema["anyOf"].size())]);
    if (schema.contains("const")) return schema["const"];
    if (schema.contains("enum")) return schema["enum"][below(schema["enum"].size())];
    const std::string type = schema["type"];
    if (type == "null") return nullptr;
    if (type == "boolean") return below(2) == 0;
    if (type == "string") return text(schema);
    if (type == "number" || type == "integer") return number(schema, type == "integer");
    if (type == "array") {
      Json list = Json::array();
      const std::size_t least = schema.value("minItems", 0), most = schema.value("maxItems", 1000);
      for (std::size_t i = 0, n = std::min(most, least + below(3)); i < n; ++i)
        list.push_back(value(schema["items"]));
      return list;
    }
    Json members = Json::object();
    const std::size_t least = schema.value("minProperties", 0),
                      most = schema.value("maxProperties", 1000);
    for (std::size_t i = 0, n = std::min(most, least + below(3)); i < n; ++i)
      members["name " + std::to_string(i)] = value(schema["additionalProperties"]);
    return members;
  }

  Json text(const Json& schema) {
    constexpr const char* kTexts[] = {"x", "", "ä → b", "a \"b\" \\ c\n", "</script><b>"};
    if (schema.contains("pattern")) return "file.png";
    const Json text = kTexts[below(std::size(kTexts))];
    return text == "" && schema.contains("minLength") ? "x" : text;
  }

  Json number(const Json& schema, bool is_integer) {
    if (schema.contains("exclusiveMinimum")) return 0.5;
    const double least = schema.value("minimum", is_integer ? -1000.0 : -1e300),
                 most = schema.value("maximum", is_integer ? least + 2000 : 1e300);
    const double at = std::uniform_real_distribution<double>(0, 1)(random_);
    const double number = below(4) == 0   ? least
                          : below(4) == 0 ? most
                                          : least + at * (most - least);
    if (is_integer) return std::int64_t(number);
    return std::clamp(number, least, most);
  }

  Json object(const Json& schema) {
    Json made = Json::object();
    for (const auto& [key, of_key] : schema["properties"].items()) {
      const auto required_keys = schema["required"].get<std::set<std::string>>();
      const bool required = required_keys.contains(key);
      if (required || below(2) == 0) made[key] = value(of_key);
    }
    if (schema.contains("additionalProperties") && schema["additionalProperties"] != false)
      for (std::size_t i = 0, n = below(3); i < n; ++i)
        made["other " + std::to_string(i)] = value(schema["additionalProperties"]);
    return made;
  }

  /// Sets values that no schema states: see the checks of the tables.
  Json known(const std::string& name, Json made) {
    if (name == "NonfinitePlace") made["value"] = "nan";
    if (name == "CosineLobe") made["because"] = "why";
    if (name == "KnownDifference") made["expires"] = "2027-01-31";
    if (name == "LayerComparison") made["identical"] = true;
    if (name == "PairOfSet" && made.contains("comparison")) made.erase("error");
    if (name == "PairOfSet" && !made.contains("comparison")) made["error"] = "why";
    // Columns are equally long.
    if (name == "ProfileCurve" || name == "ChartSeries" || name == "StabilityCurve") {
      const std::size_t count = below(3);
      for (auto& [key, column] : made.items())
        if (column.is_array()) column = Json(count, 7);
    }
    return made;
  }

  Json schema_;
  std::mt19937 random_;
};

class EveryKind : public testing::TestWithParam<Kind> {};

std::string name_of(const testing::TestParamInfo<Kind>& info) {
  std::string name(info.param.type().kind());
  std::ranges::replace(name, '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Records, EveryKind, testing::ValuesIn(kinds().begin(), kinds().end()),
                         name_of);

/// Without the keys that a writer fills in, and without those that are empty, which may be left out.
Json plain(const Json& json) {
  if (!json.is_object()) {
    Json list = json;
    if (json.is_array())
      for (Json& item : list) item = plain(item);
    return list;
  }
  Json object = Json::object();
  for (const auto& [key, value] : json.items()) {
    const bool is_empty =
        value.is_null() || value == "" || (value.is_structured() && value.empty());
    if (!is_empty && key != "seal" && key != "madeBy") object[key] = plain(value);
  }
  return object;
}

TEST_P(EveryKind, IsReadBackAsItIs) {
  const JsonSchema schema(schema_text(GetParam()));
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Json record = RandomRecords(GetParam(), seed).record();
    std::string text;
    ASSERT_NO_THROW(text = GetParam().reread(record.dump(), "r.json")) << record.dump(1);
    EXPECT_EQ(GetParam().reread(text, "r.json"), text);
    ASSERT_EQ(Plain(plain(Json::parse(text))), Plain(plain(record)));
    EXPECT_EQ(schema.problems(Plain(record)), "");
  }
}

void list_places(const Json& json, const Json::json_pointer& at,
                 std::vector<Json::json_pointer>& places) {
  if (json.is_object())
    for (const auto& [key, value] : json.items()) {
      places.push_back(at / key);
      list_places(value, at / key, places);
    }
  if (json.is_array())
    for (std::size_t i = 0; i < json.size(); ++i) list_places(json[i], at / i, places);
}

TEST_P(EveryKind, RefusesAnotherTypeAtAnyPlace) {
  const JsonSchema schema(schema_text(GetParam()));
  std::size_t refused = 0;
  for (unsigned seed = 0; seed < 10U * unsigned(more_samples()); ++seed) {
    const Json good = RandomRecords(GetParam(), seed).record();
    std::vector<Json::json_pointer> places;
    list_places(good, Json::json_pointer(), places);
    for (const auto& place : places) {
      if (place.back() == "madeBy") continue;
      Json bad = good;
      // No key has this type.
      bad[place] = good[place].is_array() ? Json::object({{"", Json::array()}})
                                          : Json::array({Json::object()});
      if (bad.contains("seal") && place.back() != "seal") bad = sealed(std::move(bad));
      EXPECT_NE(schema.problems(Plain(bad)), "") << place;
      try {
        GetParam().reread(bad.dump(), "r.json");
        ADD_FAILURE() << place << " of " << bad.dump(1);
        return;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::kInput);
        EXPECT_THAT(error.what(), testing::StartsWith("r.json: "));
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 0u);
}

TEST_P(EveryKind, RequiresTheKeysOfItsSchema) {
  const Json good = RandomRecords(GetParam(), 1).record();
  const Json schema = Json::parse(schema_text(GetParam()));
  for (const auto& key : schema["required"]) {
    if (key == "madeBy") continue;
    Json bad = good;
    bad.erase(key.get<std::string>());
    if (bad.contains("seal")) bad = sealed(std::move(bad));
    EXPECT_THROW(GetParam().reread(bad.dump(), "r.json"), Error) << key;
  }
}

/// The only kind that people write, so an editor fetches its schema from the source.
TEST(Kinds, HaveTheSchemaOfAProjectInTheSource) {
  const std::string file = LOBELIA_SOURCE_DIR "/docs/reference/project.schema.json";
  const auto project = std::ranges::find_if(
      kinds(), [](const Kind& kind) { return kind.type().kind() == "project"; });
  ASSERT_NE(project, kinds().end());
  EXPECT_EQ(read_file(file, 1 << 20), schema_text(*project))
      << "run: lobelia records project > docs/reference/project.schema.json";
}

TEST(Kinds, HavePagesThatTheIndexLinks) {
  for (const Kind& kind : kinds()) {
    const std::string name(kind.type().kind());
    EXPECT_THAT(reference_index(), testing::HasSubstr("(" + name + ".md)"));
    EXPECT_THAT(reference_page(kind), testing::HasSubstr("(" + name + ".schema.json)"));
    EXPECT_THAT(reference_page(kind), testing::HasSubstr(std::string(kind.type().meaning())));
  }
}

TEST(Kinds, HaveSortedUniqueNames) {
  std::set<std::string_view> names;
  for (const Kind& kind : kinds()) {
    const Struct& type = kind.type();
    EXPECT_TRUE(names.empty() || *names.rbegin() < type.kind()) << type.kind() << " out of order";
    names.insert(type.kind());
    EXPECT_TRUE(type.meaning().ends_with('.') || type.meaning().ends_with("'.")) << type.kind();
  }
}

TEST(Kinds, GiveEachStructOneName) {
  std::map<std::string_view, const Struct*> names;
  Definitions definitions;
  for (const Kind& kind : kinds()) definitions.add(kind.type());
  for (const Struct* type : definitions.all())
    EXPECT_TRUE(names.emplace(type->name(), type).second) << type->name();
}

}  // namespace
}  // namespace lobelia::records

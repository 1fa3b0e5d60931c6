#include "renderer/kernels/kernels.hpp"
#include "verify/stability/meanings.hpp"
#include "verify/stability/report.hpp"

namespace lobelia::stability {
namespace {

Json errors(const Answer& a) {
  return {{"ofPeak", a.of_peak}, {"ulp", a.ulp}, {"wrongPixels", a.wrong_pixels}};
}
Json with_value(const Answer& a) {
  Json json = {{"value", a.value}};
  json.update(errors(a));
  return json;
}

Json summaries(const std::vector<Summary>& all, const char* name) {
  Json array = Json::array();
  for (const Summary& s : all) {
    Json json{{"group", s.group}, {name, s.name}};
    if (s.exponent > 0) json["exponent"] = s.exponent;
    const std::string_view meaning = meaning_of_case(s.group, s.name);
    if (!meaning.empty()) json["meaning"] = meaning;
    json.update({{"cases", s.cases},
                 {"outside", s.outside},
                 {"notCompared", s.not_compared},
                 {"naive", errors(s.naive)},
                 {"ours", errors(s.ours)},
                 {"ofBound", s.of_bound}});
    array.push_back(json);
  }
  return array;
}

Json curve_json(const ErrorCurve& c) {
  Json json{{"exponent", c.exponent}, {"model", c.model}, {"lobe", c.lobe}};
  json["degrees"] = c.degrees;
  for (const auto& [name, values] :
       {std::pair{"truth", &c.truth}, {"naive", &c.naive}, {"ours", &c.ours}})
    for (const double value : *values) json[name].push_back(number_or_name(value));
  return json;
}

Json row_json(const Row& r) {
  Json json = {{"group", r.group}, {"case", r.name}};
  if (!r.model.empty()) json["model"] = r.model;
  json.update({{"lobe", r.lobe},
               {"exponent", r.exponent},
               {"truth", r.truth},
               {"naive", with_value(r.naive)},
               {"ours", with_value(r.ours)},
               {"bound", {{"ofPeak", r.bound_of_peak}, {"ulp", r.bound_ulp}}},
               {"outcome", name(r.outcome)}});
  return json;
}

Json timing(const Timing& t) { return {{"median", t.median_ns}, {"spread", t.spread_ns}}; }

Json picture(const std::filesystem::path& directory, const PicturePair& p, const char* name,
             double error) {
  const std::string stem = (directory / picture_stem(p.exponent, name)).generic_string();
  return {{"exr", stem + ".exr"},
          {"png", stem + ".png"},
          {"error", stem + "-error.png"},
          {"largestErrorOfPeak", error}};
}

}  // namespace

Json report_record(const Report& report, const std::vector<std::string>& command,
                   const std::filesystem::path& pictures, bool all) {
  Json record = make_record("verify-stability");
  record["command"] = command;
  record["instructionSet"] = kernels().instruction_set;
  record["cases"] = report.rows.size();
  record["outside"] = report.count(Outcome::kOutside);
  record["notCompared"] = report.count(Outcome::kNotCompared);
  for (const Summary& s : by_case(report.rows)) {
    const Json group{{"name", s.group}, {"meaning", meaning_of_group(s.group)}};
    if (!record.contains("groups") || record["groups"].back() != group)
      record["groups"].push_back(group);
  }
  record["byLobe"] = summaries(by_lobe(report.rows), "lobe");
  record["byCase"] = summaries(by_case(report.rows), "case");
  record["byExponent"] = summaries(by_exponent(report.rows), "lobe");
  for (const ErrorCurve& curve : report.curves) record["curves"].push_back(curve_json(curve));
  for (const Row& row : report.rows)
    if (all || row.outcome == Outcome::kOutside) record["rows"].push_back(row_json(row));
  for (const Stall& s : report.stalls)
    record["stalls"].push_back({{"lobe", s.lobe},
                                {"precision", s.precision},
                                {"ordinaryNanoseconds", timing(s.ordinary)},
                                {"underflowNanoseconds", timing(s.underflow)}});
  for (const Price& p : report.prices)
    record["price"].push_back({{"lobe", p.lobe},
                               {"model", p.model},
                               {"float32Nanoseconds", timing(p.by_precision[0])},
                               {"mixedNanoseconds", timing(p.by_precision[1])},
                               {"float64Nanoseconds", timing(p.by_precision[2])}});
  for (const PicturePair& p : report.pictures)
    record["pictures"].push_back({{"exponent", p.exponent},
                                  {"naive", picture(pictures, p, "naive", p.naive_error)},
                                  {"ours", picture(pictures, p, "ours", p.ours_error)}});
  return record;
}

}  // namespace lobelia::stability

#include "renderer/kernels/kernels.hpp"
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
  for (const Summary& s : all)
    array.push_back({{"group", s.group},
                     {name, s.name},
                     {"cases", s.cases},
                     {"outside", s.outside},
                     {"naive", errors(s.naive)},
                     {"ours", errors(s.ours)},
                     {"ofBound", s.of_bound}});
  return array;
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
               {"within", r.within}});
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
  record["outside"] = report.outside();
  record["byLobe"] = summaries(by_lobe(report.rows), "lobe");
  record["byCase"] = summaries(by_case(report.rows), "case");
  for (const Row& row : report.rows)
    if (all || !row.within) record["rows"].push_back(row_json(row));
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

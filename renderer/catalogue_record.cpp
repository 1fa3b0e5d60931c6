#include "renderer/catalogue_record.hpp"

#include <numbers>

#include "renderer/albedo.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Json model_json(ModelId id) {
  const ModelInfo& m = info(id);
  return {{"name", m.name},
          {"title", m.title},
          {"angle", angle_name(m.angle)},
          {"appliesCosine", m.applies_cosine},
          {"normalised", name(m.normalised)},
          {"integral", m.integral},
          {"coefficient",
           {{"exact", exact_formula(id)},
            {"exactCosine", formulas(id).exact_cosine},
            {"paperCosine", formulas(id).paper_cosine},
            {"paperCs16", formulas(id).paper_cs16}}},
          {"operations", to_json(operations(id))},
          {"source", m.source}};
}

Json lobe_json(LobeId id, double exponent) {
  const LobeInfo& l = info(id);
  const LobeProperties p = measure(id, exponent);
  return {{"name", l.name},
          {"title", l.title},
          {"formula", l.formula},
          {"moments", l.moments},
          {"operations", to_json(operations(id))},
          {"float32ErrorOfPeak", lobe_float32_error(id, exponent).of_peak},
          {"halfWidthDegrees", p.half_width / kDegree},
          {"supportDegrees", p.support / kDegree},
          {"aboveCosine", p.above_cosine},
          {"belowCosine", p.below_cosine},
          {"source", l.source}};
}

Json parameter_json(const Parameter& p) {
  Json json{{"name", p.name}, {"default", p.default_value}};
  const std::string choices = string_choices(p);
  if (choices.empty())
    json.update({{"min", p.min}, {"max", p.max}});
  else
    json["allowed"] = choices;
  json["meaning"] = p.meaning;
  return json;
}

Json to_json(const AlbedoPeak& peak) {
  Json json{{"largest", peak.albedo}, {"atDegrees", peak.incidence / kDegree}};
  json["aboveOneFromDegrees"] =
      peak.above_one_from ? Json(*peak.above_one_from / kDegree) : Json(nullptr);
  return json;
}

Json highlight_json(const Highlight& h) {
  return {{"model", info(h.model).name},
          {"lobe", info(h.lobe).name},
          {"normalisation", name(h.normalisation)},
          {"coefficient", radiance_coefficient(h)},
          {"energyAtNormalIncidence", directional_albedo(h, 0)},
          {"albedo", to_json(largest_albedo(h))},
          {"albedoOfLight", to_json(largest_albedo_of_light(h))},
          {"reciprocityGap", reciprocity_gap(h)}};
}

}  // namespace

Json to_json(const OperationCount& c) {
  return {{"multiply", c.multiply},
          {"add", c.add},
          {"divide", c.divide},
          {"root", c.root},
          {"transcendental", c.transcendental},
          {"compare", c.compare}};
}

std::string_view angle_name(LobeAngle angle) {
  return angle == LobeAngle::kReflection ? "L and R" : "N and H";
}

std::string_view meaning(Normalisation normalisation) {
  return normalisation == Normalisation::kExact
             ? "from the integral itself: energy 1 at normal incidence"
             : "the constant as the paper prints it, misprints included";
}

std::vector<Highlight> all_highlights(double exponent) {
  std::vector<Highlight> all;
  for (const ModelId model : all_models())
    for (const LobeId lobe : all_lobes()) {
      all.push_back({model, lobe, Normalisation::kExact, exponent});
      if (has_paper_coefficient(lobe))
        all.push_back({model, lobe, Normalisation::kPaper, exponent});
    }
  return all;
}

Json catalogue_record(double exponent) {
  Json record = make_record("models");
  record["measuredAtExponent"] = exponent;
  for (const ModelId id : all_models()) record["models"].push_back(model_json(id));
  for (const LobeId id : all_lobes()) record["lobes"].push_back(lobe_json(id, exponent));
  record["lobeFamilies"] = allowed_lobes();
  for (const std::string_view how : normalisation_names())
    record["normalisations"].push_back(
        {{"name", how}, {"meaning", meaning(*find_normalisation(how))}});
  for (const Parameter& p : kHighlightParameters) record["parameters"].push_back(parameter_json(p));
  for (const Highlight& h : all_highlights(exponent))
    record["highlights"].push_back(highlight_json(h));
  return record;
}

}  // namespace lobelia

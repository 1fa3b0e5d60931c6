#include "renderer/catalogue_record.hpp"

#include <numbers>

#include "renderer/albedo.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

records::Model model_record(ModelId id) {
  const ModelInfo& m = info(id);
  records::Model record;
  record.name = m.name;
  record.title = m.title;
  record.angle = angle_name(m.angle);
  record.applies_cosine = m.applies_cosine;
  record.normalised = name(m.normalised);
  record.integral = m.integral;
  record.coefficient = {exact_formula(id), std::string(formulas(id).exact_cosine),
                        std::string(formulas(id).paper_cosine),
                        std::string(formulas(id).paper_cs16)};
  record.operations = operations_record(operations(id));
  record.source = m.source;
  return record;
}

records::Lobe lobe_record(LobeId id, double exponent) {
  const LobeInfo& l = info(id);
  const LobeProperties p = measure(id, exponent);
  records::Lobe record;
  record.name = l.name;
  record.title = l.title;
  record.formula = l.formula;
  record.moments = l.moments;
  record.operations = operations_record(operations(id));
  record.float32_error_of_peak = lobe_float32_error(id, exponent).of_peak;
  record.half_width_degrees = p.half_width / kDegree;
  record.support_degrees = p.support / kDegree;
  record.above_cosine = p.above_cosine;
  record.below_cosine = p.below_cosine;
  record.source = l.source;
  return record;
}

records::Parameter parameter_record(const Parameter& p) {
  records::Parameter record;
  record.name = p.name;
  record.default_value = p.default_value;
  record.allowed = string_choices(p);
  if (record.allowed.empty()) {
    record.min = p.min;
    record.max = p.max;
  }
  record.meaning = p.meaning;
  return record;
}

records::AlbedoPeak albedo_record(const AlbedoPeak& peak) {
  records::AlbedoPeak record{peak.albedo, peak.incidence / kDegree, std::nullopt};
  if (peak.above_one_from) record.above_one_from_degrees = *peak.above_one_from / kDegree;
  return record;
}

records::CatalogueHighlight catalogue_highlight(const Highlight& h) {
  return {std::string(info(h.model).name),
          std::string(info(h.lobe).name),
          std::string(name(h.normalisation)),
          radiance_coefficient(h),
          directional_albedo(h, 0),
          albedo_record(largest_albedo(h)),
          albedo_record(largest_albedo_of_light(h)),
          reciprocity_gap(h)};
}

}  // namespace

records::Operations operations_record(const OperationCount& c) {
  return {c.multiply, c.add, c.divide, c.root, c.transcendental, c.compare};
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

records::Models catalogue_record(double exponent) {
  records::Models record;
  record.measured_at_exponent = exponent;
  for (const ModelId id : all_models()) record.models.push_back(model_record(id));
  for (const LobeId id : all_lobes()) record.lobes.push_back(lobe_record(id, exponent));
  record.lobe_families = allowed_lobes();
  for (const std::string_view how : normalisation_names())
    record.normalisations.push_back(
        {std::string(how), std::string(meaning(*find_normalisation(how)))});
  for (const Parameter& p : kHighlightParameters) record.parameters.push_back(parameter_record(p));
  for (const Highlight& h : all_highlights(exponent))
    record.highlights.push_back(catalogue_highlight(h));
  return record;
}

}  // namespace lobelia

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <map>
#include <tuple>

#include "base/system/interrupt.hpp"
#include "base/words/text.hpp"
#include "studies/convert/assets/assets.hpp"
#include "studies/convert/convert.hpp"

namespace lobelia::conversion {
namespace {

/// Fills in all that follows from the material's highlight.
void convert_material(const FileMaterial& material, std::optional<ShadingModel> to,
                      std::optional<double> f0, Measure measure,
                      records::ConvertedMaterial& record) {
  Request request{*material.model, {}, material.parameter, f0.value_or(material.f0), measure};
  record.from = convert_from(request);
  record.reflectance = request.f0;
  for (const std::string_view name : shading_model_names()) {
    request.to = *find_shading_model(name);
    if (request.to.id != request.from.id && (!to || request.to.id == to->id))
      record.best.push_back(convert_to_best(request));
  }
  if (!to || to->id == request.from.id) return;
  request.to = *to;
  record.rules = convert_by_rules(request);
}

}  // namespace

records::ConvertedMaterials convert_materials(const std::filesystem::path& file,
                                              std::optional<ShadingModel> to,
                                              std::optional<double> f0, Measure measure) {
  const Assets assets = read_assets(file);
  records::ConvertedMaterials converted;
  converted.file = file.string();
  converted.meaning = assets.meaning;
  converted.measure = records::kConversionMeasures[std::size_t(measure)];
  converted.remarks = assets.remarks;
  converted.materials.resize(assets.materials.size());
  // Many materials of a file have the same highlight, which is converted once.
  std::map<std::tuple<std::string_view, double, double>, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < assets.materials.size(); ++i) {
    const FileMaterial& material = assets.materials[i];
    if (material.model)
      alike[{material.model->name(), material.parameter, material.f0}].push_back(i);
  }
  const std::vector groups(alike.begin(), alike.end());
  oneapi::tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t group) {
    throw_if_interrupted();
    const std::vector<std::size_t>& members = groups[group].second;
    records::ConvertedMaterial record;
    convert_material(assets.materials[members.front()], to, f0, measure, record);
    for (const std::size_t i : members) converted.materials[i] = record;
  });
  for (std::size_t i = 0; i < assets.materials.size(); ++i) {
    converted.materials[i].name = assets.materials[i].name;
    converted.materials[i].remarks = assets.materials[i].remarks;
  }
  return converted;
}

}  // namespace lobelia::conversion

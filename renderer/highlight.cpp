#include "renderer/highlight.hpp"

#include "core/error.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"

namespace lobelia {
namespace {

using HWY_NAMESPACE::Lobes;
using HWY_NAMESPACE::Models;

constexpr auto kModelInfos = map_types<ModelInfo>(Models{}, []<class M>() { return M::kInfo; });
constexpr auto kLobeInfos = map_types<LobeInfo>(Lobes{}, []<class L>() { return L::kInfo; });
constexpr auto kModelNames =
    map_types<std::string_view>(Models{}, []<class M>() { return M::kInfo.name; });
constexpr auto kLobeNames =
    map_types<std::string_view>(Lobes{}, []<class L>() { return L::kInfo.name; });
constexpr std::string_view kNormalisationNames[] = {"exact", "paper"};

using LobeValue = double (*)(double s, double n);
constexpr auto kLobeValues = map_types<LobeValue>(Lobes{}, []<class L>() -> LobeValue {
  return [](double s, double n) { return L::value(s, n); };
});

/// How one model uses its lobe, for code that meets models by id.
struct ModelUse {
  double (*foreshortening)(double n_dot_l);
  double (*paper_cosine)(double n);
  double (*paper_cs16)(double n);
  EnergyIntegral energy;
  double share;
};
constexpr auto kModelUses = map_types<ModelUse>(Models{}, []<class M>() {
  return ModelUse{[](double n_dot_l) { return M::foreshortening(n_dot_l); }, M::paper_cosine,
                  M::paper_cs16, M::kEnergy, M::kShare};
});

using ExactCoefficient = double (*)(const EnergyIntegral&, double n);
constexpr auto kExactCoefficients = map_types<ExactCoefficient>(
    Lobes{}, []<class L>() -> ExactCoefficient { return exact_coefficient<L>; });
constexpr auto kPaperColumns =
    map_types<PaperColumn>(Lobes{}, []<class L>() { return L::kPaperColumn; });

template <class Id, std::size_t size>
std::optional<Id> find(const std::array<std::string_view, size>& names, std::string_view name) {
  for (std::size_t i = 0; i < size; ++i)
    if (names[i] == name) return Id{std::uint8_t(i)};
  return std::nullopt;
}

}  // namespace

std::span<const ModelInfo> models() { return kModelInfos; }
std::span<const LobeInfo> lobes() { return kLobeInfos; }
std::span<const std::string_view> model_names() { return kModelNames; }
std::span<const std::string_view> lobe_names() { return kLobeNames; }
std::span<const std::string_view> normalisation_names() { return kNormalisationNames; }

const ModelInfo& info(ModelId id) { return kModelInfos.at(id.index); }
const LobeInfo& info(LobeId id) { return kLobeInfos.at(id.index); }
std::string_view name(Normalisation normalisation) {
  return kNormalisationNames[std::size_t(normalisation)];
}

std::optional<ModelId> find_model(std::string_view name) {
  return find<ModelId>(kModelNames, name);
}
std::optional<LobeId> find_lobe(std::string_view name) { return find<LobeId>(kLobeNames, name); }
std::optional<Normalisation> find_normalisation(std::string_view name) {
  for (std::size_t i = 0; i < std::size(kNormalisationNames); ++i)
    if (kNormalisationNames[i] == name) return Normalisation(i);
  return std::nullopt;
}

double radiance_coefficient(const Highlight& highlight) {
  const ModelUse& model = kModelUses.at(highlight.model.index);
  const double n = highlight.exponent;
  if (highlight.normalisation == Normalisation::kExact)
    return model.share * kExactCoefficients.at(highlight.lobe.index)(model.energy, n);
  switch (kPaperColumns.at(highlight.lobe.index)) {
    case PaperColumn::kCosine:
      return model.share * model.paper_cosine(n);
    case PaperColumn::kCs16:
      return model.share * model.paper_cs16(n);
    case PaperColumn::kNone:
      break;
  }
  throw Error(ExitCode::kInput, "the paper gives no coefficient for the lobe '" +
                                    std::string(info(highlight.lobe).name) +
                                    "'; use the normalisation 'exact'");
}

double lobe_value(LobeId lobe, double s, double exponent) {
  return kLobeValues.at(lobe.index)(s, exponent);
}

double highlight_radiance(const Highlight& highlight, double n_dot_l, double s) {
  if (!(n_dot_l > 0)) return 0;
  return radiance_coefficient(highlight) * lobe_value(highlight.lobe, s, highlight.exponent) *
         kModelUses.at(highlight.model.index).foreshortening(n_dot_l);
}

}  // namespace lobelia

#include "renderer/highlight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "renderer/formula_lobe.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"
#include "renderer/models/smith.hpp"

namespace lobelia {
namespace {

using HWY_NAMESPACE::Lobes;
using HWY_NAMESPACE::LobesById;
using HWY_NAMESPACE::Models;

constexpr auto kModelInfos = map_types<ModelInfo>(Models{}, []<class M>() { return M::kInfo; });
constexpr auto kModelTexts =
    map_types<CoefficientTexts>(Models{}, []<class M>() { return M::kTexts; });
constexpr auto kModelNames =
    map_types<std::string_view>(Models{}, []<class M>() { return M::kInfo.name; });
constexpr std::string_view kNormalisationNames[] = {"exact", "paper"};
constexpr std::string_view kNormalisedNames[] = {"radiance", "normals", "projected normals"};

/// The numbers of one model, for code that has its id.
struct ModelUse {
  double (*paper_cosine)(double n);
  double (*paper_cs16)(double n);
  EnergyIntegral energy;
  double share;
};
constexpr auto kModelUses = map_types<ModelUse>(Models{}, []<class M>() {
  return ModelUse{M::paper_cosine, M::paper_cs16, M::kEnergy, M::kShare};
});

/// The functions of one lobe, for code that has its id.
struct LobeUse {
  double (*value)(LobeParameters, double s);
  PreparedLobe (*prepare)(LobeParameters);
  double (*exact_coefficient)(LobeParameters, const EnergyIntegral&);
  PaperColumn (*paper_column)(LobeParameters);
  Float32Error (*float32_error)(LobeParameters);
};
constexpr auto kLobeUses = map_types<LobeUse>(LobesById{}, []<class L>() {
  return LobeUse{[](LobeParameters p, double s) { return L(p).value(s); },
                 [](LobeParameters p) {
                   const L lobe(p);
                   return PreparedLobe{[lobe](double s) { return lobe.value(s); },
                                       [lobe](double xi) { return lobe.sample(xi); },
                                       [lobe](double s) { return lobe.density(s); }};
                 },
                 [](LobeParameters p, const EnergyIntegral& energy) {
                   return exact_coefficient(energy, L(p));
                 },
                 [](LobeParameters p) { return L(p).paper_column(); },
                 [](LobeParameters p) { return L(p).float32_error(); }};
});

/// The texts of one member of a family, with the number k.
struct MemberText {
  std::string name, formula, moments;
  LobeInfo info;
  MemberText(const LobeInfo& family, std::string member_name, std::string_view member_formula,
             int order)
      : name(std::move(member_name)) {
    const auto with_order = [&](std::string_view text, std::string& to) {
      for (const char c : text) to += c == 'k' ? std::to_string(order) : std::string(1, c);
    };
    with_order(member_formula, formula);
    with_order(family.moments, moments);
    info = {name, name, formula, moments, family.source};
  }
  MemberText(const MemberText&) = delete;  // info looks at the other members
};
template <class L>
std::unique_ptr<MemberText> make_member(int order) {
  std::string formula(L::kInfo.formula);
  if constexpr (requires { L::member_formula(order); }) formula = L::member_formula(order);
  return std::make_unique<MemberText>(L::kInfo, L::member_name(order), formula, order);
}

/// Every lobe that has a name, the listed members of a family in ascending order. A member's texts are made when they are
/// asked for: a family has hundreds, and a command looks at one.
class LobeTable {
 public:
  LobeTable() {
    map_types<int>(Lobes{}, [this]<class L>() { return list<L>(); });
  }

  std::vector<LobeId> listed;
  std::vector<std::string_view> names;

  const LobeInfo& info(const LobeId& id) const {
    if (id.formula) return id.formula->info();
    const Family& family = kFamilies.at(id.index);
    if (!family.make) return *family.info;
    if (!family.has(id.order))
      throw std::out_of_range(fmt::format("{} of order {}", family.info->name, id.order));
    const std::lock_guard lock(mutex_);
    std::unique_ptr<MemberText>& text = members_[{id.index, id.order}];
    if (!text) text = family.make(id.order);
    return text->info;
  }
  std::optional<LobeId> find(std::string_view name) const {
    if (const auto at = std::ranges::find(names, name); at != names.end())
      return listed[std::size_t(at - names.begin())];
    const std::size_t digits = name.find_last_not_of("0123456789") + 1;
    int order = 0;
    std::from_chars(name.data() + digits, name.data() + name.size(), order);
    for (std::size_t i = 0; i < kFamilies.size(); ++i)
      if (const LobeId id{std::uint8_t(i), std::uint16_t(order)};
          kFamilies[i].has && kFamilies[i].has(order) && info(id).name == name)
        return id;
    return std::nullopt;
  }

 private:
  /// `has` and `make` are null for a lobe that is in no family.
  struct Family {
    const LobeInfo* info;
    bool (*has)(int order);
    std::unique_ptr<MemberText> (*make)(int order);
  };
  static constexpr auto kFamilies = map_types<Family>(Lobes{}, []<class L>() {
    if constexpr (LobeFamily<L>)
      return Family{&L::kInfo, &L::has, &make_member<L>};
    else
      return Family{&L::kInfo, nullptr, nullptr};
  });

  template <class L>
  int list() {
    constexpr auto kIndex = std::uint8_t(index_of<L>(Lobes{}));
    const auto add = [this](LobeId id) {
      listed.push_back(id);
      names.push_back(info(id).name);
    };
    if constexpr (LobeFamily<L>)
      for (const int order : L::kOrders) add({kIndex, std::uint16_t(order)});
    else
      add({kIndex, 0});
    return 0;
  }

  mutable std::mutex mutex_;
  mutable std::map<std::pair<std::uint8_t, std::uint16_t>, std::unique_ptr<MemberText>> members_;
};

const LobeTable& lobe_table() {
  static const LobeTable table;
  return table;
}

constexpr auto kModelIds = [] {
  std::array<ModelId, Models::kSize> ids;
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = {std::uint8_t(i)};
  return ids;
}();

/// A formula of a shader in the usual notation: "(2.0 * %pi%)" becomes "(2 pi)".
std::string for_people(std::string_view text) {
  constexpr std::pair<std::string_view, std::string_view> kWords[] = {
      {"exp2(-0.5 * n)", "2^(-n/2)"},
      {"%pi%", "pi"},
      {".0 * ", " "},
      {" * ", " "},
      {".0)", ")"},
      {".0 -", " -"}};
  std::string result;
  while (!text.empty()) {
    const auto* word = std::ranges::find_if(
        kWords, [&](const auto& entry) { return text.starts_with(entry.first); });
    const bool known = word != std::end(kWords);
    result += known ? word->second : text.substr(0, 1);
    text.remove_prefix(known ? word->first.size() : 1);
  }
  return result;
}

}  // namespace

std::span<const ModelId> all_models() { return kModelIds; }
std::span<const ModelInfo> models() { return kModelInfos; }
std::span<const LobeId> all_lobes() { return lobe_table().listed; }
std::span<const std::string_view> model_names() { return kModelNames; }
std::span<const std::string_view> lobe_names() { return lobe_table().names; }
std::span<const std::string_view> normalisation_names() { return kNormalisationNames; }

std::string allowed_lobes(bool or_a_formula) {
  std::string families;
  map_types<int>(Lobes{}, [&]<class L>() {
    if constexpr (LobeFamily<L>)
      if (!L::kUnlisted.empty()) families += fmt::format("; {}", L::kUnlisted);
    return 0;
  });
  if (or_a_formula) families += fmt::format("; {}, with a formula", kFormulaLobe);
  return join(lobe_names()) + families;
}

const ModelInfo& info(ModelId id) { return kModelInfos.at(id.index); }
ConstantFormulas formulas(ModelId id) {
  const CoefficientTexts& texts = kModelTexts.at(id.index);
  return {for_people(texts.exact_cosine), for_people(texts.paper_cosine),
          for_people(texts.paper_cs16)};
}
std::string exact_formula(ModelId id) {
  const ModelUse& use = kModelUses.at(id.index);
  std::string sum;
  for (std::size_t j = 0; j < use.energy.weights.size(); ++j) {
    const double weight = use.energy.weights[j];
    if (weight == 0) continue;
    if (!sum.empty()) sum += weight < 0 ? " - " : " + ";
    sum += (std::abs(weight) == 1 ? "" : fmt::format("{:g} ", std::abs(weight))) +
           fmt::format("M{}", j);
  }
  return fmt::format("1/(2 pi ({})), s = 0 to {}", sum,
                     use.energy.s_max == 1 ? "1" : "1 - sqrt(1/2)");
}
const LobeInfo& info(const LobeId& id) { return lobe_table().info(id); }
std::string_view name(Normalisation normalisation) {
  return kNormalisationNames[std::size_t(normalisation)];
}

std::string_view name(NormalisedQuantity normalised) {
  return kNormalisedNames[std::size_t(normalised)];
}

std::optional<ModelId> find_model(std::string_view name) {
  return find_id<ModelId>(kModelNames, name);
}
std::span<const std::string_view> settable_models() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all(model_names().begin(), model_names().end());
    all.push_back(kGgx);
    return all;
  }();
  return names;
}

bool set_model(Highlight& highlight, std::string_view name) {
  const auto model = find_model(name == kGgx ? "microfacet_smith" : name);
  if (!model) return false;
  highlight.model = *model;
  if (name == kGgx) highlight.lobe = *find_lobe(kGgx);
  return true;
}

std::optional<LobeId> find_lobe(std::string_view name) { return lobe_table().find(name); }

LobeId formula_lobe(std::string_view formula) {
  return {std::uint8_t(Lobes::kSize), 0, std::make_shared<const Formula>(formula)};
}

std::string why_not_a_lobe(const Highlight& highlight) {
  const auto& formula = highlight.lobe.formula;
  return formula ? FormulaLobe(formula, highlight.exponent).why_not() : "";
}

const LobeInfo& family_info(const LobeId& lobe) {
  static constexpr auto kInfos =
      map_types<LobeInfo>(LobesById{}, []<class L>() { return L::kInfo; });
  return kInfos.at(lobe.index);
}
std::string_view family(const LobeId& lobe) { return family_info(lobe).name; }

std::strong_ordering operator<=>(const LobeId& a, const LobeId& b) {
  const auto text = [](const LobeId& id) {
    return id.formula ? std::string_view(id.formula->text()) : std::string_view();
  };
  // Not <=> of the texts, which libc++ 14 does not have.
  return std::tuple(a.index, a.order, text(a).compare(text(b))) <=> std::tuple(b.index, b.order, 0);
}

std::optional<Normalisation> find_normalisation(std::string_view name) {
  return find_id<Normalisation>(kNormalisationNames, name);
}

double radiance_coefficient(const Highlight& highlight) {
  const ModelUse& model = kModelUses.at(highlight.model.index);
  const LobeUse& lobe = kLobeUses.at(highlight.lobe.index);
  const double n = highlight.exponent;
  const LobeParameters p(highlight);
  if (const std::string why = why_not_a_lobe(highlight); !why.empty())
    throw Error(ExitCode::kInput, why);
  if (highlight.normalisation == Normalisation::kExact)
    return model.share * lobe.exact_coefficient(p, model.energy);
  switch (lobe.paper_column(p)) {
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

double normalisation_constant(const Highlight& highlight) {
  return radiance_coefficient(highlight) / kModelUses.at(highlight.model.index).share;
}

bool has_paper_coefficient(const LobeId& lobe) {
  return kLobeUses.at(lobe.index).paper_column({1, lobe}) != PaperColumn::kNone;
}

std::string warning(const Highlight& highlight) {
  const double n = highlight.exponent;
  if (highlight.normalisation != Normalisation::kPaper ||
      (n >= kPaperMinExponent && n <= kPaperMaxExponent))
    return "";
  return fmt::format(
      "exponent {:g}: the paper gives its coefficients for {:g} to {:g}; the normalisation 'exact' "
      "holds for every exponent",
      n, kPaperMinExponent, kPaperMaxExponent);
}

double lobe_value(const LobeId& lobe, double s, double exponent) {
  return kLobeUses.at(lobe.index).value({exponent, lobe}, s);
}

PreparedLobe prepare(const LobeId& lobe, double exponent) {
  return kLobeUses.at(lobe.index).prepare({exponent, lobe});
}

Float32Error lobe_float32_error(const LobeId& lobe, double exponent) {
  return kLobeUses.at(lobe.index).float32_error({exponent, lobe});
}

double largest_shadowing(ModelId model, double exponent) {
  // smith_factor() N.L is 2 / (root(N.V) + root(N.L) (N.V) / (N.L)), and no root is below alpha.
  return info(model).has_shadowing ? 2 / std::sqrt(alpha_squared(exponent)) : 1;
}

double geometry_factor(ModelId model, double exponent, double n_dot_l, double n_dot_v) {
  const ModelInfo& of = info(model);
  double factor = of.applies_cosine ? n_dot_l : 1;
  if (of.has_shadowing)
    factor *= HWY_NAMESPACE::smith_factor(alpha_squared(exponent), n_dot_l, n_dot_v);
  return factor;
}

double highlight_radiance(const Highlight& highlight, double n_dot_l, double n_dot_v, double s) {
  if (!(n_dot_l > 0)) return 0;
  return radiance_coefficient(highlight) * lobe_value(highlight.lobe, s, highlight.exponent) *
         geometry_factor(highlight.model, highlight.exponent, n_dot_l, n_dot_v);
}

}  // namespace lobelia

#include "studies/cost/half_floats.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "base/system/error.hpp"
#include "base/system/interrupt.hpp"
#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/vector.hpp"
#include "renderer/catalogue_record.hpp"
#include "renderer/models/lobe_angle.hpp"
#include "renderer/operation_count.hpp"

namespace lobelia::cost {
namespace {

/// The functions of `lobelia export --language hlsl --precision min16float`, character for character, computed in emulated
/// half floats: HLSL is so close to C++ that a class may have them as members.
template <Subnormals kSubnormals>
class ExportedFunctions {
 public:
  using min16float = HalfOf<kSubnormals>;
  using min16float3 = Half3Of<min16float>;

#include "studies/half_exports.inc"

  using Self = ExportedFunctions;
  struct Entry {
    std::string_view model, lobe;
    min16float (Self::*radiance)(min16float3 normal, min16float3 to_eye, min16float3 to_light,
                                 min16float exponent, min16float coefficient);
    min16float (Self::*lobe_value)(min16float s, min16float n);
  };
  static const std::vector<Entry>& all() {
    static const std::vector<Entry> entries{
#include "studies/half_export_list.inc"
    };
    return entries;
  }
};

/// The lobe at unit vectors; the models are those without N.L.
using HalfHighlight = std::function<double(Vec3 normal, Vec3 to_eye, Vec3 to_light)>;

constexpr std::size_t kVectors = 1 << 15;
/// Light and eye are up to so many degrees from the normal: beyond, a half vector is short and badly known.
constexpr double kMostDegrees = 70;

struct Directions3 {
  Vec3 normal, to_eye, to_light;
  double s;
};

std::vector<Directions3> directions_about(LobeAngle angle, double n) {
  std::mt19937_64 random(std::uint64_t(n) + std::uint64_t(angle));
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return normalize({normal(random), normal(random), normal(random)});
  };
  const double least = std::cos(kMostDegrees * std::numbers::pi / 180);
  std::vector<Directions3> all;
  while (all.size() < kVectors) {
    // Each angle up to where cos^n is e^-6 counts alike.
    const double chord = uniform(random) * std::min(1.4, std::sqrt(12 / n));
    const Vec3 axis = direction(), across = normalize(cross(axis, direction()));
    const double sine = chord * std::sqrt(1 - chord * chord / 4);
    const Vec3 beside = (1 - chord * chord / 2) * axis + sine * across;
    const Vec3 to_eye = direction();
    // The axis is the half vector and `beside` the normal; or the mirror direction, and `beside` the light.
    const bool mirror = angle == LobeAngle::kReflection;
    const Vec3 to_normal = mirror ? normalize(axis + to_eye) : beside;
    const Vec3 to_light = mirror ? beside : 2 * dot(to_eye, axis) * axis - to_eye;
    if (dot(to_normal, to_eye) < least || dot(to_normal, to_light) < least) continue;
    all.push_back({to_normal, to_eye, to_light, chord * chord / 2});
  }
  return all;
}

const std::vector<Directions3>& known_directions(LobeAngle angle, double n) {
  static const auto known = [] {
    std::map<std::pair<LobeAngle, double>, std::vector<Directions3>> all;
    for (const LobeAngle any : {LobeAngle::kReflection, LobeAngle::kHalfVector})
      for (const double exponent : kHalfExponents)
        all[{any, exponent}] = directions_about(any, exponent);
    return all;
  }();
  return known.at({angle, n});
}

template <Subnormals kSubnormals, LobeAngle kAngle>
HalfHighlight textbook_highlight(LobeId lobe, double n) {
  using Number = HalfOf<kSubnormals>;
  using Vector = Half3Of<Number>;
  return [=](Vec3 normal, Vec3 to_eye, Vec3 to_light) {
    const Vector N(normal), V(to_eye), L(to_light);
    Number cosine;
    if constexpr (kAngle == LobeAngle::kReflection) {
      cosine = dot(2 * dot(N, V) * N - V, L);
    } else {
      cosine = dot(N, (L + V) / length(L + V));
    }
    return cosine > 0 ? double(lobe_definition(lobe, cosine, n)) : 0;
  };
}

template <Subnormals kSubnormals, LobeAngle kAngle>
HalfHighlight stable_highlight(LobeId id, double n) {
  using Number = HalfOf<kSubnormals>;
  using Vector = Half3Of<Number>;
  using HWY_NAMESPACE::LobesById;
  using Make = HalfHighlight (*)(LobeId, double);
  static constexpr auto kMake = map_types<Make>(LobesById{}, []<class L>() -> Make {
    return [](LobeId which, double exponent) -> HalfHighlight {
      return [lobe = L(LobeParameters{exponent, which})](Vec3 normal, Vec3 to_eye, Vec3 to_light) {
        return double(lobe.value(HWY_NAMESPACE::one_minus_cos<kAngle, Number>(
            Vector(normal), Vector(to_eye), Vector(to_light))));
      };
    };
  });
  return kMake.at(id.index)(id, n);
}

template <Subnormals kSubnormals, LobeAngle kAngle>
HalfHighlight exported_highlight(LobeId lobe, double n, bool difference_in_float32) {
  using Functions = ExportedFunctions<kSubnormals>;
  using Vector = typename Functions::min16float3;
  const std::string_view model = kAngle == LobeAngle::kReflection ? "phong_rdf" : "blinn_phong_rdf";
  const auto found = std::ranges::find_if(Functions::all(), [&](const auto& entry) {
    return entry.model == model && entry.lobe == info(lobe).name;
  });
  if (found == Functions::all().end())
    throw Error(ExitCode::kInternal, "{} is not exported", info(lobe).name);
  if (!difference_in_float32)
    return [n, radiance = found->radiance](Vec3 normal, Vec3 to_eye, Vec3 to_light) {
      return double(
          (Functions().*radiance)(Vector(normal), Vector(to_eye), Vector(to_light), n, 1.0));
    };
  return [n, value = found->lobe_value](Vec3 normal, Vec3 to_eye, Vec3 to_light) {
    using Float3 = truth::Vector<float>;
    const auto narrow = [](Vec3 a) { return Float3(float(a.x), float(a.y), float(a.z)); };
    const Float3 N = narrow(normal), V = narrow(to_eye), L = narrow(to_light);
    const Float3 d =
        kAngle == LobeAngle::kReflection ? 2 * dot(N, V) * N - V - L : N - normalize(L + V);
    const float s = float(kHalfScale) / 2 * dot(d, d);
    return s < float(kHalfScale) ? double((Functions().*value)(double(s), n / kHalfScale)) : 0;
  };
}

template <Subnormals kSubnormals, LobeAngle kAngle>
HalfHighlight highlight_by(HalfForm form, LobeId lobe, double n) {
  switch (form) {
    case HalfForm::kTextbook:
      return textbook_highlight<kSubnormals, kAngle>(lobe, n);
    case HalfForm::kStable:
      return stable_highlight<kSubnormals, kAngle>(lobe, n);
    case HalfForm::kExported:
    case HalfForm::kDifferenceInFloat32:
      break;
  }
  return exported_highlight<kSubnormals, kAngle>(lobe, n, form != HalfForm::kExported);
}

HalfHighlight half_highlight(HalfForm form, LobeAngle angle, LobeId lobe, double exponent,
                             Subnormals subnormals) {
  constexpr auto kMirror = LobeAngle::kReflection, kBetween = LobeAngle::kHalfVector;
  if (subnormals == Subnormals::kKept)
    return angle == kMirror ? highlight_by<Subnormals::kKept, kMirror>(form, lobe, exponent)
                            : highlight_by<Subnormals::kKept, kBetween>(form, lobe, exponent);
  return angle == kMirror ? highlight_by<Subnormals::kFlushed, kMirror>(form, lobe, exponent)
                          : highlight_by<Subnormals::kFlushed, kBetween>(form, lobe, exponent);
}

struct HalfCase {
  HalfForm form;
  LobeId lobe;
  Subnormals subnormals;

  std::string name() const {
    return fmt::format("{}, {}{}", info(lobe).name, cost::name(form),
                       subnormals == Subnormals::kFlushed ? ", subnormals flushed" : "");
  }
};

Variant measured_case(const HalfCase& one, LobeAngle angle) {
  Variant made;
  made.name = one.name();
  made.settings = {{"lobe", std::string(info(one.lobe).name)},
                   {"method", name(one.form)},
                   {"precision", "float16"},
                   {"subnormals", one.subnormals == Subnormals::kKept ? "kept" : "flushed"}};
  for (const double n : kHalfExponents)
    made.errors.emplace_back(fmt::format("n{:g}", n),
                             half_errors(one.form, angle, one.lobe, n, one.subnormals).all);
  const OperationCount count =
      one.form == HalfForm::kTextbook ? textbook_operations(one.lobe) : operations(one.lobe);
  made.count = price(count);
  made.facts.emplace().operations = operations_record(count);
  return made;
}

Table half_float_table(LobeAngle angle) {
  const bool mirror = angle == LobeAngle::kReflection;
  Table table;
  table.id = mirror ? "lobe-float16-mirror" : "lobe-float16-half";
  table.level = "lobe";
  table.title = fmt::format("A lobe in half floats, of the angle between {}, n = 8 to 1024",
                            mirror ? "L and the mirror image of V" : "N and the half vector");
  table.unit = "operations";
  table.per = "evaluation";
  for (const double n : kHalfExponents)
    table.errors.push_back(
        {fmt::format("n{:g}", n),
         fmt::format("largest absolute difference from cos^n, of the peak, at n = {:g}", n)});
  std::vector<HalfCase> cases;
  for (const LobeId& lobe : all_lobes())
    for (const HalfForm form : kHalfForms)
      for (const Subnormals subnormals : {Subnormals::kKept, Subnormals::kFlushed})
        // Flushing matters only to s.
        if (subnormals == Subnormals::kKept || form == HalfForm::kStable ||
            form == HalfForm::kExported)
          cases.push_back({form, lobe, subnormals});
  table.variants.resize(cases.size());
  oneapi::tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) {
    if (!interrupted()) table.variants[i] = measured_case(cases[i], angle);
  });
  throw_if_interrupted();
  table.remarks = {
      "Half floats are emulated, so nothing is timed: operations are those of the lobe alone, by price.",
      fmt::format(
          "Largest of {} random vectors, rounded to half floats first; light and eye are within {:g} degrees "
          "of the normal.",
          kVectors, kMostDegrees)};
  return table;
}

}  // namespace

std::string name(HalfForm form) {
  switch (form) {
    case HalfForm::kTextbook:
      return "textbook";
    case HalfForm::kStable:
      return "stable";
    case HalfForm::kExported:
      return "exported";
    case HalfForm::kDifferenceInFloat32:
      break;
  }
  return "exported, difference in float32";
}

HalfErrors half_errors(HalfForm form, LobeAngle angle, LobeId lobe, double exponent,
                       Subnormals subnormals) {
  const HalfHighlight highlight = half_highlight(form, angle, lobe, exponent, subnormals);
  const PreparedLobe own = prepare(lobe, exponent),
                     cosine = prepare(*find_lobe("cosine"), exponent);
  HalfErrors errors;
  const auto widen = [](double& most, double error) {
    most = error <= most ? most : error;  // a NaN is larger
  };
  for (const Directions3& d : known_directions(angle, exponent)) {
    const double value = highlight(d.normal, d.to_eye, d.to_light);
    widen(errors.all, std::abs(value - cosine.value(d.s)));
    widen(errors.rounding, std::abs(value - own.value(d.s)));
  }
  return errors;
}

std::vector<Table> half_float_tables() {
  return {half_float_table(LobeAngle::kHalfVector), half_float_table(LobeAngle::kReflection)};
}

}  // namespace lobelia::cost

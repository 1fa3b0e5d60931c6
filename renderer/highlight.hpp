// A highlight: a model, a lobe, a normalisation and an exponent. The other rooms see the catalogues of
// renderer/lobes and renderer/models through this file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lobelia {

/// Position in the catalogue of models (renderer/models/catalogue.hpp).
struct ModelId {
  std::uint8_t index = 0;
  friend constexpr bool operator==(ModelId, ModelId) = default;
};
class Formula;  // renderer/formula.hpp

/// Position in the catalogue of lobes (renderer/lobes/catalogue.hpp) and, in a family, the order k: the member is
/// something to the power k, as cs_k is.
struct LobeId {
  std::uint8_t index = 0;
  std::uint16_t order = 0;  ///< 2 to kMaxOrder, for a family; 0 for a single lobe
  std::shared_ptr<const Formula> formula = {};  ///< of the lobe "expression"; null for all others
  /// Two formulas are the same if their texts are.
  friend bool operator==(const LobeId& a, const LobeId& b) { return (a <=> b) == 0; }
  friend std::strong_ordering operator<=>(const LobeId& a, const LobeId& b);
};
inline constexpr int kMaxOrder = 1024;
/// The name of the lobe that a formula gives. find_lobe() does not know it, because a name does not say which formula.
inline constexpr std::string_view kFormulaLobe = "expression";

/// The source of the coefficient in front of the lobe.
enum class Normalisation : std::uint8_t {
  kExact,  ///< from the integral itself, which it makes 1
  kPaper,  ///< as the paper prints it for that model and lobe
};

/// The exponents for which the paper gives its coefficients. Others are allowed, with a warning.
inline constexpr double kPaperMinExponent = 16, kPaperMaxExponent = 1024;

/// The angle that the lobe sees; s is 1 - its cosine.
enum class LobeAngle : std::uint8_t {
  kReflection,  ///< between L and R, the mirror direction of V (Phong family)
  kHalfVector,  ///< between the normal and the half vector (Blinn family)
};

/// The integral that the exact normalisation constant makes 1, by model (docs/conventions.md).
enum class NormalisedQuantity : std::uint8_t {
  kRadiance,          ///< the energy reflected at normal incidence, over all directions
  kNormals,           ///< the integral of a distribution D of normals over their hemisphere
  kProjectedNormals,  ///< the integral of D (N.H): the projected area of a heightfield
};

struct LobeInfo {
  std::string_view name;     ///< "cosine", as in scene files and on the command line
  std::string_view title;    ///< "cosine", for people
  std::string_view formula;  ///< of s = 1 - cos and n; 0 where s >= 1
  std::string_view moments;  ///< M_j, the integral of formula s^j over s = 0 to S
  std::string_view source;
};

struct ModelInfo {
  std::string_view name;   ///< "phong_rdf"
  std::string_view title;  ///< "Phong (RDF)"
  LobeAngle angle;
  bool applies_cosine;  ///< radiance carries N.L; false for an RDF, which is 0 where N.L <= 0
  NormalisedQuantity normalised;
  std::string_view integral;  ///< the exact normalisation constant makes it 1
  std::string_view source;
  /// Smith's shadowing and masking takes the place of the implicit geometry (N.L)(N.V), with GGX's alpha.
  bool has_shadowing = false;
};

/// Normalisation constants as formulas of n, "(n + 1) / (2 pi)".
struct ConstantFormulas {
  std::string exact_cosine;  ///< from the integral, for the cosine lobe
  std::string paper_cosine;  ///< as the paper prints it
  std::string paper_cs16;    ///< as the paper prints it
};

struct Highlight {
  ModelId model;
  LobeId lobe;
  Normalisation normalisation = Normalisation::kExact;
  double exponent = 64;  ///< n, kMinExponent to kMaxExponent
};

/// With exponent 0 every lobe is flat: 1 where s < 1, 0 beyond.
inline constexpr double kMinExponent = 0, kMaxExponent = 1e8;
/// A lobe with an exponent below has the figures of the flat one, to the last digit. Closed forms that divide by n use it
/// for 0.
inline constexpr double kFlatExponent = 1e-60;

/// The catalogues, in their order. Only the usual members of a family are listed; find_lobe() knows all. A lobe by a
/// formula is not listed.
std::span<const ModelId> all_models();
std::span<const ModelInfo> models();
std::span<const LobeId> all_lobes();
std::span<const std::string_view> model_names();
std::span<const std::string_view> lobe_names();
std::span<const std::string_view> normalisation_names();  ///< "exact", "paper"
/// The names that find_lobe() takes, for messages: "cosine, cs2, ...; csK for any even K from 2 to 1024".
std::string allowed_lobes(bool or_a_formula = false);

const ModelInfo& info(ModelId id);
ConstantFormulas formulas(ModelId id);
/// The exact normalisation constant from the moments M_j, the integrals of lobe s^j: "1/(2 pi (M0 - M1)), s = 0 to 1".
std::string exact_formula(ModelId id);
const LobeInfo& info(const LobeId& id);
/// The lobe's name with '_' for '.', and a part that differs for each formula: for names in code and of files.
std::string identifier(const LobeId& lobe);
/// "cs" for cs16; the name of a lobe that is in no family.
std::string_view family(const LobeId& lobe);
/// With k for the order of a member.
const LobeInfo& family_info(const LobeId& lobe);
std::string_view name(Normalisation normalisation);
std::string_view name(NormalisedQuantity normalised);

std::optional<ModelId> find_model(std::string_view name);
/// GGX is the model microfacet_smith with the lobe ggx, and has a name of its own beside the models'.
inline constexpr std::string_view kGgx = "ggx";
/// Sets the model by its name; with "ggx" the lobe too. False if there is no such model.
bool set_model(Highlight& highlight, std::string_view name);
/// All names that set_model() takes.
std::span<const std::string_view> settable_models();
std::optional<LobeId> find_lobe(std::string_view name);
/// The lobe with this formula. Throws FormulaError, which is one line.
LobeId formula_lobe(std::string_view formula);
/// Why the highlight's formula is no lobe at its exponent, in one line; empty if it is one, or if there is no formula.
std::string why_not_a_lobe(const Highlight& highlight);
std::optional<Normalisation> find_normalisation(std::string_view name);

/// The coefficient: the factor of the lobe (and N.L, where the model applies it) in radiance per unit irradiance. Throws
/// Error(kInput) if the paper has none for the lobe, and if the formula is no lobe.
double radiance_coefficient(const Highlight& highlight);
/// The factor of the lobe in the integral that the model makes 1. For a distribution D of normals it is four times the
/// coefficient, because f_r = D F / 4; for the other models it is the coefficient. Throws as radiance_coefficient().
double normalisation_constant(const Highlight& highlight);

/// Whether the paper prints a coefficient for the lobe: only for cosine and cs16.
bool has_paper_coefficient(const LobeId& lobe);

/// A warning about a highlight that is allowed but odd, or "".
std::string warning(const Highlight& highlight);

/// The lobe at s = 1 - cos(angle), s in [0, 2], in double precision: in [0, 1], value 1 at s = 0.
double lobe_value(const LobeId& lobe, double s, double exponent);

/// A lobe at one exponent with its constants computed once, for repeated use.
struct PreparedLobe {
  std::function<double(double s)> value;  ///< lobe_value
  /// A random s from a uniform number in [0, 1), and its density over [0, 1]. Follows the lobe exactly for cosine,
  /// cs_k and spherical Gaussian, nearly for the others; for a formula in steps.
  std::function<double(double xi)> sample;
  std::function<double(double s)> density;
};
PreparedLobe prepare(const LobeId& lobe, double exponent);

/// Bound of the error of float32 arithmetic in a lobe at a given float32 s: relative to the peak, and in units in
/// the last place of the result, which grow by `ulp_per_nat` for each factor e below the peak. `lobelia verify
/// stability` checks every lobe against it.
struct Float32Error {
  double of_peak, ulp, ulp_per_nat = 0;
};
Float32Error lobe_float32_error(const LobeId& lobe, double exponent);

/// GGX's alpha squared for an exponent: the width at which both have the same peak as a heightfield's distribution.
constexpr double alpha_squared(double exponent) { return 2 / (exponent + 2); }
/// The exponent for GGX's alpha. Roughness is the root of alpha, as in Blender, glTF and Unreal.
constexpr double exponent_of_alpha(double alpha) {
  return std::clamp(2 / (alpha * alpha) - 2, kMinExponent, kMaxExponent);
}
constexpr double exponent_of_roughness(double roughness) {
  return exponent_of_alpha(roughness * roughness);
}
/// The least of a GGX in a scene: smaller ones would have an exponent above kMaxExponent.
inline constexpr double kLeastRoughness = 0.012, kLeastAlpha = 0.000144;
/// The largest factor that shadowing puts on a lobe times N.L; at grazing angles. 1 for a model without.
double largest_shadowing(ModelId model, double exponent);

/// The factor of coefficient and lobe, for cosines above 0: N.L where the model applies it, else 1, times Smith's
/// G / ((N.L) (N.V)) where it has shadowing.
double geometry_factor(ModelId model, double exponent, double n_dot_l, double n_dot_v);

/// Radiance per unit irradiance normal to the beam, for unit vectors pointing away from the surface; 0 where N.L <= 0.
double highlight_radiance(const Highlight& highlight, double n_dot_l, double n_dot_v, double s);

}  // namespace lobelia

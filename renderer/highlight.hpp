// A highlight by name: which model, which lobe, how normalised, how sharp. The catalogues of
// renderer/lobes and renderer/models as every other room sees them.
#pragma once

#include <cstdint>
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
/// Position in the catalogue of lobes (renderer/lobes/catalogue.hpp).
struct LobeId {
  std::uint8_t index = 0;
  friend constexpr bool operator==(LobeId, LobeId) = default;
};

/// Where the coefficient in front of the lobe comes from.
enum class Normalisation : std::uint8_t {
  kExact,  ///< the closed form of the integral: energy 1 at normal incidence
  kPaper,  ///< as the paper prints it for that model and lobe
};

/// Which angle the lobe sees; s = 1 - cos of it.
enum class LobeAngle : std::uint8_t {
  kReflection,  ///< between L and R, the mirror direction of V (Phong family)
  kHalfVector,  ///< between the normal and the half vector (Blinn family)
};

struct LobeInfo {
  std::string_view name;     ///< "cosine", as in scene files and on the command line
  std::string_view title;    ///< "cosine", for people
  std::string_view formula;  ///< of s = 1 - cos and n
  std::string_view source;
};

struct ModelInfo {
  std::string_view name;   ///< "phong_rdf"
  std::string_view title;  ///< "Phong (RDF)"
  LobeAngle angle;
  bool applies_cosine;        ///< radiance carries N.L; false for an RDF, which is 0 where N.L <= 0
  std::string_view integral;  ///< that the exact coefficient makes equal to 1
  std::string_view source;
};

struct Highlight {
  ModelId model;
  LobeId lobe;
  Normalisation normalisation = Normalisation::kExact;
  double exponent = 64;  ///< n, kMinExponent to kMaxExponent
};

inline constexpr double kMinExponent = 1e-3;
inline constexpr double kMaxExponent = 1e8;

/// The catalogues, in their order. ids are indices into these.
std::span<const ModelInfo> models();
std::span<const LobeInfo> lobes();
std::span<const std::string_view> model_names();
std::span<const std::string_view> lobe_names();
std::span<const std::string_view> normalisation_names();  ///< "exact", "paper"

const ModelInfo& info(ModelId id);
const LobeInfo& info(LobeId id);
std::string_view name(Normalisation normalisation);

std::optional<ModelId> find_model(std::string_view name);
std::optional<LobeId> find_lobe(std::string_view name);
std::optional<Normalisation> find_normalisation(std::string_view name);

/// The number that multiplies lobe (and N.L, where the model applies it) to give radiance per unit
/// irradiance. For the microfacet models it is a quarter of the coefficient of D: f_r = D F / 4.
double radiance_coefficient(const Highlight& highlight);

/// The lobe at s = 1 - cos(angle), s in [0, 2], in double precision: in [0, 1], value 1 at s = 0.
double lobe_value(LobeId lobe, double s, double exponent);

/// Radiance per unit irradiance normal to the beam, for unit vectors pointing away from the surface.
double highlight_radiance(const Highlight& highlight, double n_dot_l, double s);

}  // namespace lobelia

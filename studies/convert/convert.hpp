// The parameter with which one model looks most like another, and what rules of thumb make of it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/records/conversion.hpp"
#include "base/words/svg_chart.hpp"
#include "studies/convert/curve.hpp"

namespace lobelia::conversion {

/// By records::kConversionMeasures.
enum class Measure : std::uint8_t { kMax, kWidth, kEnergy, kCiede2000 };

struct Request {
  ShadingModel from, to;
  double parameter = 0;  ///< of `from`; not used for a range. An exponent may be 0
  double f0 = 1;
  Measure measure = Measure::kMax;  ///< the best by this one is drawn
};

/// A parameter in its range, and whether it lies at the end of it.
struct Best {
  double parameter;
  bool at_end;
};
Best best_parameter(const Request& request, Measure measure);
/// The parameter with the smallest error. Looks over the whole range first, because an error may have several valleys.
Best parameter_of_least(const std::function<double(double)>& error, double min, double max);

records::Conversion convert(const Request& request);

records::ConvertedHighlight convert_from(const Request& request);
/// The best parameter of `request.to` by `request.measure`, with its errors.
records::ConversionBest convert_to_best(const Request& request);
/// The parameter of the target by each rule of thumb between the two models, with its errors.
std::vector<records::ConversionRule> convert_by_rules(const Request& request);

/// The materials of a file (studies/convert/assets/assets.hpp): each in the model `to` by `measure` and by rules of thumb, or
/// without one in every model by `measure`; never in its own. `f0` takes the place of the reflectance that the file says.
records::ConvertedMaterials convert_materials(const std::filesystem::path& file,
                                              std::optional<ShadingModel> to,
                                              std::optional<double> f0, Measure measure);
std::string materials_text(const records::ConvertedMaterials& converted);

// The best parameters over the whole range, and what rules of thumb make of it.

/// Over exponents from 1 to 1024, or over roughness. `request.parameter` is not used.
records::ConversionTable convert_range(const Request& request);

std::string range_text(const records::ConversionTable& table);
/// The best by the chosen measure and the rules.
Chart range_chart(const records::ConversionTable& table);

std::string conversion_text(const records::Conversion& conversion);
Chart conversion_chart(const records::Conversion& conversion);

struct Rule {
  std::string_view name;     ///< "FBX2glTF"
  std::string_view formula;  ///< "roughness = sqrt(2 / (n + 2))"
  std::string_view source;
  /// The parameter of the target from that of the source; none if the rule has no answer.
  std::optional<double> (*convert)(double parameter);
};

/// From an exponent to GGX the rules themselves; back from GGX the same rules solved for n. From an exponent to an exponent
/// the rules differ by whether the angle of the lobe does.
std::span<const Rule> rules(ShadingModel from, ShadingModel to);

}  // namespace lobelia::conversion

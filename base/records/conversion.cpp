#include "base/records/conversion.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kParameters[] = {"exponent", "roughness"};

}  // namespace

void define_conversion_tables(Tables& tables) {
  tables.define<ConvertedHighlight>(
      "A highlight under light along the normal of a flat surface: the light that leaves per steradian, by the angle of "
      "the eye from the normal, per unit irradiance and reflectance.",
      [](auto& t) {
        t.key("exponent", "of a model of the catalogue, with the cosine lobe").at_least(0);
        t.key("alpha", "of GGX").within(0, 1);
        t.key("roughness", "of GGX: the root of alpha, as in Blender and in glTF").within(0, 1);
        t.key("peak", "in the mirror direction").at_least(0);
        t.key("halfWidthDegrees").unit("degrees").within(0, 90);
        t.key("energy", "share of the beam that leaves").at_least(0);
      });
  tables.define<ConversionErrors>(
      "How far a highlight is from the one that was converted. A ratio is its own over the other's.",
      [](auto& t) {
        t.all().at_least(0);
        t.key("largestOfPeak", "largest difference, of the peak of the one that was converted");
        t.key("largestAtDegrees").unit("degrees").at_most(90);
        t.key("misplacedEnergy", "energy of the absolute difference, of that of the other");
        t.key("largestCiede2000", "in grey, the brighter peak shown as white");
      });
  tables.define<ConversionBest>("The best parameter by a measure.", [](auto& t) {
    t.key("measure").one_of(kConversionMeasures);
    t.key("isEndOfRange", "a better one may lie beyond");
  });
  tables.define<ConversionRule>("A rule of thumb.", [](auto& t) {
    t.key("formula", "n is the exponent; roughness is the root of alpha");
    t.key("source", "where it is in use");
    t.key("because", "why it has no highlight").if_any();
  });
  tables.define<Conversion>(
      "A highlight converted to another model: 'lobelia convert --json FILE'.", [](auto& t) {
        t.kind("conversion");
        t.key("reflectance", "head on").within(0, 1);
        t.key("to", "model");
        t.key("measure", "that was asked for").one_of(kConversionMeasures);
        t.key("best", "by each measure");
        t.key("rules", "none is known between these models if it is missing").if_any();
        t.key("curves", "over the peak of the one that was converted, by degrees");
      });
  tables.define<ConversionTable>(
      "Parameters converted over a range: 'lobelia convert --json FILE' without a parameter.",
      [](auto& t) {
        t.kind("conversion-table");
        t.key("reflectance", "head on").within(0, 1);
        t.keys({"fromParameter", "toParameter"}).one_of(kParameters);
        t.key("measure", "that was asked for").one_of(kConversionMeasures);
        t.key("columns", "the best by each measure and by each rule, over the parameter of `from`");
      });
  tables.define<ConvertedMaterial>(
      "A material of a file, and what it is in other models.", [](auto& t) {
        t.key("name", "in the file, or its number there");
        t.key("from", "missing if the material has no highlight that can be converted");
        t.key("reflectance",
              "head on, over that at grazing angles: what Schlick's factor in `from` depends on")
            .within(0, 1);
        t.key("remarks", "each default in use, and all that is left out").if_any();
        t.key("best", "in each other model the best parameter, by the one measure").if_any();
        t.key("rules", "of thumb, for the one model that was asked for").if_any();
      });
  tables.define<ConvertedMaterials>(
      "Materials of a file converted to other models: 'lobelia convert FILE --json FILE'.",
      [](auto& t) {
        t.kind("converted-materials");
        t.key("meaning", "of the parameters in the file's format, with the source");
        t.key("measure", "that was asked for").one_of(kConversionMeasures);
        t.key("remarks", "on the whole file").if_any();
      });
}

}  // namespace lobelia::records

#include "records/models.hpp"

namespace lobelia::records {

const Struct& Formulas::type() {
  return define<Formulas>("Formulas", "Coefficients of a model.", [](Struct& t) {
    t.key<&Formulas::exact>("exact", "integrated, in double");
    t.key<&Formulas::exact_cosine>("exactCosine", "closed form with the lobe cosine");
    t.key<&Formulas::paper_cosine>("paperCosine", "as the paper prints it");
    t.key<&Formulas::paper_cs16>("paperCs16", "as the paper prints it");
  });
}

const Struct& Operations::type() {
  return define<Operations>(
      "Operations", "Operations per point. What depends on the exponent alone is computed once.",
      [](Struct& t) {
        t.key<&Operations::multiply>("multiply");
        t.key<&Operations::add>("add");
        t.key<&Operations::divide>("divide");
        t.key<&Operations::root>("root");
        t.key<&Operations::transcendental>("transcendental");
        t.key<&Operations::compare>("compare");
      });
}

const Struct& Model::type() {
  return define<Model>("Model", "A reflection model.", [](Struct& t) {
    t.key<&Model::name>("name");
    t.key<&Model::title>("title");
    t.key<&Model::angle>("angle", "what its lobe sees");
    t.key<&Model::applies_cosine>("appliesCosine");
    t.key<&Model::normalised>("normalised", "what its coefficient makes 1");
    t.key<&Model::integral>("integral");
    t.key<&Model::coefficient>("coefficient");
    t.key<&Model::operations>("operations");
    t.key<&Model::source>("source");
  });
}

const Struct& Lobe::type() {
  return define<Lobe>("Lobe", "A lobe, measured at one exponent.", [](Struct& t) {
    t.key<&Lobe::name>("name");
    t.key<&Lobe::title>("title");
    t.key<&Lobe::formula>("formula");
    t.key<&Lobe::moments>("moments", "M_j, the integral of the lobe times s^j for s = 0 to S");
    t.key<&Lobe::operations>("operations");
    t.key<&Lobe::float32_error_of_peak>("float32ErrorOfPeak");
    t.key<&Lobe::half_width_degrees>("halfWidthDegrees").unit("degrees");
    t.key<&Lobe::support_degrees>("supportDegrees").unit("degrees");
    t.key<&Lobe::above_cosine>("aboveCosine", "most that it exceeds the lobe cosine");
    t.key<&Lobe::below_cosine>("belowCosine");
    t.key<&Lobe::source>("source");
  });
}

const Struct& Normalisation::type() {
  return define<Normalisation>("Normalisation", "Where coefficients come from.", [](Struct& t) {
    t.key<&Normalisation::name>("name");
    t.key<&Normalisation::meaning>("meaning");
  });
}

const Struct& Parameter::type() {
  return define<Parameter>("Parameter", "A parameter of a highlight.", [](Struct& t) {
    t.key<&Parameter::name>("name");
    t.key<&Parameter::default_value>("default");
    t.key<&Parameter::min>("min");
    t.key<&Parameter::max>("max");
    t.key<&Parameter::allowed>("allowed").if_any();
    t.key<&Parameter::meaning>("meaning");
  });
}

const Struct& AlbedoPeak::type() {
  return define<AlbedoPeak>("AlbedoPeak", "The largest albedo over all incidences.", [](Struct& t) {
    t.key<&AlbedoPeak::largest>("largest");
    t.key<&AlbedoPeak::at_degrees>("atDegrees").unit("degrees");
    t.key<&AlbedoPeak::above_one_from_degrees>("aboveOneFromDegrees", "null if it stays within 1")
        .or_null()
        .unit("degrees");
  });
}

const Struct& CatalogueHighlight::type() {
  return define<CatalogueHighlight>(
      "CatalogueHighlight", "A model with a lobe and a normalisation.", [](Struct& t) {
        t.key<&CatalogueHighlight::model>("model");
        t.key<&CatalogueHighlight::lobe>("lobe");
        t.key<&CatalogueHighlight::normalisation>("normalisation");
        t.key<&CatalogueHighlight::coefficient>("coefficient");
        t.key<&CatalogueHighlight::energy_at_normal_incidence>("energyAtNormalIncidence");
        t.key<&CatalogueHighlight::albedo>("albedo", "towards the eye");
        t.key<&CatalogueHighlight::albedo_of_light>("albedoOfLight", "of a beam");
        t.key<&CatalogueHighlight::reciprocity_gap>("reciprocityGap");
      });
}

const Struct& Models::type() {
  return define<Models>(
      "Models", "All models, lobes, normalisations and parameters: 'lobelia models --json'.",
      [](Struct& t) {
        t.kind("models");
        t.key<&Models::measured_at_exponent>("measuredAtExponent");
        t.key<&Models::models>("models");
        t.key<&Models::lobes>("lobes");
        t.key<&Models::lobe_families>("lobeFamilies", "lobes that a number chooses");
        t.key<&Models::normalisations>("normalisations");
        t.key<&Models::parameters>("parameters");
        t.key<&Models::highlights>("highlights");
      });
}

const Struct& TableErrors::type() {
  return define<TableErrors>(
      "TableErrors",
      "How far an interpolated value may be off: of the peak for a curve, else relative.",
      [](Struct& t) {
        t.key<&TableErrors::curve>("curve");
        t.key<&TableErrors::albedo>("albedo");
        t.key<&TableErrors::half_width>("halfWidth");
        t.key<&TableErrors::coefficient>("coefficient");
      });
}

const Struct& ModelTable::type() {
  return define<ModelTable>("ModelTable", "A model, for the explorer.", [](Struct& t) {
    t.key<&ModelTable::name>("name");
    t.key<&ModelTable::title>("title");
    t.key<&ModelTable::angle>("angle");
    t.key<&ModelTable::applies_cosine>("appliesCosine");
    t.key<&ModelTable::normalised>("normalised");
    t.key<&ModelTable::coefficient>("coefficient");
  });
}

const Struct& LobeTable::type() {
  return define<LobeTable>("LobeTable",
                           "A lobe over the exponents. docs/decisions/0015 defines the tables.",
                           [](Struct& t) {
                             t.key<&LobeTable::name>("name");
                             t.key<&LobeTable::title>("title");
                             t.key<&LobeTable::formula>("formula");
                             t.key<&LobeTable::order>("order");
                             t.key<&LobeTable::unit>("unit", "curves are in multiples of it");
                             t.key<&LobeTable::reach>("reach").unit("radians");
                             t.key<&LobeTable::half_width>("halfWidth").unit("radians");
                             t.key<&LobeTable::curves>("curves");
                           });
}

const Struct& HighlightTable::type() {
  return define<HighlightTable>(
      "HighlightTable", "A model with a lobe over the exponents.", [](Struct& t) {
        t.key<&HighlightTable::model>("model");
        t.key<&HighlightTable::lobe>("lobe");
        t.key<&HighlightTable::exact>("exact", "coefficients");
        t.key<&HighlightTable::paper>("paper", "coefficients; missing if the paper has none")
            .if_any();
        t.key<&HighlightTable::unit>("unit", "seen and lit are logarithms in multiples of it");
        t.key<&HighlightTable::seen>("seen");
        t.key<&HighlightTable::lit>("lit", "missing if it is the same as seen").if_any();
      });
}

const Struct& HighlightTables::type() {
  return define<HighlightTables>(
      "HighlightTables",
      "Every highlight over the exponent, as numbers that a page can interpolate.", [](Struct& t) {
        t.kind("highlight-tables");
        t.key<&HighlightTables::exponents>("exponents");
        t.key<&HighlightTables::per_octave>("perOctave");
        t.key<&HighlightTables::most_grazing>("mostGrazing").unit("radians");
        t.key<&HighlightTables::error>("error");
        t.key<&HighlightTables::models>("models");
        t.key<&HighlightTables::lobes>("lobes");
        t.key<&HighlightTables::highlights>("highlights");
      });
}

}  // namespace lobelia::records

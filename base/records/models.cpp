#include "base/records/models.hpp"

namespace lobelia::records {

void define_model_tables(Tables& tables) {
  tables.define<Formulas>("Normalisation constants of a model.", [](auto& t) {
    t.key("exact", "integrated, in double");
    t.key("exactCosine", "closed form with the lobe cosine");
    t.key("paperCosine", "as the paper prints it");
    t.key("paperCs16", "as the paper prints it");
  });
  tables.define<Operations>(
      "Operations per point. What depends on the exponent alone is computed once.", [](auto& t) {
        t.all().at_least(0);
        t.key("compare", "comparisons, maxima and conversions");
        t.key("price", "of all, in multiplications of float32: a division counts as six");
      });
  tables.define<Model>("A reflection model.", [](auto& t) {
    t.key("angle", "what its lobe sees");
    t.key("hasShadowing", "Smith's, in place of the implicit geometry (N.L)(N.V)");
    t.key("normalised", "what its normalisation constant makes 1");
  });
  tables.define<Lobe>("A lobe, measured at one exponent.", [](auto& t) {
    t.key("moments", "M_j, the integral of the lobe times s^j for s = 0 to S");
    t.keys({"halfWidthDegrees", "supportDegrees"}).unit("degrees");
    t.key("aboveCosine", "most that it exceeds the lobe cosine");
  });
  tables.define<Normalisation>("Where coefficients come from.");
  tables.define<Parameter>("A parameter of a highlight.", [](auto& t) {
    t.key("defaultValue").renamed("default");
    t.key("allowed").if_any();
  });
  tables.define<AlbedoPeak>("The largest albedo over all incidences.", [](auto& t) {
    t.key("atDegrees").unit("degrees");
    t.key("aboveOneFromDegrees", "null if it stays within 1").or_null().unit("degrees");
  });
  tables.define<CatalogueHighlight>("A model with a lobe and a normalisation.", [](auto& t) {
    t.key("normalisationConstant", "makes the model's integral 1");
    t.key("coefficient", "the factor of the lobe in the radiance");
    t.key("albedo", "towards the eye");
    t.key("albedoOfLight", "of a beam");
  });
  tables.define<Models>(
      "All models, lobes, normalisations and parameters: 'lobelia models --json FILE'.",
      [](auto& t) {
        t.kind("models");
        t.key("lobeFamilies", "lobes that a number chooses");
      });
  tables.define<TableErrors>(
      "How far an interpolated value may be off: of the peak for a curve, else relative.");
  tables.define<ModelTable>("A model, for the explorer.", [](auto& t) {
    t.key(
        "weights",
        "1 / coefficient is the integral of lobe(s) (w0 + w1 s + w2 s^2 + w3 s^3), s = 0 to sMax");
  });
  tables.define<LobeTable>("A lobe over the exponents. docs/records.md defines the tables.",
                           [](auto& t) {
                             t.key("unit", "curves are in multiples of it");
                             t.keys({"reach", "halfWidth"}).unit("radians");
                           });
  tables.define<HighlightTable>("A model with a lobe over the exponents.", [](auto& t) {
    t.key("exact", "coefficients");
    t.key("paper", "coefficients; missing if the paper has none").if_any();
    t.key("unit", "seen and lit are logarithms in multiples of it");
    t.key("lit", "missing if it is the same as seen").if_any();
    t.key("shader", "positions in shaderParts, which joined are the exported GLSL");
    t.key("paperShader", "with the paper's coefficient; missing if it has none").if_any();
  });
  tables.define<HighlightTables>(
      "Every highlight over the exponent, as numbers that a page can interpolate.", [](auto& t) {
        t.kind("highlight-tables");
        t.key("mostGrazing").unit("radians");
        t.key("shaderParts",
              "paragraphs of 'lobelia export --language glsl --coefficient argument'");
      });
}

}  // namespace lobelia::records

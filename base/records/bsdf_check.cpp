#include "base/records/bsdf_check.hpp"

#include "base/records/shader_check.hpp"

namespace lobelia::records {

void define_bsdf_check_tables(Tables& tables) {
  tables.define<BsdfSetting>("One exponent, and one angle of the eye.", [](auto& t) {
    t.key("eyeDegrees", "of the eye from the normal").unit("degrees").within(0, 90);
    t.key("pdfAbove", "integral of pdf over the directions above the surface").may_be_nonfinite();
    t.key("pdfBelow", "and over those below").may_be_nonfinite();
    t.key("quadratureError", "of these integrals and of the albedo, estimated by a second grid")
        .at_least(0)
        .may_be_nonfinite();
    t.key("samplesBelow", "with a direction below the surface");
    t.key("samplesRejected", "that sample gave as not valid");
    t.key("chiSquare", "of the directions above the surface against pdf")
        .at_least(0)
        .may_be_nonfinite();
    t.key("freedom", "degrees of freedom of chiSquare").at_least(0);
    t.key("chance", "of a larger chiSquare if sample follows pdf").within(0, 1).may_be_nonfinite();
    t.key("albedo", "integral of eval with the cosine, by quadrature").may_be_nonfinite();
    t.key("albedoOfSamples", "mean of eval with the cosine over pdf").may_be_nonfinite();
    t.key("notReciprocal",
          "largest change of eval, of its largest value, if light and eye are exchanged")
        .at_least(0)
        .may_be_nonfinite();
  });
  tables.define<BsdfFailure>("A test that failed, where it failed most.", [](auto& t) {
    t.key("check").one_of(kBsdfChecks);
    t.key("settings", "where it failed");
  });
  tables.define<BsdfExplanation>(
      "What would explain failures: with it put right, in double, the tests pass.",
      [](auto& t) { t.key("mistake", "by name; docs/shader_mistakes.md lists them").not_empty(); });
  tables.define<BsdfCheck>(
      "The functions of a BSDF, tested against each other: 'lobelia check-shader --bsdf'.",
      [](auto& t) {
        t.kind("bsdf-check");
        t.key("file").not_empty();
        t.key("sha256", "of the file");
        t.key("eval", "the function, with what it takes");
        t.key("api").one_of(kShaderApis);
        t.key("device", "as the driver names it");
        t.key("verdict").one_of(kBsdfVerdicts);
        t.key("falseAlarms", "chance that a right BSDF fails a random test of the run")
            .within(0, 1);
        t.key("randomTests", "in the run; they share falseAlarms");
        t.key("evalHasCosine", "eval includes the cosine of the light");
        t.key("reciprocal", "eval is, within rounding");
        t.key("settings").items(1);
        t.key("failures").if_any();
        t.key("explanations").if_any();
        t.key("remarks").if_any();
      });
}

}  // namespace lobelia::records

#include "base/records/shader_check.hpp"

namespace lobelia::records {

void define_shader_check_tables(Tables& tables) {
  tables.define<ShaderPlace>("A call of the function.", [](auto& t) {
    t.key("nDotL", "cosine of the light");
    t.key("nDotV", "cosine of the eye");
    t.key("lobeDegrees", "the angle that the model's lobe sees").unit("degrees").within(0, 180);
    t.key("value", "what it gave").may_be_nonfinite();
    t.key("expected", "what the model has");
  });
  tables.define<ShaderError>("The largest error at an exponent.", [](auto& t) {
    t.key("maxOfPeak", "of the model's peak").at_least(0).may_be_nonfinite();
    t.key("allowedOfPeak", "what float32 may leave there").at_least(0);
  });
  tables.define<ShaderFactor>("The shader's coefficient over the model's.");
  tables.define<ShaderExplanation>("What would explain the error.", [](auto& t) {
    t.key("mistakes", "by name, such as pi-missing; docs/shader_mistakes.md lists them");
    t.key("complete", "it leaves nothing but rounding");
    t.key("leftOfPeak", "the largest difference left, but for the worst 2 % of the calls")
        .at_least(0)
        .may_be_nonfinite();
    t.key("factors", "at the exponents where it can be told").if_any();
  });
  tables.define<ShaderEnergy>(
      "The integral of the radiance over all directions of the light, for an eye at that angle.",
      [](auto& t) {
        t.key("incidenceDegrees", "of the eye").unit("degrees").within(0, 90);
        t.key("energy").may_be_nonfinite();
        t.key("ofModel", "the same sum over the model");
      });
  tables.define<ShaderOddities>("Numbers of calls with odd results.", [](auto& t) {
    t.key("outsideSupport", "not 0 where the model is");
    t.key("unwritten", "without any result where the model is not 0");
    t.key("coloured", "with a colour that is not grey; red was compared");
    t.key("hardCalls", "in directions such as L = -V, where only a finite number is asked for");
    t.key("belowCalls", "with the eye below the surface, where no model is defined");
    t.key("belowNonfinite", "no part of the verdict");
    t.key("belowLit", "not 0; no part of the verdict");
  });
  tables.define<ShaderHalf>("What changes if all of its arithmetic is in half floats.",
                            [](auto& t) {
                              t.key("maxOfPeak", "largest change").at_least(0).may_be_nonfinite();
                              t.key("nonfinite", "calls");
                            });
  tables.define<ShaderCost>("What a call costs.", [](auto& t) {
    t.key("name", "function, ours or pow").not_empty();
    t.key("instructions", "of SPIR-V, optimised by spirv-opt, that compute, compare or branch");
  });
  tables.define<ShaderBinding>("What a variable or a part of it was set to.", [](auto& t) {
    t.key("name", "such as material.shininess");
    t.key("value", "words of --arguments, or numbers");
    t.key("by", "where the value is from").one_of(kShaderBindings);
  });
  tables.define<ShaderCheck>(
      "A shader function against a model: 'lobelia check-shader'.", [](auto& t) {
        t.kind("shader-check");
        t.key("file").not_empty();
        t.key("sha256", "of the file");
        t.key("modelFound", "none was given: it is the simplest to explain it by");
        t.key("bindings").if_any();
        t.key("api").one_of(kShaderApis);
        t.key("device", "as the driver names it");
        t.key("verdict").one_of(kShaderVerdicts);
        t.key("errors", "by exponent").items(1);
        t.key("explanation", "missing if it passes");
        t.key("halfFloats", "by exponent").if_any();
        t.key("remarks", "what could not be measured or was changed, and why").if_any();
      });
}

}  // namespace lobelia::records

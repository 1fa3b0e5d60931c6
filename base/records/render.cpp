#include "base/records/render.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kAccuracyUnits[] = {"ofPeak", "de2000"};
constexpr std::string_view kBases[] = {"bound", "trial"};
constexpr std::string_view kShadings[] = {"native", "expressed", "analytic", "outside"};

}  // namespace

void define_render_tables(Tables& tables) {
  tables.define<Work>("How much work an effect took.");
  tables.define<Effect>("Whether an effect of light is simulated, and why.");
  tables.define<ExpectedRays>("Rays that a render will trace.");
  tables.define<Plan>("What a scene calls for, before it is rendered.", [](auto& t) {
    t.kind("plan");
    t.key("precision", "and why");
    t.key("kernel", "which inner loops");
  });
  tables.define<PlanOfRender>("The plan that a render followed.", [](auto& t) {
    t.key("precision", "and why");
    t.key("kernel", "which inner loops");
  });
  tables.define<Rays>("Rays that were traced, counted.");
  tables.define<EngineUsed>("The engine that made a picture.",
                            [](auto& t) { t.key("title").if_any(); });
  tables.define<ImageFile>("A picture beside its record.", [](auto& t) {
    t.keys({"width", "height"}).unit("pixels").at_least(1);
  });
  tables.define<AccuracyChoice>("What was chosen to reach an accuracy.", [](auto& t) {
    t.key("lobe", "null if the highlights keep lobes that differ").or_null();
    t.key("samples", "per pixel").at_least(1);
  });
  tables.define<AccuracyOperations>("Weighted operations per point.", [](auto& t) {
    t.key("ownInFloat64", "of the scene's own lobe");
  });
  tables.define<AccuracySeconds>("For one value of the lobe, by SIMD on one thread, in this run.",
                                 [](auto& t) {
                                   t.all().at_least(0).unit("seconds");
                                   t.key("ownInFloat64", "of the scene's own lobe");
                                 });
  tables.define<AccuracyReached>("What a check of the finished picture found.", [](auto& t) {
    t.key("value", "0 for a black picture").may_be_nonfinite();
    t.key("against", "the ground truth");
    t.key("seconds", "to make the ground truth").unit("seconds");
  });
  tables.define<Accuracy>("A picture by the accuracy that was asked for; see docs/cost.md.",
                          [](auto& t) {
                            t.key("unit").one_of(kAccuracyUnits);
                            t.key("valueSeconds", "null where the highlights keep lobes that differ");
                            t.key("basis").one_of(kBases);
                            t.key("predicted", "will not be exceeded");
                            t.key("reached", "missing with --accuracy-check none");
                          });
  tables.define<RenderSeconds>("Time by stage, in seconds.", [](auto& t) {
    t.key("total", "plan and render");
    t.key("read", "the scene");
    t.key("pack", "rows of the picture; part of render");
    t.key("write", "the finished file");
  });
  tables.define<Render>("A picture by Lobelia.", [](auto& t) {
    t.kind("render");
    t.key("command", "makes it again, in the cell's directory");
    t.key("highlights", "as rendered, by material");
    t.key("samples", "per pixel; at most, if antialiasing chose its pixels").at_least(1);
    t.key("estimatedError",
          "RMS of the expected error over RMS of the picture, where something is random")
        .may_be_nonfinite();
    t.key("stopped", "why no more samples were taken").if_any();
    t.key("remarks", "what is odd about the scene").if_any();
    t.key("standardError", "file with the standard error of each value").if_any();
    t.key("accuracy", "with --accuracy");
  });
  tables.define<EngineSeconds>("Time that an engine took, in seconds.", [](auto& t) {
    t.key("total", "the engine's work: POV-Ray's processes added up, Blender's render call alone")
        .at_least(0);
  });
  tables.define<Reference>("A picture by a reference engine.", [](auto& t) {
    t.kind("reference");
    t.key("shading",
          "the engine's own shading of the model, the model written in the "
          "engine's language, its formulas pixel by pixel, or a renderer from outside")
        .renamed("witness")
        .one_of(kShadings);
    t.key("points", "of each area light, of the lens and of the pixel");
    t.key("seed", "of these points");
    t.key("engineCommands", "without the temporary directory they ran in");
    t.key("engineOptions", "of POV-Ray's .ini files, file names aside").if_any();
    t.key("writesLimited", "the kernel kept the engine from writing outside that directory");
    t.key("contained", "what ends the engine's processes").if_any();
    t.key("cpuSeconds", "user and system, of all processes").unit("seconds");
    t.key("peakMemoryBytes", "resident, of the largest process; of Blender since it started")
        .unit("bytes");
    t.key("threads", "that each process may use");
    t.key("command", "makes it again, in the cell's directory");
    t.key("standardError", "file with the standard error of each value").if_any();
    t.key("highlights").if_any();
  });
  tables.define<EngineFound>("A reference engine and what is known of it here.", [](auto& t) {
    t.key("name", "as --engine takes it");
    t.key("state").one_of(kEngineStates);
    t.key("program", "missing if none was found").if_any();
    t.key("version", "missing if it told none").if_any();
    t.key("why", "why it cannot be used").if_any();
    t.key("shading", "models that it shades itself, and by our formula").renamed("witness");
    t.key("precision", "of its pictures");
    t.key("effects", "that scenes for it may have");
    t.key("install", "the command that installs it");
    t.key("models").if_any();
  });
  tables.define<Engines>("The reference engines.", [](auto& t) { t.kind("engines"); });
}

}  // namespace lobelia::records

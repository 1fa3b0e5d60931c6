#include "records/render.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kAccuracyUnits[] = {"ofPeak", "de2000"};
constexpr std::string_view kBases[] = {"bound", "look"};
constexpr std::string_view kWitnesses[] = {"native", "expressed", "analytic"};

}  // namespace

const Struct& Work::type() {
  return define<Work>("Work", "How much work an effect took.", [](Struct& t) {
    t.key<&Work::unit>("unit");
    t.key<&Work::count>("count");
  });
}

const Struct& Effect::type() {
  return define<Effect>("Effect", "Whether an effect of light is simulated, and why.",
                        [](Struct& t) {
                          t.key<&Effect::name>("name");
                          t.key<&Effect::on>("on");
                          t.key<&Effect::reason>("reason");
                          t.key<&Effect::work>("work");
                        });
}

const Struct& ExpectedRays::type() {
  return define<ExpectedRays>("ExpectedRays", "Rays that a render will trace.", [](Struct& t) {
    t.key<&ExpectedRays::camera>("camera");
    t.key<&ExpectedRays::shadow_at_most>("shadowAtMost");
    t.key<&ExpectedRays::mirror_at_most>("mirrorAtMost");
    t.key<&ExpectedRays::scattered_at_most>("scatteredAtMost");
  });
}

const Struct& Plan::type() {
  return define<Plan>("Plan", "What a scene calls for, before it is rendered.", [](Struct& t) {
    t.kind("plan");
    t.key<&Plan::effects>("effects");
    t.key<&Plan::precision>("precision", "and why");
    t.key<&Plan::kernel>("kernel", "which inner loops");
    t.key<&Plan::expected_rays>("expectedRays");
  });
}

const Struct& PlanOfRender::type() {
  return define<PlanOfRender>("PlanOfRender", "The plan that a render followed.", [](Struct& t) {
    t.key<&PlanOfRender::effects>("effects");
    t.key<&PlanOfRender::precision>("precision", "and why");
    t.key<&PlanOfRender::kernel>("kernel", "which inner loops");
  });
}

const Struct& Rays::type() {
  return define<Rays>("Rays", "Rays that were traced, counted.", [](Struct& t) {
    t.key<&Rays::camera>("camera");
    t.key<&Rays::shadow>("shadow");
    t.key<&Rays::mirror>("mirror");
    t.key<&Rays::scattered>("scattered");
  });
}

const Struct& EngineUsed::type() {
  return define<EngineUsed>("EngineUsed", "The engine that made a picture.", [](Struct& t) {
    t.key<&EngineUsed::name>("name");
    t.key<&EngineUsed::title>("title").if_any();
    t.key<&EngineUsed::version>("version");
  });
}

const Struct& ImageFile::type() {
  return define<ImageFile>("ImageFile", "A picture beside its record.", [](Struct& t) {
    t.key<&ImageFile::file>("file");
    t.key<&ImageFile::width>("width").unit("pixels").at_least(1);
    t.key<&ImageFile::height>("height").unit("pixels").at_least(1);
  });
}

const Struct& AccuracyChoice::type() {
  return define<AccuracyChoice>(
      "AccuracyChoice", "What was chosen to reach an accuracy.", [](Struct& t) {
        t.key<&AccuracyChoice::lobe>("lobe", "null if the highlights keep lobes that differ")
            .or_null();
        t.key<&AccuracyChoice::precision>("precision");
        t.key<&AccuracyChoice::samples>("samples", "per pixel").at_least(1);
      });
}

const Struct& AccuracyOperations::type() {
  return define<AccuracyOperations>(
      "AccuracyOperations", "Weighted operations per point.", [](Struct& t) {
        t.key<&AccuracyOperations::chosen>("chosen");
        t.key<&AccuracyOperations::own_in_float64>("ownInFloat64", "of the scene's own lobe");
      });
}

const Struct& AccuracyReached::type() {
  return define<AccuracyReached>(
      "AccuracyReached", "What a check of the finished picture found.", [](Struct& t) {
        t.key<&AccuracyReached::value>("value", "0 for a black picture").may_be_nonfinite();
        t.key<&AccuracyReached::held>("held");
        t.key<&AccuracyReached::against>("against", "the ground truth");
        t.key<&AccuracyReached::seconds>("seconds", "to make the ground truth").unit("seconds");
      });
}

const Struct& Accuracy::type() {
  return define<Accuracy>(
      "Accuracy", "A picture by the accuracy that was asked for; see docs/cost.md.", [](Struct& t) {
        t.key<&Accuracy::asked>("asked");
        t.key<&Accuracy::unit>("unit").one_of(kAccuracyUnits);
        t.key<&Accuracy::measure>("measure");
        t.key<&Accuracy::chose>("chose");
        t.key<&Accuracy::why>("why");
        t.key<&Accuracy::operations>("operations");
        t.key<&Accuracy::basis>("basis").one_of(kBases);
        t.key<&Accuracy::predicted>("predicted", "will not be exceeded");
        t.key<&Accuracy::reached>("reached", "missing with --accuracy-check none");
      });
}

const Struct& RenderSeconds::type() {
  return define<RenderSeconds>("RenderSeconds", "Time by stage, in seconds.", [](Struct& t) {
    t.key<&RenderSeconds::plan>("plan");
    t.key<&RenderSeconds::render>("render");
    t.key<&RenderSeconds::total>("total", "plan and render");
    t.key<&RenderSeconds::read>("read", "the scene");
    t.key<&RenderSeconds::pack>("pack", "rows of the picture; part of render");
    t.key<&RenderSeconds::write>("write", "the finished file");
  });
}

const Struct& Render::type() {
  return define<Render>("Render", "A picture by Lobelia.", [](Struct& t) {
    t.kind("render");
    t.key<&Render::engine>("engine");
    t.key<&Render::command>("command", "makes it again, in the cell's directory");
    t.key<&Render::image>("image");
    t.key<&Render::highlights>("highlights", "as rendered, by material");
    t.key<&Render::samples>("samples", "per pixel; at most, if antialiasing chose its pixels")
        .at_least(1);
    t.key<&Render::seed>("seed");
    t.key<&Render::estimated_error>(
         "estimatedError",
         "RMS of the expected error over RMS of the picture, where something is random")
        .may_be_nonfinite();
    t.key<&Render::stopped>("stopped", "why no more samples were taken").if_any();
    t.key<&Render::remarks>("remarks", "what is odd about the scene").if_any();
    t.key<&Render::plan>("plan");
    t.key<&Render::rays>("rays");
    t.key<&Render::instruction_set>("instructionSet");
    t.key<&Render::seconds>("seconds");
    t.key<&Render::standard_error>("standardError", "file with the standard error of each value")
        .if_any();
    t.key<&Render::accuracy>("accuracy", "with --accuracy");
  });
}

const Struct& EngineSeconds::type() {
  return define<EngineSeconds>(
      "EngineSeconds", "Time that an engine took, in seconds.", [](Struct& t) {
        t.key<&EngineSeconds::total>(
             "total",
             "the engine's work: POV-Ray's processes added up, Blender's render call alone")
            .at_least(0);
        t.key<&EngineSeconds::start>("start");
        t.key<&EngineSeconds::parse>("parse");
        t.key<&EngineSeconds::trace>("trace");
        t.key<&EngineSeconds::write>("write");
      });
}

const Struct& Reference::type() {
  return define<Reference>("Reference", "A picture by a reference engine.", [](Struct& t) {
    t.kind("reference");
    t.key<&Reference::engine>("engine");
    t.key<&Reference::image>("image");
    t.key<&Reference::witness>("witness",
                               "the engine's own shading of the model, the model written in the "
                               "engine's language, or its formulas pixel by pixel")
        .one_of(kWitnesses);
    t.key<&Reference::method>("method");
    t.key<&Reference::passes>("passes");
    t.key<&Reference::points>("points", "of each area light, of the lens and of the pixel");
    t.key<&Reference::seed>("seed", "of these points");
    t.key<&Reference::engine_commands>("engineCommands",
                                       "without the temporary directory they ran in");
    t.key<&Reference::engine_options>("engineOptions", "of POV-Ray's .ini files, file names aside")
        .if_any();
    t.key<&Reference::writes_limited>(
        "writesLimited", "the kernel kept the engine from writing outside that directory");
    t.key<&Reference::contained>("contained", "what ends the engine's processes").if_any();
    t.key<&Reference::seconds>("seconds");
    t.key<&Reference::cpu_seconds>("cpuSeconds", "user and system, of all processes")
        .unit("seconds");
    t.key<&Reference::peak_memory_bytes>(
         "peakMemoryBytes", "resident, of the largest process; of Blender since it started")
        .unit("bytes");
    t.key<&Reference::threads>("threads", "that each process may use");
    t.key<&Reference::command>("command", "makes it again, in the cell's directory");
    t.key<&Reference::standard_error>("standardError", "file with the standard error of each value")
        .if_any();
    t.key<&Reference::highlights>("highlights").if_any();
  });
}

const Struct& EngineFound::type() {
  return define<EngineFound>(
      "EngineFound", "A reference engine and what is known of it here.", [](Struct& t) {
        t.key<&EngineFound::name>("name", "as --engine takes it");
        t.key<&EngineFound::title>("title");
        t.key<&EngineFound::available>("available");
        t.key<&EngineFound::state>("state").one_of(kEngineStates);
        t.key<&EngineFound::program>("program", "missing if none was found").if_any();
        t.key<&EngineFound::version>("version", "missing if it told none").if_any();
        t.key<&EngineFound::why>("why", "why it cannot be used").if_any();
        t.key<&EngineFound::supported_versions>("supportedVersions");
        t.key<&EngineFound::witness>("witness", "models that it shades itself, and by our formula");
        t.key<&EngineFound::precision>("precision", "of its pictures");
        t.key<&EngineFound::effects>("effects", "that scenes for it may have");
        t.key<&EngineFound::install>("install", "the command that installs it");
      });
}

const Struct& Engines::type() {
  return define<Engines>("Engines", "The reference engines.", [](Struct& t) {
    t.kind("engines");
    t.key<&Engines::engines>("engines");
  });
}

}  // namespace lobelia::records

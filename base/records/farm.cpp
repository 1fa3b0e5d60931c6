#include "base/records/farm.hpp"

#include "base/records/render.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kStatuses[] = {"pass",   "differs",   "undecided",
                                          "failed", "unchecked", "missing"};

}  // namespace

void define_farm_tables(Tables& tables) {
  tables.define<AxisValue>("A value of an axis.");
  tables.define<Axis>("An axis of a grid.", [](auto& t) { t.key("values").items(1); });
  tables.define<FarmEngine>(
      "An engine of a farm. An absent one has the version and content of the last run in which "
      "it was there.",
      [](auto& t) {
        t.key("name").plain_name();
        t.key("state").one_of(kEngineStates).if_any();
        t.key("version").if_any();
        t.key("content", "SHA-256 of its program, libraries and data").if_any();
        t.key("why", "why it is not available").if_any();
        t.key("install", "the command that installs it").if_any();
        t.key("refusedCells", "cells that the engine cannot show");
        t.key("models").if_any();
      });
  tables.define<FarmCell>("A cell and its verdict.", [](auto& t) {
    t.key("id").plain_name();
    t.key("status").one_of(kStatuses);
  });
  tables.define<Locks>("Whether other machines see the locks in the cache.");
  tables.define<Farm>("The grid, the engines, the cells and their verdicts.", [](auto& t) {
    t.kind("farm");
    t.key("authors", "of the study, as the grid names them").if_any();
    t.key("url", "where the study is published").if_any();
    t.key("grid", "file name");
    t.key("cache", "directory, relative to the farm's").if_any();
    t.key("axes", "in the grid's order").items(1);
    t.key("engines").items(1);
    t.key("reference", "the engine that all are compared with; without it Lobelia").if_any();
  });
  tables.define<CellImage>("A picture of a cell.", [](auto& t) {
    t.keys({"engine", "record"}).plain_name();
    t.key("exr", "linear float32").plain_name().if_any();
    t.key("png", "at the cell's exposure").plain_name().if_any();
    t.key("sha256", "of the EXR");
  });
  tables.define<NotComparable>("An engine that cannot show what the cell is about.");
  tables.define<CellProblem>("What failed.",
                             [](auto& t) { t.key("failure", "a class of docs/farm.md"); });
  tables.define<MadeFrom>("What a cell was made of.", [](auto& t) {
    t.key("program", "to the build");
    t.key("libraries", "SHA-256");
    t.key("scene", "SHA-256 of scene.xml");
    t.key("contents", "SHA-256 by engine");
    t.key("engines", "version by engine");
  });
  tables.define<CellFile>("A file of a cell.", [](auto& t) { t.key("name").plain_name(); });
  tables.define<Cell>("One scene of a grid: its pictures, comparisons and verdict.", [](auto& t) {
    t.kind("cell", Seal::kYes);
    t.key("id").plain_name();
    t.key("status").one_of(kStatuses);
    t.key("exposureStops").unit("stops");
    t.key("profile").plain_name().if_any();
    t.key("missingEngines", "absent ones that were to be compared with and have no picture here")
        .if_any();
    t.key("results", "key of the result of each job");
    t.key("files", "of all results; records of earlier versions have none").if_any();
  });
  tables.define<StatusCounts>("How many cells there are of each status.");
  tables.define<FailureOfCell>("What failed, and in which cell.",
                               [](auto& t) { t.key("failure", "a class of docs/farm.md"); });
  tables.define<FarmStatus>("How far a farm is: 'lobelia farm status DIR --json FILE'.",
                            [](auto& t) {
                              t.kind("farm-status");
                              t.key("cells", "how many there are");
                              t.key("cache", "its path");
                              t.key("atWork", "a farm uses the cache now");
                            });
  tables.define<ExplainedPart>("A part of a result's key, then and now.", [](auto& t) {
    t.key("files", "sentences: which files changed, at most five").if_any();
  });
  tables.define<ExplainedJob>("A job, and what its result was made of.",
                              [](auto& t) { t.key("why", "why it is not in the cache").if_any(); });
  tables.define<FarmExplanation>(
      "Why a cell's results are made again: 'lobelia farm explain DIR CELL --json FILE'.",
      [](auto& t) {
        t.kind("farm-explanation");
        t.key("without", "sentences: why an engine has no result");
      });
  tables.define<GalleryList>(
      "The files that publishing wrote. The next time only these are replaced or removed.",
      [](auto& t) {
        t.kind("gallery");
        t.key("files", "paths within the site");
        t.key("madeOf", "what slow files were made of; they are made again if that changes");
      });
}

}  // namespace lobelia::records

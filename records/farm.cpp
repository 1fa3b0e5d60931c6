#include "records/farm.hpp"

#include "records/render.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kStatuses[] = {"pass",   "differs",   "undecided",
                                          "failed", "unchecked", "missing"};

}  // namespace

const Struct& AxisValue::type() {
  return define<AxisValue>("AxisValue", "A value of an axis.", [](Struct& t) {
    t.key<&AxisValue::value>("value");
    t.key<&AxisValue::label>("label");
  });
}

const Struct& Axis::type() {
  return define<Axis>("Axis", "An axis of a grid.", [](Struct& t) {
    t.key<&Axis::name>("name");
    t.key<&Axis::values>("values").items(1);
  });
}

const Struct& FarmEngine::type() {
  return define<FarmEngine>(
      "FarmEngine",
      "An engine of a farm. An absent one has the version and content of the last run in which "
      "it was there.",
      [](Struct& t) {
        t.key<&FarmEngine::name>("name").plain_name();
        t.key<&FarmEngine::title>("title");
        t.key<&FarmEngine::available>("available");
        t.key<&FarmEngine::state>("state").one_of(kEngineStates).if_any();
        t.key<&FarmEngine::version>("version").if_any();
        t.key<&FarmEngine::content>("content", "SHA-256 of its program, libraries and data")
            .if_any();
        t.key<&FarmEngine::why>("why", "why it is not available").if_any();
        t.key<&FarmEngine::install>("install", "the command that installs it").if_any();
        t.key<&FarmEngine::refused_cells>("refusedCells", "cells that the engine cannot show");
      });
}

const Struct& FarmCell::type() {
  return define<FarmCell>("FarmCell", "A cell and its verdict.", [](Struct& t) {
    t.key<&FarmCell::id>("id").plain_name();
    t.key<&FarmCell::status>("status").one_of(kStatuses);
    t.key<&FarmCell::axes>("axes");
  });
}

const Struct& Locks::type() {
  return define<Locks>("Locks", "Whether other machines see the locks in the cache.",
                       [](Struct& t) {
                         t.key<&Locks::shared>("shared");
                         t.key<&Locks::why>("why");
                       });
}

const Struct& Farm::type() {
  return define<Farm>("Farm", "The grid, the engines, the cells and their verdicts.",
                      [](Struct& t) {
                        t.kind("farm");
                        t.key<&Farm::title>("title");
                        t.key<&Farm::grid>("grid", "file name");
                        t.key<&Farm::command>("command");
                        t.key<&Farm::host>("host");
                        t.key<&Farm::cache>("cache", "directory, relative to the farm's").if_any();
                        t.key<&Farm::locks>("locks");
                        t.key<&Farm::axes>("axes", "in the grid's order").items(1);
                        t.key<&Farm::engines>("engines").items(1);
                        t.key<&Farm::cells>("cells");
                      });
}

const Struct& CellImage::type() {
  return define<CellImage>("CellImage", "A picture of a cell.", [](Struct& t) {
    t.key<&CellImage::engine>("engine").plain_name();
    t.key<&CellImage::exr>("exr", "linear float32").plain_name().if_any();
    t.key<&CellImage::png>("png", "at the cell's exposure").plain_name().if_any();
    t.key<&CellImage::record>("record").plain_name();
    t.key<&CellImage::sha256>("sha256", "of the EXR");
  });
}

const Struct& NotComparable::type() {
  return define<NotComparable>("NotComparable",
                               "An engine that cannot show what the cell is about.", [](Struct& t) {
                                 t.key<&NotComparable::engine>("engine");
                                 t.key<&NotComparable::because>("because");
                               });
}

const Struct& CellProblem::type() {
  return define<CellProblem>("CellProblem", "What failed.", [](Struct& t) {
    t.key<&CellProblem::engine>("engine");
    t.key<&CellProblem::message>("message");
    t.key<&CellProblem::failure>("failure", "a class of docs/farm.md");
    t.key<&CellProblem::attempts>("attempts");
  });
}

const Struct& MadeFrom::type() {
  return define<MadeFrom>("MadeFrom", "What a cell was made of.", [](Struct& t) {
    t.key<&MadeFrom::program>("program", "to the build");
    t.key<&MadeFrom::libraries>("libraries", "SHA-256");
    t.key<&MadeFrom::arithmetic>("arithmetic");
    t.key<&MadeFrom::scene>("scene", "SHA-256 of scene.xml");
    t.key<&MadeFrom::contents>("contents", "SHA-256 by engine");
    t.key<&MadeFrom::engines>("engines", "version by engine");
  });
}

const Struct& CellFile::type() {
  return define<CellFile>("CellFile", "A file of a cell.", [](Struct& t) {
    t.key<&CellFile::name>("name").plain_name();
    t.key<&CellFile::sha256>("sha256");
  });
}

const Struct& Cell::type() {
  return define<Cell>(
      "Cell", "One scene of a grid: its pictures, comparisons and verdict.", [](Struct& t) {
        t.kind("cell", Seal::kYes);
        t.key<&Cell::id>("id").plain_name();
        t.key<&Cell::axes>("axes");
        t.key<&Cell::status>("status").one_of(kStatuses);
        t.key<&Cell::highlight>("highlight");
        t.key<&Cell::exposure_stops>("exposureStops").unit("stops");
        t.key<&Cell::images>("images");
        t.key<&Cell::comparisons>("comparisons");
        t.key<&Cell::profile>("profile").plain_name().if_any();
        t.key<&Cell::not_comparable>("notComparable");
        t.key<&Cell::missing_engines>(
             "missingEngines", "absent ones that were to be compared with and have no picture here")
            .if_any();
        t.key<&Cell::problems>("problems");
        t.key<&Cell::made_from>("madeFrom");
        t.key<&Cell::results>("results", "key of the result of each job");
        t.key<&Cell::files>("files", "of all results; records of earlier versions have none")
            .if_any();
      });
}

const Struct& StatusCounts::type() {
  return define<StatusCounts>("StatusCounts", "How many cells there are of each status.",
                              [](Struct& t) {
                                t.key<&StatusCounts::failed>("failed");
                                t.key<&StatusCounts::differs>("differs");
                                t.key<&StatusCounts::undecided>("undecided");
                                t.key<&StatusCounts::missing>("missing");
                                t.key<&StatusCounts::unchecked>("unchecked");
                                t.key<&StatusCounts::pass>("pass");
                              });
}

const Struct& FailureOfCell::type() {
  return define<FailureOfCell>("FailureOfCell", "What failed, and in which cell.", [](Struct& t) {
    t.key<&FailureOfCell::cell>("cell");
    t.key<&FailureOfCell::engine>("engine");
    t.key<&FailureOfCell::failure>("failure", "a class of docs/farm.md");
    t.key<&FailureOfCell::attempts>("attempts");
    t.key<&FailureOfCell::message>("message");
  });
}

const Struct& FarmStatus::type() {
  return define<FarmStatus>("FarmStatus", "How far a farm is: 'lobelia farm status DIR --json'.",
                            [](Struct& t) {
                              t.kind("farm-status");
                              t.key<&FarmStatus::title>("title");
                              t.key<&FarmStatus::cells>("cells", "how many there are");
                              t.key<&FarmStatus::status>("status");
                              t.key<&FarmStatus::cache>("cache", "its path");
                              t.key<&FarmStatus::cache_is_there>("cacheIsThere");
                              t.key<&FarmStatus::at_work>("atWork", "a farm uses the cache now");
                              t.key<&FarmStatus::failures>("failures");
                            });
}

const Struct& ExplainedPart::type() {
  return define<ExplainedPart>(
      "ExplainedPart", "A part of a result's key, then and now.", [](Struct& t) {
        t.key<&ExplainedPart::part>("part");
        t.key<&ExplainedPart::was>("was");
        t.key<&ExplainedPart::now>("now");
        t.key<&ExplainedPart::same>("same");
        t.key<&ExplainedPart::files>("files", "sentences: which files changed, at most five")
            .if_any();
      });
}

const Struct& ExplainedJob::type() {
  return define<ExplainedJob>(
      "ExplainedJob", "A job, and what its result was made of.", [](Struct& t) {
        t.key<&ExplainedJob::job>("job");
        t.key<&ExplainedJob::key>("key");
        t.key<&ExplainedJob::in_cache>("inCache");
        t.key<&ExplainedJob::why>("why", "why it is not in the cache").if_any();
        t.key<&ExplainedJob::parts>("parts");
      });
}

const Struct& FarmExplanation::type() {
  return define<FarmExplanation>(
      "FarmExplanation",
      "Why a cell's results are made again: 'lobelia farm explain DIR CELL --json'.",
      [](Struct& t) {
        t.kind("farm-explanation");
        t.key<&FarmExplanation::cell>("cell");
        t.key<&FarmExplanation::status>("status");
        t.key<&FarmExplanation::jobs>("jobs");
        t.key<&FarmExplanation::without>("without", "sentences: why an engine has no result");
      });
}

const Struct& GalleryList::type() {
  return define<GalleryList>(
      "GalleryList",
      "The files that publishing wrote. The next time only these are replaced or removed.",
      [](Struct& t) {
        t.kind("gallery");
        t.key<&GalleryList::files>("files", "paths within the site");
        t.key<&GalleryList::made_of>(
            "madeOf", "what slow files were made of; they are made again if that changes");
      });
}

}  // namespace lobelia::records

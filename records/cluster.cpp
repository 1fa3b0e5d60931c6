#include "records/cluster.hpp"

namespace lobelia::records {

const Struct& ChunkLimits::type() {
  return define<ChunkLimits>("ChunkLimits", "Limits of a chunk's jobs.", [](Struct& t) {
    t.key<&ChunkLimits::time_limit>("timeLimit").unit("seconds").within(0.1, 1e6);
    t.key<&ChunkLimits::no_progress_limit>("noProgressLimit").unit("seconds").within(0, 1e6);
    t.key<&ChunkLimits::attempts>("attempts").within(1, 100);
    t.key<&ChunkLimits::memory>("memory").unit("bytes").within(0, 1e18);
    t.key<&ChunkLimits::disk>("disk").unit("bytes").within(0, 1e18);
    t.key<&ChunkLimits::give_up_after>("giveUpAfter").within(0, 1e6);
  });
}

const Struct& ChunkEngine::type() {
  return define<ChunkEngine>("ChunkEngine", "An engine as the plan has it.", [](Struct& t) {
    t.key<&ChunkEngine::name>("name");
    t.key<&ChunkEngine::version>("version");
    t.key<&ChunkEngine::content>("content", "SHA-256");
    t.key<&ChunkEngine::program>("program", "path, where one was given").if_any();
  });
}

const Struct& ChunkCell::type() {
  return define<ChunkCell>("ChunkCell", "A cell of a chunk.", [](Struct& t) {
    t.key<&ChunkCell::id>("id");
    t.key<&ChunkCell::engines>("engines");
    t.key<&ChunkCell::scene>("scene", "the text of its file").most_text(64u << 20);
    t.key<&ChunkCell::jobs>("jobs", "names");
  });
}

const Struct& FarmChunk::type() {
  return define<FarmChunk>(
      "FarmChunk", "What an element of a cluster's job does: chunks/N.json.", [](Struct& t) {
        t.kind("farm-chunk");
        t.key<&FarmChunk::program>("program");
        t.key<&FarmChunk::libraries>("libraries", "SHA-256");
        t.key<&FarmChunk::arithmetic>("arithmetic");
        t.key<&FarmChunk::cache>("cache");
        t.key<&FarmChunk::limits>("limits");
        t.key<&FarmChunk::failed>("failed",
                                  "absolute path of the directory for inputs of failed jobs");
        t.key<&FarmChunk::engines>("engines");
        t.key<&FarmChunk::cells>("cells");
      });
}

const Struct& LeftUndone::type() {
  return define<LeftUndone>(
      "LeftUndone", "What an element left undone because of its node.", [](Struct& t) {
        t.key<&LeftUndone::engine>("engine", "empty: all of the chunk").most_text(64);
        t.key<&LeftUndone::why>("why");
      });
}

const Struct& FarmChunkReport::type() {
  return define<FarmChunkReport>(
      "FarmChunkReport", "What an element tells of its node: reports/N.json.", [](Struct& t) {
        t.kind("farm-chunk-report");
        t.key<&FarmChunkReport::node>("node");
        t.key<&FarmChunkReport::left>("left").items(0, 100);
      });
}

const Struct& FarmRun::type() {
  return define<FarmRun>(
      "FarmRun", "What the last element needs to put the farm's directory together: run.json.",
      [](Struct& t) {
        t.kind("farm-run");
        t.key<&FarmRun::program>("program");
        t.key<&FarmRun::libraries>("libraries", "SHA-256");
        t.key<&FarmRun::arithmetic>("arithmetic");
        t.key<&FarmRun::grid>("grid");
        t.key<&FarmRun::directory>("directory");
        t.key<&FarmRun::cache>("cache");
        t.key<&FarmRun::command>("command");
        t.key<&FarmRun::gallery>("gallery", "where its site is published").if_any();
        t.key<&FarmRun::programs>("programs", "by engine");
      });
}

const Struct& SlurmArray::type() {
  return define<SlurmArray>("SlurmArray", "A job of a run.", [](Struct& t) {
    t.key<&SlurmArray::job>("job");
    t.key<&SlurmArray::first_chunk>("firstChunk");
    t.key<&SlurmArray::chunks>("chunks");
    t.key<&SlurmArray::phase>("phase",
                              "0 pictures, 1 what reads them, -1 the element that ends a round");
    t.key<&SlurmArray::round>("round");
    t.key<&SlurmArray::time>("time", "asked for").if_any();
    t.key<&SlurmArray::memory>("memory", "asked for").if_any();
  });
}

const Struct& SlurmRun::type() {
  return define<SlurmRun>(
      "SlurmRun", "Which jobs there are. A client that comes later goes on from it: slurm.json.",
      [](Struct& t) {
        t.kind("slurm-run");
        t.key<&SlurmRun::name>("name").most_text(99);
        t.key<&SlurmRun::round>("round").at_least(0);
        t.key<&SlurmRun::next_chunk>("nextChunk").at_most(1e9);
        t.key<&SlurmRun::first_report>("firstReport", "earlier reports were another run's");
        t.key<&SlurmRun::arrays>("arrays");
      });
}

const Struct& SlurmDoctor::type() {
  return define<SlurmDoctor>(
      "SlurmDoctor", "What the doctor's job found on a node; empty texts where all is well.",
      [](Struct& t) {
        t.kind("slurm-doctor");
        t.key<&SlurmDoctor::host>("host");
        t.key<&SlurmDoctor::version>("version");
        t.key<&SlurmDoctor::token>("token");
        t.key<&SlurmDoctor::rename>("rename");
        t.key<&SlurmDoctor::link>("link");
        t.key<&SlurmDoctor::lock>("lock");
      });
}

}  // namespace lobelia::records

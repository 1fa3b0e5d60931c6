#include "records/cluster.hpp"

namespace lobelia::records {

const Struct& ChunkLimits::type() {
  return define<ChunkLimits>("Limits of a chunk's jobs.", [](auto& t) {
    t.key("timeLimit").unit("seconds").within(0.1, 1e6);
    t.key("noProgressLimit").unit("seconds").within(0, 1e6);
    t.key("attempts").within(1, 100);
    t.keys({"memory", "disk"}).unit("bytes").within(0, 1e18);
    t.key("giveUpAfter").within(0, 1e6);
  });
}

const Struct& ChunkEngine::type() {
  return define<ChunkEngine>("An engine as the plan has it.", [](auto& t) {
    t.key("content", "SHA-256");
    t.key("program", "path, where one was given").if_any();
  });
}

const Struct& ChunkCell::type() {
  return define<ChunkCell>("A cell of a chunk.", [](auto& t) {
    t.key("scene", "the text of its file").most_text(64u << 20);
    t.key("jobs", "names");
  });
}

const Struct& FarmChunk::type() {
  return define<FarmChunk>("What an element of a cluster's job does: chunks/N.json.", [](auto& t) {
    t.kind("farm-chunk");
    t.key("libraries", "SHA-256");
    t.key("failed", "absolute path of the directory for inputs of failed jobs");
  });
}

const Struct& LeftUndone::type() {
  return define<LeftUndone>("What an element left undone because of its node.", [](auto& t) {
    t.key("engine", "empty: all of the chunk").most_text(64);
  });
}

const Struct& FarmChunkReport::type() {
  return define<FarmChunkReport>("What an element tells of its node: reports/N.json.", [](auto& t) {
    t.kind("farm-chunk-report");
    t.key("left").items(0, 100);
  });
}

const Struct& FarmRun::type() {
  return define<FarmRun>(
      "What the last element needs to put the farm's directory together: run.json.", [](auto& t) {
        t.kind("farm-run");
        t.key("libraries", "SHA-256");
        t.key("gallery", "where its site is published").if_any();
        t.key("programs", "by engine");
      });
}

const Struct& SlurmArray::type() {
  return define<SlurmArray>("A job of a run.", [](auto& t) {
    t.key("phase", "0 pictures, 1 what reads them, -1 the element that ends a round");
    t.key("time", "asked for").if_any();
    t.key("memory", "asked for").if_any();
  });
}

const Struct& SlurmRun::type() {
  return define<SlurmRun>(
      "Which jobs there are. A client that comes later goes on from it: slurm.json.", [](auto& t) {
        t.kind("slurm-run");
        t.key("name").most_text(99);
        t.key("round").at_least(0);
        t.key("nextChunk").at_most(1e9);
        t.key("firstReport", "earlier reports were another run's");
      });
}

const Struct& SlurmDoctor::type() {
  return define<SlurmDoctor>(
      "What the doctor's job found on a node; empty texts where all is well.",
      [](auto& t) { t.kind("slurm-doctor"); });
}

}  // namespace lobelia::records

#include "base/records/cluster.hpp"

namespace lobelia::records {

void define_cluster_tables(Tables& tables) {
  tables.define<ChunkLimits>("Limits of a chunk's jobs.", [](auto& t) {
    t.key("timeLimit").unit("seconds").within(0.1, 1e6);
    t.key("noProgressLimit").unit("seconds").within(0, 1e6);
    t.key("attempts").within(1, 100);
    t.keys({"memory", "disk"}).unit("bytes").within(0, 1e18);
    t.key("giveUpAfter").within(0, 1e6);
  });
  tables.define<OutsideEngine>("An engine of the user's own.", [](auto& t) {
    t.key("directory", "absolute; of the file that describes it");
    t.key("command", "arguments, with {scene}, {out} and others").if_any();
    t.key("versionCommand", "arguments").if_any();
    t.key("files", "of pictures that exist already, with {AXIS}").if_any();
    t.key("scene", "the form in which it gets a scene").if_any();
    t.key("environment", "names of the variables that it gets").if_any();
    t.key("effects", "of light that it can show; without: all");
    t.key("ofValue", "tolerance, as a share of a value").at_least(0);
    t.key("ofPeak", "tolerance, as a share of the peak").at_least(0);
  });
  tables.define<ChunkEngine>("An engine as the plan has it.", [](auto& t) {
    t.key("content", "SHA-256");
    t.key("program", "path, where one was given").if_any();
  });
  tables.define<ChunkCell>("A cell of a chunk.", [](auto& t) {
    t.key("axes", "its values in file names, for outside engines").if_any();
    t.key("scene", "the text of its file").most_text(64u << 20);
    t.key("jobs", "names");
  });
  tables.define<FarmChunk>("What an element of a cluster's job does: chunks/N.json.", [](auto& t) {
    t.kind("farm-chunk");
    t.key("libraries", "SHA-256");
    t.key("truth", "the engine that the others are compared with, if not with Lobelia").if_any();
    t.key("ours", "false: Lobelia's pictures are not compared");
    t.key("failed", "absolute path of the directory for inputs of failed jobs");
  });
  tables.define<LeftUndone>("What an element left undone because of its node.", [](auto& t) {
    t.key("engine", "empty: all of the chunk").most_text(64);
  });
  tables.define<FarmChunkReport>("What an element tells of its node: reports/N.json.", [](auto& t) {
    t.kind("farm-chunk-report");
    t.key("left").items(0, 100);
  });
  tables.define<FarmRun>(
      "What the last element needs to put the farm's directory together: run.json.", [](auto& t) {
        t.kind("farm-run");
        t.key("libraries", "SHA-256");
        t.key("gallery", "where its site is published").if_any();
        t.key("programs", "by engine");
      });
  tables.define<SlurmArray>("A job of a run.", [](auto& t) {
    t.key("phase", "0 pictures, 1 what reads them, -1 the element that ends a round");
    t.key("time", "asked for").if_any();
    t.key("memory", "asked for").if_any();
  });
  tables.define<SlurmRun>(
      "Which jobs there are. A client that comes later goes on from it: slurm.json.", [](auto& t) {
        t.kind("slurm-run");
        t.key("name").most_text(99);
        t.key("round").within(0, 1e9);
        t.key("nextChunk").at_most(1e9);
        t.key("firstReport", "earlier reports were another run's");
      });
  tables.define<SlurmDoctor>(
      "What the doctor's job found on a node; empty texts where all is well.",
      [](auto& t) { t.kind("slurm-doctor"); });
}

}  // namespace lobelia::records

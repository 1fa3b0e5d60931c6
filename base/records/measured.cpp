#include "base/records/measured.hpp"

namespace lobelia::records {

void define_measured_tables(Tables& tables) {
  tables.define<MeasuredFit>(
      "A model and a lobe over a diffuse base, with the parameters nearest to a measured material.",
      [](auto& t) {
        t.key("exponent").between(0, kNoBound);
        t.key("alpha", "of GGX: the root of 2 / (exponent + 2)").within(0, 1);
        t.key("diffuse", "diffuse_reflectance of a scene: red, green and blue");
        t.key("specular", "specular_reflectance of a scene");
        t.key("rmsOfMeasured", "root mean square of the difference, over that of the measurement")
            .at_least(0);
        t.key("largestOfMeasured", "largest difference, over the largest measured value")
            .at_least(0);
        t.key("meanCiede2000",
              "over the sphere in the pictures head_on and oblique_45; a white "
              "diffuse surface that faces the light is white")
            .at_least(0);
        t.key("largestCiede2000", "of a pixel in these pictures").at_least(0);
        t.key("isEndOfRange", "a better exponent may lie beyond");
      });
  tables.define<MeasuredFits>(
      "Models fitted to a measured material: 'lobelia convert FILE.binary --json FILE'.",
      [](auto& t) {
        t.kind("measured-fits");
        t.key("format", "MERL or RGL");
        t.key("remarks", "about the file").if_any();
        t.key("directionPairs", "where the models were compared with the measurement").at_least(1);
        t.key("measuredRms", "root mean square of the measured BRDF times N.L").at_least(0);
        t.key("measuredLargest", "largest measured BRDF times N.L").at_least(0);
        t.key("fits", "smallest rmsOfMeasured first");
      });
}

}  // namespace lobelia::records

#include "base/records/comparison.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kDecoders[] = {"XYZ", "sRGB"};
constexpr std::string_view kToneCurves[] = {"aces", "reinhard", "hable"};

std::string contradiction_of_pair(const PairOfSet& pair) {
  return pair.comparison.has_value() != pair.error.empty() ? "needs either a comparison or an error"
                                                           : "";
}

std::string contradiction_of_place(const NonfinitePlace& place) {
  return place.value - place.value == 0 ? "the value is finite" : "";
}

}  // namespace

void define_comparison_tables(Tables& tables) {
  tables.define<Window>("A part of a picture's plane, y down.", [](auto& t) {
    t.keys({"x", "y"}).unit("pixels");
    t.keys({"width", "height"}).unit("pixels").at_least(1);
  });
  tables.define<PictureRead>("How a file was read.", [](auto& t) {
    t.key("format", "OpenImageIO's name: openexr, png");
    t.key("layer", "empty for the picture itself");
    t.key("channels", "names in the file: three, one for grey, or the two or three of a vector")
        .items(1, 3);
    t.key("valueType", "as stored: half, float, uint8, uint16, uint");
    t.key("transfer", "decoded from: linear, sRGB, Rec709, gamma 1.8, PQ, HLG, ICC profile");
    t.key("multipliedByAlpha", "the file's colours were not");
    t.key("dataWindow", "where the file has values");
    t.key("displayWindow", "the picture");
    t.key("orientation",
          "as TIFF and Exif number it, 2 to 8: what of the stored rows and columns was undone; "
          "missing if nothing")
        .at_least(2);
    t.key("chromaticities",
          "x, y of red, green, blue and white that the colours were converted from; missing if "
          "they are Rec. 709")
        .items(8, 8)
        .if_any();
    t.key("iccProfile", "the profile's own name").if_any();
    t.key("iccProfileIsSrgb", "its primaries and curves are those of sRGB, which is assumed");
    t.key("iccProfileApplied",
          "values became light by it: those of integers do, unless it is sRGB's");
    t.key("gainMap", "\"not applied\" of a JPEG with a gain map; missing if it has none").if_any();
  });
  tables.define<PicturesRead>("How both files were read.");
  tables.define<NonfinitePlace>("A value that is not finite.", [](auto& t) {
    t.keys({"x", "y"}).unit("pixels");
    t.key("channel", "its name in the file");
    t.key("value", R"("nan", "inf" or "-inf")").may_be_nonfinite();
    t.check(contradiction_of_place);
  });
  tables.define<NonfinitePlaces>("The first such value of each picture, in reading order.");
  tables.define<Nonfinite>(
      "Pixels with a NaN or an infinity. Any makes the verdict non-finite, and nothing is "
      "measured.",
      [](auto& t) {
        t.keys({"a", "b"}).unit("pixels").at_least(0);
        t.key("equalAllowed",
              "where both had the same one and that was allowed: not counted in a and b")
            .unit("pixels")
            .at_least(0);
      });
  tables.define<HdrExposures>("The exposures that HDR-FLIP looked at.", [](auto& t) {
    t.keys({"startStops", "stopStops"}).unit("stops");
    t.key("count").at_least(2);
    t.key("automatic", "chosen from the reference, but for what was given");
    t.key("toneCurve").one_of(kToneCurves);
  });
  tables.define<Display>("What OpenColorIO showed the perceptual metrics.", [](auto& t) {
    t.key("configId", "hash of the configuration");
    t.key("decodedBy", "XYZ if the configuration says what light the display gives, else sRGB")
        .one_of(kDecoders);
  });
  tables.define<Viewing>("How the pictures are looked at.", [](auto& t) {
    t.key("exposureStops").unit("stops");
    t.key("tailStops",
          "a second exposure, for the tail of the highlight: of two figures the worse is given")
        .unit("stops");
    t.key("furtherStops",
          "more of them, for highlights that are dark at both; of all figures the worst is given")
        .unit("stops")
        .if_any();
    t.key("pixelsPerDegree").at_least(1e-300);
    t.key("hdrExposures", "missing if HDR-FLIP was not measured");
    t.key("display", "missing for a plain sRGB display");
  });
  tables.define<Mask>("A part of the pictures that a user named.", [](auto& t) {
    t.key("pixels", "inside it").at_least(0);
    t.key("of",
          "what it was made of: rectangles, polygons and files as they were given, and the file "
          "of the scene with the surfaces that it lies on")
        .if_any();
  });
  tables.define<HighlightRegion>("The part that metrics in .highlight are of.", [](auto& t) {
    t.key("pixels", "before it is grown by a metric's footprint").at_least(0);
    t.key("shareOfPeak", "a value of the pixel is at least this share of its picture's brightest")
        .between(0, 1);
  });
  tables.define<LocalHighlight>("A highlight of b, or of a alone; its errors.", [](auto& t) {
    t.keys({"x", "y"}).unit("pixels");
    t.key("peak", "radiance of its brightest pixel, which is at x, y");
    t.key("base", "radiance around it");
    t.key("pixels", "that connect to the peak, above a twentieth of its height").at_least(1);
    t.key("gone", "a has less than a tenth of its light; width and shift are 0");
    t.key("onlyInA", "b has less than a tenth of its light; width and shift are 0");
    t.key("energy",
          "a / b - 1, over its surroundings; of one that only a has, the share that b lacks");
    t.key("width", "a / b - 1");
    t.keys({"shiftX", "shiftY"}).unit("pixels");
    t.key("excess",
          "the largest of its three errors in units of the default limits, after what noise and "
          "rounding explain; more than 1 differs")
        .at_least(0);
    t.key("energyBeyond",
          "size of energy without what noise, rounding and the roughness of b explain; of all "
          "highlights the largest is highlights.energy")
        .at_least(0);
    t.key("widthBeyond", "the same of width, for highlights.width").at_least(0);
    t.key("shiftBeyond", "the same of the distance of the centres, for highlights.shift")
        .unit("pixels")
        .at_least(0);
    t.key("channel", "if energy is that of one colour, and of all together less than half as much")
        .one_of(kChannels)
        .if_any();
  });
  tables.define<NotMeasured>("A metric that could not be computed. A limit on it fails.");
  tables.define<Limit>("A limit, and what was measured.", [](auto& t) {
    t.key("limit", "the last value that passes; the metric says which way");
    t.key("value").may_be_nonfinite();
    t.key("standing", "with noise: for the whole error bar, or up to it")
        .one_of(kStandings)
        .if_any();
    t.key("moreSamples", "estimated factor of extra samples needed to decide")
        .at_least(0)
        .may_be_nonfinite();
  });
  tables.define<PictureNoise>("The known noise of a picture.", [](auto& t) {
    t.key("freedom", "degrees of freedom of each value's error").at_least(1).may_be_nonfinite();
    t.key("shared", "its pixels err together");
    t.key("layer", "of the picture's own file, that says it").if_any();
    t.key("fireflies", "share of pixels that err more than six times as much as all around them")
        .at_least(0);
    t.key("heavyTails", "there are so many fireflies that the noise is far from normal");
  });
  tables.define<Uncertainty>("How the noise of the pictures was taken into account.", [](auto& t) {
    t.key("significance", "chance that equal expectations are called different").between(0, 1);
    t.key("judges", "limits that share it; all tests of values and regions are one, which has half")
        .at_least(1);
    t.key("tests", "values, regions and patterns that were tested").at_least(0);
    t.key("each", "significance level of the test of a pixel's value").between(0, 1);
    t.key("bootstraps").at_least(4);
  });
  tables.define<ErrorBar>(
      "How far noise alone moves a metric; docs/metrics.md defines the figures.", [](auto& t) {
        t.key("standardError").at_least(0).may_be_nonfinite();
        t.keys({"noiseFloor", "noiseFloorMost", "low", "high"}).may_be_nonfinite();
      });
  tables.define<Tolerance>("How far each value may be from the reference.", [](auto& t) {
    t.key("relative", "share of the reference's value").at_least(0);
    t.key("ofPeak", "share of the reference's brightest value").at_least(0);
    t.key("allowedOutliers").unit("pixels").at_least(0);
    t.key("onEdgesOnly", "no outlier but on silhouettes, terminators and shadow edges");
  });
  tables.define<ReferenceFloor>("How far a second reference is from b.", [](auto& t) {
    t.key("c", "file of the second reference");
    t.key("nonfinite").unit("pixels").at_least(0);
    t.key("metrics", "of c against b").may_be_nonfinite();
  });
  static constexpr std::string_view kFinding =
      "of identifiers that differ: which one is most often where another should be";
  tables.define<LayerComparison>("The comparison of another layer of both files.", [](auto& t) {
    t.key("type", "what its values are").one_of(kLayerTypes).if_any();
    t.key("verdict").one_of(kVerdicts);
    t.key("overscan",
          "this is the comparison of all data on this window, seen from the display window's "
          "first pixel");
    t.key("identical", "every value is the same, and nothing was measured");
    t.key("problem",
          "in place of what is measured: their sizes differ, or one alone has data outside of "
          "the display window, or an alpha")
        .not_empty()
        .if_any();
    t.key("metrics").may_be_nonfinite();
    t.key("notMeasured").if_any();
    t.key("finding", kFinding).if_any();
    t.needs({{"nonfinite", "metrics", "limits"}, {"identical"}, {"problem"}});
  });
  tables.define<NotCompared>("What the verdict does not depend on.", [](auto& t) {
    t.key("layers", "names of layers of either file; the picture's is empty");
    t.key("alpha", "one of the pictures has an alpha that was not judged");
    t.key("overscanPixels", "outside of the display window").at_least(0);
    t.key("mipLevels", "besides the first").at_least(0);
  });
  tables.define<LayersInOne>(
      "Layers that one file alone has. One that b alone has is a difference.");
  tables.define<Fault>(
      "A kind of difference that the values themselves tell; compare/faults.hpp says how.",
      [](auto& t) {
        t.key("kind").one_of(kFaultKinds);
        t.key("picture", "the one that is so against the other: a or b");
        t.key("value", "of that picture: the level at which it is clipped, or the bright pixel");
        t.key("other", "of the other picture there, at most");
        t.keys({"x", "y"}).unit("pixels");
        t.key("rest", "the largest difference of all other pixels, by the other picture's peak");
      });
  tables.define<Comparison>("A picture compared with a reference.", [](auto& t) {
    t.kind("comparison");
    t.key("verdict",
          "the worst of the picture's and its layers'; the last three "
          "where the noise of a picture is known")
        .one_of(kVerdicts);
    t.key("a", "file of the picture that was judged");
    t.key("b", "file of the reference");
    t.key("type", "what the values of the compared layer are; missing for colour")
        .one_of(kLayerTypes)
        .if_any();
    t.key("finding", kFinding).if_any();
    t.key("mask", "the part in which metrics were measured again");
    t.key("ignored", "the pixels that count as equal: in a they have the values of b");
    t.key("crop", "the part of both files that was compared; if missing, all");
    t.key("highlights", "of b, each judged by itself; the worst 32, the worst first").if_any();
    t.key("metrics", "docs/metrics.md says what each is and what it needs").may_be_nonfinite();
    t.key("notMeasured").if_any();
    t.key("limits").items(1);
    t.key("warnings", "limits that are no part of the verdict").if_any();
    t.key("disagreement", "sentences: which limits say opposite things by far");
    t.key("blindLimits", "sentences: what the limits that were given cannot see").if_any();
    t.key("faults", "of a picture that does not pass").if_any();
    t.key("errorBars", "by metric, where the noise is known");
    t.key("layers",
          "what was compared besides the display window of the picture: its alpha, overscan, "
          "and with --all-layers the other layers of both files");
    t.key("layersInOne", "with --all-layers");
  });
  tables.define<SetSummary>("How many pairs there are of each kind.", [](auto& t) {
    t.key("errors", "pairs that could not be compared");
    t.key("missing", "only b has them");
    t.key("extra", "only a has them");
    t.key("passedOver", "files of both that are no pictures by their ending");
    t.key("known", "that would not pass, but for a known difference");
    t.key("misnamed", "files that nearly are frames of a sequence");
  });
  tables.define<SetNotCompared>(
      "What was not compared of all pairs: names once, pixels added up, levels at their most.",
      [](auto& t) {
        t.keys({"overscanPixels", "mipLevels"}).at_least(0);
        t.key("pairs", "that have something");
      });
  tables.define<WorstOfSet>("A metric over all pairs that have it.", [](auto& t) {
    t.key("value", "furthest the wrong way").may_be_nonfinite();
    t.key("pair", "the first pair that has it");
    t.key("mean").may_be_nonfinite();
  });
  tables.define<Known>("What a project says of a difference.",
                       [](auto& t) { t.key("isExpired", "it counts again"); });
  tables.define<PairOfSet>("A pair of files of one name.", [](auto& t) {
    t.key("name", "the path within both folders, or what else they have in common");
    t.key("references", "of several that are acceptable b is the best");
    t.key("error", "why there is no comparison").not_empty().if_any();
    t.needs({{"comparison"}, {"error"}});
    t.check(contradiction_of_pair);
  });
  tables.define<ComparisonSet>(
      "All pictures of a folder compared with those of another one.", [](auto& t) {
        t.kind("comparison-set");
        t.key("a", "the folder that was judged");
        t.key("b", "the folder of references");
        t.key("c", "the folder of second references").if_any();
        t.key("worst", "by metric");
        t.key("missing", "only b has them");
        t.key("extra", "only a has them");
        t.key("linksNotFollowed",
              "links in a or b to a folder outside it, or to nothing; any makes the exit code 1");
        t.key("misnamed",
              "files that nearly are frames of a sequence, as f.01.exr is of f.%d.exr; any makes "
              "the exit code 1")
            .if_any();
      });
  tables.define<ChangedCopy>("A changed copy of the picture.", [](auto& t) {
    t.key("name", "what was changed");
    t.key("expected", "what limits should do").one_of(kExpected);
    t.key("verdict").one_of(kVerdicts);
    t.key("foundBy", "the limits that it broke");
  });
  tables.define<GivenLimit>("A limit that was given.",
                            [](auto& t) { t.key("limit", "the last value that passes"); });
  tables.define<Sensitivity>("What limits find in changed copies of a picture.", [](auto& t) {
    t.kind("sensitivity");
    t.key("a", "file of the picture");
    t.key("asExpected", "every change that matters was found, and nothing else");
    t.key("defaultLimits", "the default limits were judged too");
    t.key("limits", "besides the default ones");
    t.key("changes").items(1);
  });
}

}  // namespace lobelia::records

#include "records/comparison.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kVerdicts[] = {"pass", "differs",   "non-finite",
                                          "same", "different", "undecided"};
constexpr std::string_view kStandings[] = {"holds", "broken", "open"};
constexpr std::string_view kNonfiniteValues[] = {"nan", "inf", "-inf"};
constexpr std::string_view kDecoders[] = {"XYZ", "sRGB"};
constexpr std::string_view kToneCurves[] = {"aces"};

std::string contradiction_of_pair(const PairOfSet& pair) {
  return pair.comparison.has_value() != pair.error.empty() ? "needs either a comparison or an error"
                                                           : "";
}

std::string contradiction_of_place(const NonfinitePlace& place) {
  return place.value - place.value == 0 ? "the value is finite" : "";
}

}  // namespace

const Struct& Window::type() {
  return define<Window>("Window", "A part of a picture's plane, y down.", [](Struct& t) {
    t.key<&Window::x>("x").unit("pixels");
    t.key<&Window::y>("y").unit("pixels");
    t.key<&Window::width>("width").unit("pixels").at_least(1);
    t.key<&Window::height>("height").unit("pixels").at_least(1);
  });
}

const Struct& PictureRead::type() {
  return define<PictureRead>("PictureRead", "How a file was read.", [](Struct& t) {
    t.key<&PictureRead::format>("format", "OpenImageIO's name: openexr, png");
    t.key<&PictureRead::layer>("layer", "empty for the picture itself");
    t.key<&PictureRead::channels>(
         "channels", "names in the file: three, one for grey, or the two or three of a vector")
        .items(1, 3);
    t.key<&PictureRead::value_type>("valueType", "as stored: half, float, uint8, uint16, uint");
    t.key<&PictureRead::transfer>("transfer", "decoded from: linear, sRGB, Rec709, gamma 1.8");
    t.key<&PictureRead::multiplied_by_alpha>("multipliedByAlpha", "the file's colours were not");
    t.key<&PictureRead::data>("dataWindow", "where the file has values");
    t.key<&PictureRead::display>("displayWindow", "the picture");
    t.key<&PictureRead::chromaticities>(
         "chromaticities",
         "x, y of red, green, blue and white that the colours were converted from; missing if "
         "they are Rec. 709")
        .items(8, 8)
        .if_any();
    t.key<&PictureRead::icc_profile>("iccProfile", "the profile's own name; it is not applied")
        .if_any();
    t.key<&PictureRead::icc_is_srgb>(
        "iccProfileIsSrgb", "its primaries and curves are those of sRGB, which is assumed");
  });
}

const Struct& PicturesRead::type() {
  return define<PicturesRead>("PicturesRead", "How both files were read.", [](Struct& t) {
    t.key<&PicturesRead::a>("a");
    t.key<&PicturesRead::b>("b");
  });
}

const Struct& NonfinitePlace::type() {
  return define<NonfinitePlace>("NonfinitePlace", "A value that is not finite.", [](Struct& t) {
    t.key<&NonfinitePlace::x>("x").unit("pixels");
    t.key<&NonfinitePlace::y>("y").unit("pixels");
    t.key<&NonfinitePlace::channel>("channel", "its name in the file");
    t.key<&NonfinitePlace::value>("value", R"("nan", "inf" or "-inf")").may_be_nonfinite();
    t.check<contradiction_of_place>();
  });
}

const Struct& NonfinitePlaces::type() {
  return define<NonfinitePlaces>(
      "NonfinitePlaces", "The first such value of each picture, in reading order.", [](Struct& t) {
        t.key<&NonfinitePlaces::a>("a");
        t.key<&NonfinitePlaces::b>("b");
      });
}

const Struct& Nonfinite::type() {
  return define<Nonfinite>(
      "Nonfinite",
      "Pixels with a NaN or an infinity. Any makes the verdict non-finite, and nothing is "
      "measured.",
      [](Struct& t) {
        t.key<&Nonfinite::a>("a").unit("pixels").at_least(0);
        t.key<&Nonfinite::b>("b").unit("pixels").at_least(0);
        t.key<&Nonfinite::first>("first");
        t.key<&Nonfinite::equal_allowed>(
             "equalAllowed",
             "where both had the same one and that was allowed: not counted in a and b")
            .unit("pixels")
            .at_least(0);
      });
}

const Struct& HdrExposures::type() {
  return define<HdrExposures>(
      "HdrExposures", "The exposures that HDR-FLIP looked at.", [](Struct& t) {
        t.key<&HdrExposures::start_stops>("startStops").unit("stops");
        t.key<&HdrExposures::stop_stops>("stopStops").unit("stops");
        t.key<&HdrExposures::count>("count").at_least(2);
        t.key<&HdrExposures::automatic>("automatic", "chosen from the reference");
        t.key<&HdrExposures::tone_curve>("toneCurve").one_of(kToneCurves);
      });
}

const Struct& Display::type() {
  return define<Display>(
      "Display", "What OpenColorIO showed the perceptual metrics.", [](Struct& t) {
        t.key<&Display::config>("config");
        t.key<&Display::config_id>("configId", "hash of the configuration");
        t.key<&Display::display>("display");
        t.key<&Display::view>("view");
        t.key<&Display::input_space>("inputSpace");
        t.key<&Display::decoded_by>(
             "decodedBy", "XYZ if the configuration says what light the display gives, else sRGB")
            .one_of(kDecoders);
      });
}

const Struct& Viewing::type() {
  return define<Viewing>("Viewing", "How the pictures are looked at.", [](Struct& t) {
    t.key<&Viewing::exposure_stops>("exposureStops").unit("stops");
    t.key<&Viewing::pixels_per_degree>("pixelsPerDegree").at_least(1e-300);
    t.key<&Viewing::hdr_exposures>("hdrExposures", "missing if HDR-FLIP was not measured");
    t.key<&Viewing::display>("display", "missing for a plain sRGB display");
  });
}

const Struct& Mask::type() {
  return define<Mask>("Mask", "The part in which metrics were measured again.", [](Struct& t) {
    t.key<&Mask::pixels>("pixels", "inside the mask").at_least(0);
  });
}

const Struct& NotMeasured::type() {
  return define<NotMeasured>(
      "NotMeasured", "A metric that could not be computed. A limit on it fails.", [](Struct& t) {
        t.key<&NotMeasured::metric>("metric");
        t.key<&NotMeasured::because>("because");
      });
}

const Struct& Limit::type() {
  return define<Limit>("Limit", "A limit, and what was measured.", [](Struct& t) {
    t.key<&Limit::metric>("metric");
    t.key<&Limit::limit>("limit", "the last value that passes; the metric says which way");
    t.key<&Limit::value>("value").may_be_nonfinite();
    t.key<&Limit::pass>("pass");
    t.key<&Limit::standing>("standing", "with noise: for the whole error bar, or up to it")
        .one_of(kStandings)
        .if_any();
    t.key<&Limit::more_samples>("moreSamples", "estimated factor of extra samples needed to decide")
        .at_least(0)
        .may_be_nonfinite();
  });
}

const Struct& PictureNoise::type() {
  return define<PictureNoise>("PictureNoise", "The known noise of a picture.", [](Struct& t) {
    t.key<&PictureNoise::freedom>("freedom", "degrees of freedom of each value's error")
        .at_least(1)
        .may_be_nonfinite();
    t.key<&PictureNoise::shared>("shared", "its pixels err together");
  });
}

const Struct& Uncertainty::type() {
  return define<Uncertainty>(
      "Uncertainty", "How the noise of the pictures was taken into account.", [](Struct& t) {
        t.key<&Uncertainty::a>("a");
        t.key<&Uncertainty::b>("b");
        t.key<&Uncertainty::significance>("significance").between(0, 1);
        t.key<&Uncertainty::tests>("tests", "values and regions that were tested").at_least(0);
        t.key<&Uncertainty::each>("each", "significance level of one test").between(0, 1);
        t.key<&Uncertainty::bootstraps>("bootstraps").at_least(4);
        t.key<&Uncertainty::seed>("seed");
      });
}

const Struct& ErrorBar::type() {
  return define<ErrorBar>(
      "ErrorBar", "How far noise alone moves a metric; docs/metrics.md defines the figures.",
      [](Struct& t) {
        t.key<&ErrorBar::standard_error>("standardError").at_least(0).may_be_nonfinite();
        t.key<&ErrorBar::noise_floor>("noiseFloor").may_be_nonfinite();
        t.key<&ErrorBar::noise_floor_most>("noiseFloorMost").may_be_nonfinite();
        t.key<&ErrorBar::low>("low").may_be_nonfinite();
        t.key<&ErrorBar::high>("high").may_be_nonfinite();
      });
}

const Struct& Tolerance::type() {
  return define<Tolerance>(
      "Tolerance", "How far each value may be from the reference.", [](Struct& t) {
        t.key<&Tolerance::relative>("relative", "share of the reference's value").at_least(0);
        t.key<&Tolerance::of_peak>("ofPeak", "share of the reference's brightest value")
            .at_least(0);
        t.key<&Tolerance::allowed_outliers>("allowedOutliers").unit("pixels").at_least(0);
        t.key<&Tolerance::on_edges_only>(
            "onEdgesOnly", "no outlier but on silhouettes, terminators and shadow edges");
      });
}

const Struct& ReferenceFloor::type() {
  return define<ReferenceFloor>(
      "ReferenceFloor", "How far a second reference is from b.", [](Struct& t) {
        t.key<&ReferenceFloor::c>("c", "file of the second reference");
        t.key<&ReferenceFloor::nonfinite>("nonfinite").unit("pixels").at_least(0);
        t.key<&ReferenceFloor::metrics>("metrics", "of c against b").may_be_nonfinite();
      });
}

const Struct& LayerComparison::type() {
  return define<LayerComparison>(
      "LayerComparison", "The comparison of another layer of both files.", [](Struct& t) {
        t.key<&LayerComparison::layer>("layer");
        t.key<&LayerComparison::verdict>("verdict").one_of(kVerdicts);
        t.key<&LayerComparison::overscan>(
            "overscan",
            "this is the comparison of all data on this window, seen from the display window's "
            "first pixel");
        t.key<&LayerComparison::identical>("identical",
                                           "every value is the same, and nothing was measured");
        t.key<&LayerComparison::problem>(
             "problem",
             "in place of what is measured: their sizes differ, or one alone has data outside of "
             "the display window")
            .not_empty()
            .if_any();
        t.key<&LayerComparison::nonfinite>("nonfinite");
        t.key<&LayerComparison::metrics>("metrics").may_be_nonfinite();
        t.key<&LayerComparison::limits>("limits");
        t.key<&LayerComparison::disagreement>("disagreement");
        t.key<&LayerComparison::not_measured>("notMeasured").if_any();
        t.key<&LayerComparison::pictures>("pictures");
        t.needs({{"nonfinite", "metrics", "limits"}, {"identical"}, {"problem"}});
      });
}

const Struct& NotCompared::type() {
  return define<NotCompared>("NotCompared", "What the verdict does not depend on.", [](Struct& t) {
    t.key<&NotCompared::layers>("layers", "names of layers of either file; the picture's is empty");
    t.key<&NotCompared::alpha>("alpha", "one of the pictures has an alpha that was not judged");
    t.key<&NotCompared::overscan_pixels>("overscanPixels", "outside of the display window")
        .at_least(0);
    t.key<&NotCompared::mip_levels>("mipLevels", "besides the first").at_least(0);
  });
}

const Struct& LayersInOne::type() {
  return define<LayersInOne>(
      "LayersInOne", "Layers that one file alone has. One that b alone has is a difference.",
      [](Struct& t) {
        t.key<&LayersInOne::a>("a");
        t.key<&LayersInOne::b>("b");
      });
}

const Struct& Comparison::type() {
  return define<Comparison>("Comparison", "A picture compared with a reference.", [](Struct& t) {
    t.kind("comparison");
    t.key<&Comparison::verdict>("verdict",
                                "the worst of the picture's and its layers'; the last three "
                                "where the noise of a picture is known")
        .one_of(kVerdicts);
    t.key<&Comparison::a>("a", "file of the picture that was judged");
    t.key<&Comparison::b>("b", "file of the reference");
    t.key<&Comparison::nonfinite>("nonfinite");
    t.key<&Comparison::viewing>("viewing");
    t.key<&Comparison::mask>("mask");
    t.key<&Comparison::metrics>("metrics", "docs/metrics.md says what each is and what it needs")
        .may_be_nonfinite();
    t.key<&Comparison::not_measured>("notMeasured").if_any();
    t.key<&Comparison::limits>("limits").items(1);
    t.key<&Comparison::warnings>("warnings", "limits that are no part of the verdict").if_any();
    t.key<&Comparison::disagreement>("disagreement",
                                     "sentences: which limits say opposite things by far");
    t.key<&Comparison::uncertainty>("uncertainty");
    t.key<&Comparison::error_bars>("errorBars", "by metric, where the noise is known");
    t.key<&Comparison::tolerance>("tolerance");
    t.key<&Comparison::reference_floor>("referenceFloor");
    t.key<&Comparison::pictures>("pictures");
    t.key<&Comparison::not_compared>("notCompared");
    t.key<&Comparison::layers>(
        "layers",
        "what was compared besides the display window of the picture: its alpha, overscan, "
        "and with --all-layers the other layers of both files");
    t.key<&Comparison::layers_in_one>("layersInOne", "with --all-layers");
  });
}

const Struct& SetSummary::type() {
  return define<SetSummary>("SetSummary", "How many pairs there are of each kind.", [](Struct& t) {
    t.key<&SetSummary::pairs>("pairs");
    t.key<&SetSummary::pass>("pass");
    t.key<&SetSummary::differs>("differs");
    t.key<&SetSummary::undecided>("undecided");
    t.key<&SetSummary::nonfinite>("nonFinite");
    t.key<&SetSummary::errors>("errors", "pairs that could not be compared");
    t.key<&SetSummary::missing>("missing", "only b has them");
    t.key<&SetSummary::extra>("extra", "only a has them");
    t.key<&SetSummary::passed_over>("passedOver",
                                    "files of both that are no pictures by their ending");
    t.key<&SetSummary::links_not_followed>("linksNotFollowed");
  });
}

const Struct& SetNotCompared::type() {
  return define<SetNotCompared>(
      "SetNotCompared",
      "What was not compared of all pairs: names once, pixels added up, levels at their most.",
      [](Struct& t) {
        t.key<&SetNotCompared::layers>("layers");
        t.key<&SetNotCompared::alpha>("alpha");
        t.key<&SetNotCompared::overscan_pixels>("overscanPixels").at_least(0);
        t.key<&SetNotCompared::mip_levels>("mipLevels").at_least(0);
        t.key<&SetNotCompared::pairs>("pairs", "that have something");
      });
}

const Struct& WorstOfSet::type() {
  return define<WorstOfSet>("WorstOfSet", "A metric over all pairs that have it.", [](Struct& t) {
    t.key<&WorstOfSet::value>("value", "furthest the wrong way").may_be_nonfinite();
    t.key<&WorstOfSet::pair>("pair", "the first pair that has it");
    t.key<&WorstOfSet::mean>("mean").may_be_nonfinite();
  });
}

const Struct& PairOfSet::type() {
  return define<PairOfSet>("PairOfSet", "A pair of files of one name.", [](Struct& t) {
    t.key<&PairOfSet::name>("name", "the path within both folders");
    t.key<&PairOfSet::comparison>("comparison");
    t.key<&PairOfSet::error>("error", "why there is no comparison").not_empty().if_any();
    t.needs({{"comparison"}, {"error"}});
    t.check<contradiction_of_pair>();
  });
}

const Struct& ComparisonSet::type() {
  return define<ComparisonSet>(
      "ComparisonSet", "All pictures of a folder compared with those of another one.",
      [](Struct& t) {
        t.kind("comparison-set");
        t.key<&ComparisonSet::a>("a", "the folder that was judged");
        t.key<&ComparisonSet::b>("b", "the folder of references");
        t.key<&ComparisonSet::c>("c", "the folder of second references").if_any();
        t.key<&ComparisonSet::summary>("summary");
        t.key<&ComparisonSet::not_compared>("notCompared");
        t.key<&ComparisonSet::worst>("worst", "by metric");
        t.key<&ComparisonSet::missing>("missing", "only b has them");
        t.key<&ComparisonSet::extra>("extra", "only a has them");
        t.key<&ComparisonSet::links_not_followed>(
            "linksNotFollowed",
            "links in a or b to a folder outside it, or to nothing; any makes the exit code 1");
        t.key<&ComparisonSet::pairs>("pairs");
      });
}

}  // namespace lobelia::records

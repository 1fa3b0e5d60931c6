#include "base/records/profile.hpp"

#include <algorithm>

namespace lobelia::records {
namespace {

constexpr std::string_view kAngles[] = {"reflection", "half_vector"};

std::string contradiction_of_curve(const ProfileCurve& curve) {
  const auto has_length = [&](const auto& values) {
    return values.size() == curve.angle_degrees.size();
  };
  return has_length(curve.pixels) &&
                 std::ranges::all_of(curve.radiance,
                                     [&](const auto& one) { return has_length(one.second); })
             ? ""
             : "its columns are not equally long";
}

}  // namespace

void define_profile_tables(Tables& tables) {
  tables.define<Point>("A place or a direction in the picture, y down.",
                       [](auto& t) { t.all().unit("pixels").may_be_nonfinite(); });
  tables.define<Peak>("The brightest place, to a fraction of a pixel.", [](auto& t) {
    t.keys({"x", "y"}).unit("pixels").may_be_nonfinite();
    t.key("radiance").may_be_nonfinite();
    t.key("found", "how").one_of(kPeakFound);
  });
  tables.define<HalfWidth>("Half of the width at half of the peak.", [](auto& t) {
    t.key("pixels").may_be_nonfinite();
    t.key("degrees", "angle of the lobe there, the mean of both sides").may_be_nonfinite();
  });
  tables.define<CosineLobe>("The power of a cosine that fits best.", [](auto& t) {
    t.key("exponent").within(0.001, 1e8);
    t.keys({"standardError", "rmsOfPeak"}).at_least(0);
    t.key("coefficient").between(0, kNoBound);
    t.key("pixels", "that were fitted");
    t.key("because", "why there are no figures").not_empty().if_any();
    t.needs({{"exponent", "standardError", "coefficient", "rmsOfPeak", "pixels"}, {"because"}});
  });
  tables.define<LobeExplanation>(
      "A family of lobes fitted to the highlight of a known camera and light.", [](auto& t) {
        t.key("family").one_of(kLobeFamilies);
        t.key("timesNDotL", "the cosine of the light belongs to it");
        t.key("exponent", "of Phong and Blinn-Phong").within(0.001, 1e8);
        t.key("alpha", "of GGX and Beckmann").within(1e-4, 4);
        t.key("roughness", "the root of alpha, as in Blender and in Disney's model").within(0, 2);
        t.key("standardError", "of the exponent or of alpha").at_least(0);
        t.key("coefficient").between(0, kNoBound);
        t.key("rmsOfPeak", "residual").at_least(0);
        t.key("rmsOfNoise", "residual over the standard error of the pixels")
            .at_least(0)
            .may_be_nonfinite();
        t.key("deviationsFromBest", "below 2, it cannot be told from the first")
            .at_least(0)
            .may_be_nonfinite();
        t.key("because", "why there are no figures").not_empty().if_any();
      });
  tables.define<HighlightErrors>("Standard errors of a highlight's figures.", [](auto& t) {
    t.key("source").one_of(kNoiseSources);
    t.keys({"peak", "energy", "halfWidthAlongPixels", "halfWidthAcrossPixels"}).may_be_nonfinite();
    t.key("place", "of the peak");
  });
  tables.define<ClippedPixels>("Pixels with the picture's largest value of a channel.",
                               [](auto& t) { t.key("channels", "R, G or B").not_empty(); });
  tables.define<Speck>(
      "A few pixels that stand alone: a fault, or a highlight smaller than a pixel.", [](auto& t) {
        t.key("radiance").may_be_nonfinite();
        t.key("pixels").within(1, 3);
      });
  tables.define<HighlightFigures>(
      "The highlight alone, without what lies beneath it; docs/profiles.md defines each figure.",
      [](auto& t) {
        t.key("halfWidthAlong", "the plane of incidence");
        t.key("halfWidthAcross", "the plane of incidence");
        t.key("energy").unit("W/m^2").may_be_nonfinite();
        t.key("because", "why something could not be told").if_any();
        t.key("explanations", "the best first").if_any();
        t.key(
             "pixelsShow",
             "the lobe at their centres, or its means with the film's filter; if unknown, the errors "
             "of the explanations hold for both")
            .one_of(kPixelsShow)
            .if_any();
        t.key("clipped", "then only the explanations and the cosine lobe leave these pixels out");
        t.key("specks", "left out, the brightest first").if_any();
      });
  tables.define<HighlightShape>("The curve of one picture, in figures.", [](auto& t) {
    t.key("peak", "largest radiance of a lit pixel").may_be_nonfinite();
    t.keys({"peakAngleDegrees", "halfWidthDegrees"}).unit("degrees").may_be_nonfinite();
    t.key("energy").unit("W/m^2").may_be_nonfinite();
  });
  tables.define<ZoneError>("How far two pictures are apart in a zone.", [](auto& t) {
    t.keys({"maxAbs", "rms"}).may_be_nonfinite();
    t.key("maxRelPeak", "of the peak").may_be_nonfinite();
  });
  tables.define<ZoneErrors>("How far two pictures are apart, by zone.");
  tables.define<ZoneRanges>("Where the zones begin and end: angles that the lobe sees.",
                            [](auto& t) { t.all().unit("degrees").within(0, 90); });
  tables.define<ProfileCurve>(
      "Mean radiance by the angle that the lobe sees. Bins without a pixel are left out.",
      [](auto& t) {
        t.key("angleDegrees").unit("degrees").may_be_nonfinite();
        t.key("pixels", "in each bin").at_least(1);
        t.rest("radiance", "of each picture, the mean of R, G and B").may_be_nonfinite();
        t.check(contradiction_of_curve);
      });
  tables.define<Subtracted>("What the curves do not contain, of the highlight's peak.",
                            [](auto& t) { t.all().may_be_nonfinite(); });
  tables.define<Profile>("The highlight of one light on one sphere, as curves.", [](auto& t) {
    t.kind("profile");
    t.key("light", "counted from 0").at_least(0);
    t.key("sphere", "counted from 0").at_least(0);
    t.key("angle", "what the lobe sees").one_of(kAngles);
    t.key("planeOfIncidence", "unit vector in the picture; missing if there is no such plane");
    t.key("images").items(1);
    t.key("differences", R"(by "A-B"; B is the reference)");
    t.key("lobe", "missing for a material without a highlight");
  });
  tables.define<Profiles>("All highlights of a scene.", [](auto& t) {
    t.kind("profiles");
    t.key("profiles").items(1);
  });
  tables.define<ZoneEnds>("Shares of the peak at which the zones end.",
                          [](auto& t) { t.all().within(0, 1); });
  tables.define<AxisPair>("A length along both axes of a blob.",
                          [](auto& t) { t.all().unit("pixels").may_be_nonfinite(); });
  tables.define<Estimate>("A figure with its standard error.",
                          [](auto& t) { t.all().may_be_nonfinite(); });
  tables.define<Falloff>("A family of curves fitted to a blob.", [](auto& t) {
    t.key("family").one_of(kFalloffs);
    t.key("peak", "over the background");
    t.keys({"halfWidthMajor", "halfWidthMinor"}).unit("pixels");
    t.key("rmsOfPeak", "residual").may_be_nonfinite();
    t.key("pixels", "that were fitted");
    t.key("because", "why there are no figures").not_empty().if_any();
  });
  tables.define<Clipping>("A blob with pixels at the picture's maximum.", [](auto& t) {
    t.key("channels", "R, G or B");
    t.key("peakAtLeast", "over the background").may_be_nonfinite();
    t.key("flank", "the curve through the pixels that are not clipped");
  });
  tables.define<BlobErrors>("Standard errors of a blob's figures.", [](auto& t) {
    t.keys({"background", "peak", "energy"}).may_be_nonfinite();
    t.key("place", "of the peak");
  });
  tables.define<Colour>("Over the background; the largest is 1.",
                        [](auto& t) { t.all().at_most(1).may_be_nonfinite(); });
  tables.define<BlobFigures>(
      "A blob of a picture; docs/profiles.md defines each figure.", [](auto& t) {
        t.key("peak", "over the background");
        t.key("background", "radiance beneath the peak").may_be_nonfinite();
        t.key("pixels", "connected, above half of the peak");
        t.key("majorAxis", "unit vector");
        t.key("gaussianSigmaPixels", "of the same half-width");
        t.key("energy", "radiance times pixels").may_be_nonfinite();
        t.key("nonfinite").unit("pixels");
        t.key("because", "why there is no blob").not_empty().if_any();
        t.key("remark", "what makes it doubtful").not_empty().if_any();
        t.key("noiseOfPeak", "standard error of a pixel over the peak").at_least(0);
        t.key("clipped", "then the half-widths are those of the flank");
        t.key("falloff", "the better family first").if_any();
      });
  tables.define<BlobCurve>("Radiance along an axis of the reference's blob, through its peak.",
                           [](auto& t) {
                             t.key("offsetPixels").unit("pixels");
                             t.rest("radiance", "of each picture").may_be_nonfinite();
                           });
  tables.define<Blob>("A highlight in pictures without a scene.", [](auto& t) {
    t.kind("blob");
    t.key("images").items(1, 2);
    t.key("curves", "by axis: major, minor");
    t.key("differences", R"(by "A-B"; empty of one picture alone)");
    t.key("id", "1 for the brightest").at_least(1);
  });
  tables.define<BlobPicture>("What a picture has besides its highlights.", [](auto& t) {
    t.key("standardErrorsFrom").one_of(kNoiseSources);
    t.key("moreSpecks", "that are not listed");
    t.key("moreHighlights", "that are not measured");
    t.key("mayHaveMore", "it has too many peaks to look at each");
  });
  tables.define<Blobs>("All highlights of pictures without a scene.", [](auto& t) {
    t.kind("blobs");
    t.key("leastShare", "of the highest one: lower highlights are left out").within(0, 1);
    t.key("pictures").items(1, 2);
    t.key("highlights", "the brightest of the first picture first").items(1);
  });
}

}  // namespace lobelia::records

#include "records/profile.hpp"

#include <algorithm>

namespace lobelia::records {
namespace {

constexpr std::string_view kAngles[] = {"reflection", "half_vector"};
constexpr std::string_view kFound[] = {"fitted", "pixel", "plateau", "edge", "none"};

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

const Struct& Point::type() {
  return define<Point>("Point", "A place or a direction in the picture, y down.", [](Struct& t) {
    t.key<&Point::x>("x").unit("pixels").may_be_nonfinite();
    t.key<&Point::y>("y").unit("pixels").may_be_nonfinite();
  });
}

const Struct& Peak::type() {
  return define<Peak>("Peak", "The brightest place, to a fraction of a pixel.", [](Struct& t) {
    t.key<&Peak::x>("x").unit("pixels").may_be_nonfinite();
    t.key<&Peak::y>("y").unit("pixels").may_be_nonfinite();
    t.key<&Peak::radiance>("radiance").may_be_nonfinite();
    t.key<&Peak::found>("found", "how").one_of(kFound);
  });
}

const Struct& HalfWidth::type() {
  return define<HalfWidth>("HalfWidth", "Half of the width at half of the peak.", [](Struct& t) {
    t.key<&HalfWidth::pixels>("pixels").may_be_nonfinite();
    t.key<&HalfWidth::degrees>("degrees", "angle of the lobe there, the mean of both sides")
        .may_be_nonfinite();
  });
}

const Struct& CosineLobe::type() {
  return define<CosineLobe>("CosineLobe", "The power of a cosine that fits best.", [](Struct& t) {
    t.key<&CosineLobe::exponent>("exponent").within(0.001, 1e8);
    t.key<&CosineLobe::standard_error>("standardError").at_least(0);
    t.key<&CosineLobe::coefficient>("coefficient").between(0, kNoBound);
    t.key<&CosineLobe::rms_of_peak>("rmsOfPeak").at_least(0);
    t.key<&CosineLobe::pixels>("pixels", "that were fitted");
    t.key<&CosineLobe::because>("because", "why there are no figures").not_empty().if_any();
    t.needs({{"exponent", "standardError", "coefficient", "rmsOfPeak", "pixels"}, {"because"}});
  });
}

const Struct& HighlightFigures::type() {
  return define<HighlightFigures>(
      "HighlightFigures",
      "The highlight alone, without what lies beneath it; docs/profiles.md defines each figure.",
      [](Struct& t) {
        t.key<&HighlightFigures::peak>("peak");
        t.key<&HighlightFigures::centroid>("centroid");
        t.key<&HighlightFigures::along>("halfWidthAlong", "the plane of incidence");
        t.key<&HighlightFigures::across>("halfWidthAcross", "the plane of incidence");
        t.key<&HighlightFigures::energy>("energy").unit("W/m^2").may_be_nonfinite();
        t.key<&HighlightFigures::cosine_lobe>("cosineLobe");
        t.key<&HighlightFigures::because>("because", "why something could not be told").if_any();
      });
}

const Struct& HighlightShape::type() {
  return define<HighlightShape>(
      "HighlightShape", "The curve of one picture, in figures.", [](Struct& t) {
        t.key<&HighlightShape::peak>("peak", "largest radiance of a lit pixel").may_be_nonfinite();
        t.key<&HighlightShape::peak_angle_degrees>("peakAngleDegrees")
            .unit("degrees")
            .may_be_nonfinite();
        t.key<&HighlightShape::half_width_degrees>("halfWidthDegrees")
            .unit("degrees")
            .may_be_nonfinite();
        t.key<&HighlightShape::energy>("energy").unit("W/m^2").may_be_nonfinite();
        t.key<&HighlightShape::highlight>("highlight");
      });
}

const Struct& ZoneError::type() {
  return define<ZoneError>("ZoneError", "How far two pictures are apart in a zone.", [](Struct& t) {
    t.key<&ZoneError::pixels>("pixels");
    t.key<&ZoneError::max_abs>("maxAbs").may_be_nonfinite();
    t.key<&ZoneError::rms>("rms").may_be_nonfinite();
    t.key<&ZoneError::max_rel_peak>("maxRelPeak", "of the peak").may_be_nonfinite();
  });
}

const Struct& ZoneErrors::type() {
  return define<ZoneErrors>("ZoneErrors", "How far two pictures are apart, by zone.",
                            [](Struct& t) {
                              t.key<&ZoneErrors::epicentre>("epicentre");
                              t.key<&ZoneErrors::flank>("flank");
                              t.key<&ZoneErrors::blooming>("blooming");
                            });
}

const Struct& ZoneRanges::type() {
  return define<ZoneRanges>(
      "ZoneRanges", "Where the zones begin and end: angles that the lobe sees.", [](Struct& t) {
        t.key<&ZoneRanges::epicentre>("epicentreDegrees").unit("degrees").within(0, 90);
        t.key<&ZoneRanges::flank>("flankDegrees").unit("degrees").within(0, 90);
        t.key<&ZoneRanges::blooming>("bloomingDegrees").unit("degrees").within(0, 90);
      });
}

const Struct& ProfileCurve::type() {
  return define<ProfileCurve>(
      "ProfileCurve",
      "Mean radiance by the angle that the lobe sees. Bins without a pixel are left out.",
      [](Struct& t) {
        t.key<&ProfileCurve::angle_degrees>("angleDegrees").unit("degrees").may_be_nonfinite();
        t.key<&ProfileCurve::pixels>("pixels", "in each bin").at_least(1);
        t.rest<&ProfileCurve::radiance>("of each picture, the mean of R, G and B")
            .may_be_nonfinite();
        t.check<contradiction_of_curve>();
      });
}

const Struct& Subtracted::type() {
  return define<Subtracted>(
      "Subtracted", "What the curves do not contain, of the highlight's peak.", [](Struct& t) {
        t.key<&Subtracted::diffuse_of_peak>("diffuseOfPeak").may_be_nonfinite();
        t.key<&Subtracted::other_lights_of_peak>("otherLightsOfPeak").may_be_nonfinite();
      });
}

const Struct& Profile::type() {
  return define<Profile>(
      "Profile", "The highlight of one light on one sphere, as curves.", [](Struct& t) {
        t.kind("profile");
        t.key<&Profile::light>("light", "counted from 0").at_least(0);
        t.key<&Profile::sphere>("sphere", "counted from 0").at_least(0);
        t.key<&Profile::angle>("angle", "what the lobe sees").one_of(kAngles);
        t.key<&Profile::zones>("zones");
        t.key<&Profile::plane_of_incidence>(
            "planeOfIncidence", "unit vector in the picture; missing if there is no such plane");
        t.key<&Profile::curve>("curve");
        t.key<&Profile::images>("images").items(1);
        t.key<&Profile::differences>("differences", R"(by "A-B"; B is the reference)");
        t.key<&Profile::lobe>("lobe", "missing for a material without a highlight");
        t.key<&Profile::subtracted>("subtracted");
      });
}

const Struct& Profiles::type() {
  return define<Profiles>("Profiles", "All highlights of a scene.", [](Struct& t) {
    t.kind("profiles");
    t.key<&Profiles::profiles>("profiles").items(1);
  });
}

const Struct& ZoneEnds::type() {
  return define<ZoneEnds>("ZoneEnds", "Shares of the peak at which the zones end.", [](Struct& t) {
    t.key<&ZoneEnds::epicentre>("epicentre").within(0, 1);
    t.key<&ZoneEnds::flank>("flank").within(0, 1);
    t.key<&ZoneEnds::blooming>("blooming").within(0, 1);
  });
}

const Struct& AxisPair::type() {
  return define<AxisPair>("AxisPair", "A length along both axes of a blob.", [](Struct& t) {
    t.key<&AxisPair::major>("major").unit("pixels").may_be_nonfinite();
    t.key<&AxisPair::minor>("minor").unit("pixels").may_be_nonfinite();
  });
}

const Struct& BlobFigures::type() {
  return define<BlobFigures>(
      "BlobFigures", "The brightest blob of a picture; docs/profiles.md defines each figure.",
      [](Struct& t) {
        t.key<&BlobFigures::peak>("peak", "over the background");
        t.key<&BlobFigures::background>("background", "radiance around the blob")
            .may_be_nonfinite();
        t.key<&BlobFigures::pixels>("pixels", "connected, above half of the peak");
        t.key<&BlobFigures::centroid>("centroid");
        t.key<&BlobFigures::major_axis>("majorAxis", "unit vector");
        t.key<&BlobFigures::half_width>("halfWidthPixels");
        t.key<&BlobFigures::gaussian_sigma>("gaussianSigmaPixels", "of the same half-width");
        t.key<&BlobFigures::energy>("energy", "radiance times pixels").may_be_nonfinite();
        t.key<&BlobFigures::nonfinite>("nonfinite").unit("pixels");
        t.key<&BlobFigures::because>("because", "why there is no blob").not_empty().if_any();
        t.key<&BlobFigures::remark>("remark", "what makes it doubtful").not_empty().if_any();
      });
}

const Struct& BlobCurve::type() {
  return define<BlobCurve>("BlobCurve",
                           "Radiance along an axis of the reference's blob, through its peak.",
                           [](Struct& t) {
                             t.key<&BlobCurve::offset>("offsetPixels").unit("pixels");
                             t.rest<&BlobCurve::radiance>("of each picture").may_be_nonfinite();
                           });
}

const Struct& Blob::type() {
  return define<Blob>("Blob", "A highlight in pictures without a scene.", [](Struct& t) {
    t.kind("blob");
    t.key<&Blob::reference>("reference");
    t.key<&Blob::zones>("zones");
    t.key<&Blob::images>("images").items(1, 2);
    t.key<&Blob::curves>("curves", "by axis: major, minor");
    t.key<&Blob::differences>("differences", R"(by "A-B"; empty of one picture alone)");
  });
}

}  // namespace lobelia::records

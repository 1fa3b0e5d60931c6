#include "base/records/scene.hpp"

namespace lobelia::records {
namespace {

constexpr std::string_view kLightKinds[] = {"delta", "area", "environment"};
constexpr std::string_view kLightUnits[] = {"W/m^2", "W/sr", "W/(m^2 sr)"};
constexpr std::string_view kLobeAngles[] = {"reflection", "halfVector"};

}  // namespace

void define_scene_tables(Tables& tables) {
  tables.define<SceneCamera>(
      "The ray through (x, y) of the film, in pixels from its upper left corner, runs from origin along forward + "
      "((2 x / width - 1) halfWidth + shiftU) right + ((1 - 2 y / height) halfHeight + shiftV) up.",
      [](auto& t) {
        t.keys({"right", "up", "forward"})
            .meaning("unit vectors, right-handed: right = forward x up");
        t.keys({"halfWidth", "halfHeight"}).meaning("of the picture at distance 1").at_least(0);
        t.keys({"shiftU", "shiftV"}).meaning("of the film's centre at distance 1");
        t.key("apertureRadius", "of a thin lens across the view; 0 is a pinhole").at_least(0);
        t.key("focusDistance", "along forward, of the plane that is sharp").at_least(0);
      });
  tables.define<SceneFilm>("The picture and its samples.", [](auto& t) {
    t.keys({"width", "height"}).unit("pixels").at_least(1);
    t.key("samples", "rays per pixel; 1 is the pixel's centre").at_least(1);
    t.key("filter", "used only where samples is over 1");
    t.key("filterRadius").unit("pixels");
  });
  tables.define<SceneLight>("A light. It has the places and directions of its type.", [](auto& t) {
    t.key("type",
          "as in a scene file: point, spot, directional, sphere, rectangle, constant, envmap");
    t.key("kind").one_of(kLightKinds);
    t.key("direction", "where the light travels; unit vector");
    t.key("normal", "of a point of a surface: the intensity falls with the cosine to it");
    t.key("cutoffDegrees", "from direction to where a spot ends");
    t.key("beamDegrees",
          "to where it begins to fall: by t^2 (3 - 2 t), t from 0 to 1 by the cosine in between");
    t.key("halfU", "from the centre to a side");
    t.key("halfV", "to the next side; it shines to the side of halfU x halfV");
    t.key("filename", "a picture by latitude and longitude, which strength scales").if_any();
    t.key("strength", "irradiance normal to the beam, intensity or radiance, by unit").at_least(0);
    t.key("unit", "of strength").one_of(kLightUnits);
  });
  tables.define<SceneMaterial>(
      "Radiance per irradiance normal to the beam is F coefficient lobe(s, exponent), times N.L if "
      "appliesCosine and G / ((N.L) (N.V)) if hasShadowing, plus diffuse N.L / pi. It is 0 where N.L <= 0.",
      [](auto& t) {
        t.key("id", "from the scene file; for people").if_any();
        t.key("lobeFormula", "of s = 1 - cos(angle) and the exponent n; 0 where s >= 1");
        t.key("angle", "between L and the mirror direction of V, or between N and the half vector")
            .one_of(kLobeAngles);
        t.key("exponent").at_least(0);
        t.key(
            "hasShadowing",
            "G = 1 / (1 + Lambda(N.L) + Lambda(N.V)) is Smith's for GGX: 2 Lambda(c) = sqrt(1 + alpha^2 (1 / c^2 - 1)) - 1, "
            "alpha^2 = 2 / (exponent + 2)");
        t.key("coefficient", "the whole factor of the lobe").at_least(0);
        t.key("specular", "F, or the F0 of F = F0 + (1 - F0) (1 - V.H)^5 with the fresnel schlick");
        t.key("diffuse", "Lambertian albedo");
        t.key("mirror", "of a perfect mirror on top; the F0 of its Fresnel factor");
        t.key("mirrorAtGrazing", "F90 of the mirror's Fresnel factor; used only with schlick");
        t.keys({"specular", "diffuse", "mirror"}).within(0, 1);
      });
  tables.define<SceneSphere>("A sphere.", [](auto& t) {
    t.key("radius").at_least(0);
    t.key("material", "its place in materials, from 0").at_least(0);
  });
  tables.define<ScenePlane>("An infinite plane, seen and lit from both sides.", [](auto& t) {
    t.key("normal", "unit vector");
    t.key("material", "its place in materials, from 0").at_least(0);
    t.key("checkerMaterial", "of every other square").at_least(0);
    t.key("checkerSize", "side of a square").at_least(0);
  });
  tables.define<SceneDepth>("How often light may go on from surface to surface.", [](auto& t) {
    t.key("mirror", "by mirrors").at_least(0);
    t.key("glossy", "by highlights and diffuse bases").at_least(0);
  });
  tables.define<Scene>(
      "A scene with everything resolved to numbers: 'lobelia scene SCENE --to json'. Lengths are in the scene's "
      "unit; colours are linear with Rec. 709 primaries; docs/conventions.md has the directions and units.",
      [](auto& t) { t.kind("scene"); });
}

}  // namespace lobelia::records

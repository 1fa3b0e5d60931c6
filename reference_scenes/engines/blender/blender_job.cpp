#include "reference_scenes/engines/blender/blender_job.hpp"

namespace lobelia {

const records::Struct& BlenderCamera::type() {
  return records::define<BlenderCamera>("BlenderCamera", "The camera.", [](records::Struct& t) {
    t.key<&BlenderCamera::origin>("origin");
    t.key<&BlenderCamera::target>("target");
    t.key<&BlenderCamera::up>("up");
    t.key<&BlenderCamera::fov_degrees>("fovDegrees").unit("degrees");
    t.key<&BlenderCamera::offset>("offset", "of the principal point");
  });
}

const records::Struct& BlenderLight::type() {
  return records::define<BlenderLight>(
      "BlenderLight", "A lamp without a size; for Cycles' own transport, a rectangle or the sky.",
      [](records::Struct& t) {
        t.key<&BlenderLight::kind>("kind");
        t.key<&BlenderLight::position>("position");
        t.key<&BlenderLight::intensity>("intensity");
        t.key<&BlenderLight::normal>("normal");
        t.key<&BlenderLight::direction>("direction");
        t.key<&BlenderLight::irradiance>("irradiance");
        t.key<&BlenderLight::center>("center");
        t.key<&BlenderLight::half_u>("halfU");
        t.key<&BlenderLight::half_v>("halfV");
        t.key<&BlenderLight::radiance>("radiance");
        t.key<&BlenderLight::file>("file", "the sky's picture, beside the job").if_any();
        t.key<&BlenderLight::lies_on>("liesOn", "surfaces").if_any();
      });
}

const records::Struct& BlenderMaterial::type() {
  return records::define<BlenderMaterial>("BlenderMaterial", "A material.", [](records::Struct& t) {
    t.key<&BlenderMaterial::model>("model");
    t.key<&BlenderMaterial::lobe>("lobe");
    t.key<&BlenderMaterial::normalisation>("normalisation");
    t.key<&BlenderMaterial::exponent>("exponent");
    t.key<&BlenderMaterial::fresnel>("fresnel");
    t.key<&BlenderMaterial::specular>("specular");
    t.key<&BlenderMaterial::diffuse>("diffuse");
    t.key<&BlenderMaterial::mirror>("mirror");
  });
}

const records::Struct& BlenderSphere::type() {
  return records::define<BlenderSphere>("BlenderSphere", "A sphere.", [](records::Struct& t) {
    t.key<&BlenderSphere::center>("center");
    t.key<&BlenderSphere::radius>("radius");
    t.key<&BlenderSphere::material>("material");
  });
}

const records::Struct& BlenderPlane::type() {
  return records::define<BlenderPlane>("BlenderPlane", "A plane.", [](records::Struct& t) {
    t.key<&BlenderPlane::point>("point");
    t.key<&BlenderPlane::u>("u");
    t.key<&BlenderPlane::v>("v");
    t.key<&BlenderPlane::material>("material");
    t.key<&BlenderPlane::checker_material>("checkerMaterial");
    t.key<&BlenderPlane::checker_size>("checkerSize");
  });
}

const records::Struct& BlenderPass::type() {
  return records::define<BlenderPass>("BlenderPass", "A picture of one light, by so many mirrors.",
                                      [](records::Struct& t) {
                                        t.key<&BlenderPass::light>("light");
                                        t.key<&BlenderPass::mirrors>("mirrors");
                                      });
}

const records::Struct& BlenderTransport::type() {
  return records::define<BlenderTransport>(
      "BlenderTransport", "How Cycles traces light by itself.", [](records::Struct& t) {
        t.key<&BlenderTransport::samples>("samples", "per pixel");
        t.key<&BlenderTransport::seed>("seed");
        t.key<&BlenderTransport::bounces>("bounces");
      });
}

const records::Struct& BlenderScene::type() {
  return records::define<BlenderScene>(
      "BlenderScene", "A scene, and the pictures of it that add up.", [](records::Struct& t) {
        t.key<&BlenderScene::name>("name");
        t.key<&BlenderScene::width>("width").unit("pixels");
        t.key<&BlenderScene::height>("height").unit("pixels");
        t.key<&BlenderScene::camera>("camera");
        t.key<&BlenderScene::lights>("lights");
        t.key<&BlenderScene::materials>("materials");
        t.key<&BlenderScene::spheres>("spheres");
        t.key<&BlenderScene::planes>("planes");
        t.key<&BlenderScene::native>("native");
        t.key<&BlenderScene::passes>("passes");
        t.key<&BlenderScene::transport>("transport");
      });
}

const records::Struct& BlenderJob::type() {
  return records::define<BlenderJob>(
      "BlenderJob", "What a process begins with.", [](records::Struct& t) {
        t.key<&BlenderJob::threads>("threads");
        t.key<&BlenderJob::seconds_per_scene>("secondsPerScene").unit("seconds");
        t.key<&BlenderJob::scenes>("scenes");
        t.key<&BlenderJob::go_on>("goOn", "it is told of further scenes");
      });
}

}  // namespace lobelia

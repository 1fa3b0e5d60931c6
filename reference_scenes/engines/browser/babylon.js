// Babylon.js' StandardMaterial, one point of the sphere for each pixel.
import { Engine } from '@babylonjs/core/Engines/engine.js';
import { Scene } from '@babylonjs/core/scene.js';
import { Camera } from '@babylonjs/core/Cameras/camera.js';
import { TargetCamera } from '@babylonjs/core/Cameras/targetCamera.js';
import { DirectionalLight } from '@babylonjs/core/Lights/directionalLight.js';
import { PointLight } from '@babylonjs/core/Lights/pointLight.js';
import { Light } from '@babylonjs/core/Lights/light.js';
import { StandardMaterial } from '@babylonjs/core/Materials/standardMaterial.js';
import { RenderTargetTexture } from '@babylonjs/core/Materials/Textures/renderTargetTexture.js';
import { Mesh } from '@babylonjs/core/Meshes/mesh.js';
import { VertexData } from '@babylonjs/core/Meshes/mesh.vertexData.js';
import { Matrix, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Color3, Color4 } from '@babylonjs/core/Maths/math.color.js';
import { keepPicture, spherePoints } from './points.js';

const engine = new Engine(document.createElement('canvas'), false, { antialias: false }, false);

globalThis.renderScene = async job => {
  const { width, height, window: [left, right, bottom, top] } = job;
  const scene = new Scene(engine);
  scene.clearColor = new Color4(0, 0, 0, 0);
  scene.ambientColor = new Color3(0, 0, 0);
  scene.imageProcessingConfiguration.isEnabled = false;
  const camera = new TargetCamera('camera', Vector3.Zero(), scene);  // it looks along +z, as the scene does
  const { points, normals, near, far } = spherePoints(job);
  camera.freezeProjectionMatrix(Matrix.FromValues(
    2 / (right - left), 0, 0, 0,
    0, 2 / (top - bottom), 0, 0,
    -(right + left) / (right - left), -(top + bottom) / (top - bottom), (far + near) / (far - near), 1,
    0, 0, -2 * far * near / (far - near), 0));
  const data = new VertexData();
  data.positions = points;
  data.normals = normals;
  data.indices = Array.from({ length: points.length / 3 }, (_, i) => i);
  const sphere = new Mesh('sphere', scene);
  data.applyToMesh(sphere);
  sphere.alwaysSelectAsActiveMesh = true;
  const material = new StandardMaterial('material', scene);
  material.pointsCloud = true;
  material.pointSize = 1;
  material.backFaceCulling = false;
  material.maxSimultaneousLights = Math.max(1, job.lights.length);
  material.diffuseColor = new Color3(...job.diffuse);
  const specular = job.hasHighlight ? job.strength : 0;
  material.specularColor = new Color3(specular, specular, specular);
  material.specularPower = job.exponent;
  sphere.material = material;
  job.lights.forEach(({ isDistant, place, strength }, i) => {
    const light = isDistant ? new DirectionalLight(`light${i}`, new Vector3(...place).scale(-1), scene)
      : new PointLight(`light${i}`, new Vector3(...place), scene);
    if (!isDistant) light.falloffType = Light.FALLOFF_PHYSICAL;
    light.diffuse = light.specular = new Color3(...strength);
  });
  const target = new RenderTargetTexture('target', { width, height }, scene,
    { type: Engine.TEXTURETYPE_FLOAT, generateMipMaps: false });
  target.renderList = [sphere];
  target.clearColor = new Color4(0, 0, 0, 0);
  scene.customRenderTargets.push(target);
  await scene.whenReadyAsync();
  scene.render();
  keepPicture(new Float32Array((await target.readPixels()).buffer.slice(0)), width);
  scene.dispose();
};

// three.js' MeshPhongMaterial, one point of the sphere for each pixel.
import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, FloatType, LinearSRGBColorSpace, Matrix4, MeshPhongMaterial,
  NoToneMapping, PerspectiveCamera, PointLight, Points, RGBAFormat, Scene, WebGLRenderer, WebGLRenderTarget,
} from 'three';
import { keepPicture, spherePoints } from './points.js';

const renderer = new WebGLRenderer({ antialias: false, precision: 'highp' });
renderer.outputColorSpace = LinearSRGBColorSpace;
renderer.toneMapping = NoToneMapping;

const linear = (r, g, b) => new Color().setRGB(r, g, b, LinearSRGBColorSpace);

globalThis.renderScene = job => {
  const { width, height, window: [left, right, bottom, top], strength } = job;
  const scene = new Scene();
  const { points, normals, near, far } = spherePoints(job);
  const towardsUs = values => Float32Array.from(values, (value, i) => i % 3 === 2 ? -value : value);  // it looks along -z
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(towardsUs(points), 3));
  geometry.setAttribute('normal', new BufferAttribute(towardsUs(normals), 3));
  // A white highlight, so that its Fresnel factor is 1; what three.js has no factor for is in the light.
  const lit = job.hasHighlight ? strength : 1;
  const material = new MeshPhongMaterial({ shininess: job.exponent });
  material.specular = job.hasHighlight ? linear(1, 1, 1) : linear(0, 0, 0);
  material.color = linear(...job.diffuse.map(value => Math.PI * value / lit));
  const sphere = new Points(geometry, material);
  sphere.frustumCulled = false;
  scene.add(sphere);
  for (const { isDistant, place, strength } of job.lights) {
    const light = isDistant ? new DirectionalLight() : new PointLight(0, 1, 0, 2);
    light.color = linear(...strength.map(value => value * lit));
    light.position.set(place[0], place[1], -place[2]);
    scene.add(light);
  }
  const camera = new PerspectiveCamera();
  camera.projectionMatrix = new Matrix4().makePerspective(...[left, right, top, bottom].map(edge => edge * near), near, far);
  camera.projectionMatrixInverse = camera.projectionMatrix.clone().invert();
  const target = new WebGLRenderTarget(width, height, { type: FloatType, format: RGBAFormat, colorSpace: LinearSRGBColorSpace });
  renderer.setRenderTarget(target);
  renderer.setClearColor(0, 0);
  renderer.clear();
  renderer.render(scene, camera);
  const rgba = new Float32Array(4 * width * height);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, rgba);
  keepPicture(rgba, width);
  target.dispose();
  geometry.dispose();
  material.dispose();
};

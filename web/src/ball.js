// The ball is one sphere. The left of the wipe shows the material before the conversion, the right the material after it.
import {
  DataTexture, DirectionalLight, LinearFilter, LinearMipmapLinearFilter, Mesh, MeshPhysicalMaterial, MeshStandardMaterial,
  NeutralToneMapping, NoColorSpace, PMREMGenerator, PerspectiveCamera, RepeatWrapping, SRGBColorSpace, Scene, SphereGeometry,
  WebGLRenderer,
} from 'three';
import { RoomEnvironment } from 'three/examples/jsm/environments/RoomEnvironment.js';

const DISTANCE = 4.7;  // of the camera, if the view is wider than high
const COLORS = new Set(['base color', 'diffuse', 'specular']);

function textureOf({ role, width, height, rgba }) {
  const texture = new DataTexture(rgba, width, height);
  texture.colorSpace = COLORS.has(role) ? SRGBColorSpace : NoColorSpace;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.repeat.set(2, 1);
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.anisotropy = 4;
  texture.flipY = true;
  texture.needsUpdate = true;
  return texture;
}

const toLinear = (byte) => (byte / 255 <= 0.04045 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
const toByte = (value) => 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);

// Converts scaled diffuse to plain: times 1 - max(specular).
function scaledDiffuse(diffuse, specular) {
  const width = Math.max(diffuse.width, specular.width);
  const height = Math.max(diffuse.height, specular.height);
  const texelOf = (map, x, y) => 4 * (Math.floor((y * map.height) / height) * map.width + Math.floor((x * map.width) / width));
  const rgba = new Uint8ClampedArray(4 * width * height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const s = texelOf(specular, x, y);
      const d = texelOf(diffuse, x, y);
      const rest = 1 - toLinear(Math.max(specular.rgba[s], specular.rgba[s + 1], specular.rgba[s + 2]));
      const to = 4 * (y * width + x);
      for (let c = 0; c < 3; ++c) rgba[to + c] = toByte(toLinear(diffuse.rgba[d + c]) * rest);
      rgba[to + 3] = 255;
    }
  return { role: 'diffuse', width, height, rgba };
}

function threeMaterial({ workflow, maps }, isScaled) {
  const mapOf = (role) => maps.find((map) => map.role === role);
  const roughness = mapOf('roughness');
  const common = { roughness: roughness ? 1 : 0.5, roughnessMap: roughness ? textureOf(roughness) : null };
  const specular = mapOf('specular');
  if (workflow === 'specular' && specular) {
    const diffuse = mapOf('diffuse');
    return new MeshPhysicalMaterial({
      ...common,
      metalness: 0,
      ior: 0,  // F0 is the specular color
      specularColorMap: textureOf(specular),
      map: diffuse ? textureOf(isScaled ? scaledDiffuse(diffuse, specular) : diffuse) : null,
      color: diffuse ? 0xffffff : 0x000000,
    });
  }
  // A model without a workflow is all specular, like a metal.
  const color = workflow === 'brdf' ? { ...specular, role: 'specular' } : mapOf('base color');
  const metallic = mapOf('metallic');
  return new MeshStandardMaterial({
    ...common,
    metalness: workflow === 'brdf' || metallic ? 1 : 0,
    metalnessMap: metallic ? textureOf(metallic) : null,
    map: color?.rgba ? textureOf(color) : null,
  });
}

function dispose(material) {
  for (const value of Object.values(material)) if (value?.isTexture) value.dispose();
  material.dispose();
}

export class Ball {
  #canvas;
  #renderer;
  #scene = new Scene();
  #camera = new PerspectiveCamera(28, 1, 0.1, 20);
  #light = new DirectionalLight(0xffffff, 1.5);
  #ball = new Mesh(new SphereGeometry(1, 128, 64));
  #materials = null;

  constructor(canvas) {
    this.#canvas = canvas;
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.#renderer.toneMapping = NeutralToneMapping;
    const generator = new PMREMGenerator(this.#renderer);
    this.#scene.environment = generator.fromScene(new RoomEnvironment(), 0.04).texture;
    generator.dispose();
    this.#scene.environmentIntensity = 0.6;
    this.#scene.add(this.#ball, this.#light);
  }

  /** Two materials of preview.js; `isScaled` says of each whether its diffuse counts what specular leaves. */
  show(before, after, isScaled) {
    this.#materials?.forEach(dispose);
    this.#materials = [threeMaterial(before, isScaled.before), threeMaterial(after, isScaled.after)];
  }

  /** `wipe` from 0 to 1, `light` in degrees. */
  draw({ wipe, light }) {
    if (!this.#materials) return;
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    const angle = (light * Math.PI) / 180;
    this.#light.position.set(3 * Math.sin(angle), 1.5, 3 * Math.cos(angle));
    this.#scene.environmentRotation.y = angle;
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.setSize(width, height, false);
    this.#camera.aspect = width / height;
    this.#camera.position.z = DISTANCE / Math.min(1, this.#camera.aspect);
    this.#camera.updateProjectionMatrix();
    const border = Math.round(width * wipe);
    this.#renderer.setScissorTest(true);
    [[0, border], [border, width - border]].forEach(([left, part], i) => {
      if (part <= 0) return;
      this.#ball.material = this.#materials[i];
      this.#renderer.setScissor(left, 0, part, height);
      this.#renderer.render(this.#scene, this.#camera);
    });
  }
}

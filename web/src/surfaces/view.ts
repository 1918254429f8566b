/** Surfaces in space. This module brings three.js and is loaded when the first surface is shown. */
import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Line, LineBasicMaterial, type Material, Mesh, PerspectiveCamera, Points,
  PointsMaterial, Scene, ShaderMaterial, Sphere, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Palette } from "../canvas/palette.ts";
import { colorAt, type Sampled, type SurfaceLook } from "./mesh.ts";
import { fragmentShader, vertexShader } from "./shader.ts";

export interface NetworkLine {
  name: string;
  points: readonly (readonly number[])[];
  color: string;
  chosen: boolean;
}

/** What stands in space on one side of the wipe. */
export interface SurfaceContent {
  surfaces: readonly Sampled[];
  network: readonly NetworkLine[];
  joints: readonly { points: readonly (readonly number[])[]; color: string }[];
}

export interface SurfaceScene extends SurfaceContent {
  /** left of the wipe, in the same light and colours */
  before: SurfaceContent | null;
  /** of the values' colours */
  range: readonly [number, number];
  look: SurfaceLook;
  stripes: number;
  colors: Palette;
}

const kLooks: readonly SurfaceLook[] = ["zebra", "isophotes", "reflection", "mean", "shaded"];
const lookNumber = (look: SurfaceLook): number => (look === "gaussian" ? 3 : kLooks.indexOf(look));

function meshOf(sampled: Sampled, range: readonly [number, number], material: ShaderMaterial): Mesh {
  const { rows, columns } = sampled;
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(sampled.points, 3));
  geometry.setAttribute("normal", new BufferAttribute(sampled.normals, 3));
  const shade = new Float32Array(3 * sampled.values.length);
  sampled.values.forEach((v, i) => {
    shade.set(Number.isFinite(v) ? colorAt((v - range[0]) / (range[1] - range[0])) : [0.3, 0.3, 0.3], 3 * i);
  });
  geometry.setAttribute("shade", new BufferAttribute(shade, 3));
  const index: number[] = [];
  for (let i = 0; i + 1 < rows; ++i)
    for (let j = 0; j + 1 < columns; ++j) {
      const at = i * columns + j;
      index.push(at, at + columns, at + 1, at + 1, at + columns, at + columns + 1);
    }
  geometry.setIndex(index);
  return new Mesh(geometry, material);
}

function lineOf(points: readonly (readonly number[])[], color: string): Line {
  const geometry = new BufferGeometry().setFromPoints(points.map(([x, y, z]) => new Vector3(x, y, z ?? 0)));
  return new Line(geometry, new LineBasicMaterial({ color: new Color(color) }));
}

/** Where the surface ends, or joins another. */
function borderOf({ rows, columns, points }: Sampled): number[][] {
  const at = (i: number, j: number) => [...points.slice(3 * (i * columns + j), 3 * (i * columns + j) + 3)];
  const line: number[][] = [];
  for (let j = 0; j < columns; ++j) line.push(at(0, j));
  for (let i = 1; i < rows; ++i) line.push(at(i, columns - 1));
  for (let j = columns - 2; j >= 0; --j) line.push(at(rows - 1, j));
  for (let i = rows - 2; i >= 0; --i) line.push(at(i, 0));
  return line;
}

export class SurfaceView {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(28, 1, 0.01, 1e5);
  private readonly controls: OrbitControls;
  private content = new Group();
  private past: Group | null = null;
  /** where the line between before and after stands, as a share of the width */
  private wipe = 0.5;
  private framed = "";
  /** what was brought in sight and not been turned or moved since */
  private inSight: readonly Sampled[] | null = null;
  private scheduled = false;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.schedule());
    this.controls.addEventListener("start", () => { this.inSight = null; });
    this.camera.up.set(0, 0, 1);
    canvas.addEventListener("keydown", (e) => this.key(e));
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(devicePixelRatio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    if (this.inSight) this.frame(this.inSight);
    this.schedule();
  }

  schedule(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.render();
      this.canvas.dataset.painted = String(Number(this.canvas.dataset.painted ?? 0) + 1);
    });
  }

  show(shown: SurfaceScene): void {
    this.dispose();
    const material = new ShaderMaterial({
      vertexShader, fragmentShader, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, // lines lie on it
      uniforms: { look: { value: lookNumber(shown.look) }, count: { value: shown.stripes } },
    });
    this.content = this.groupOf(shown, shown, material);
    this.past = shown.before && this.groupOf(shown.before, shown, material);
    this.scene.add(this.content);
    if (this.past) this.scene.add(this.past);
    this.scene.background = new Color(shown.colors.ground);
    this.frameOnce(shown.surfaces);
    this.schedule();
  }

  wipeAt(share: number): void {
    this.wipe = share;
    this.schedule();
  }

  /** Both sides of the wipe from the same eye, each within its part of the canvas. */
  private render(): void {
    const { renderer, past, content } = this;
    if (!past) return renderer.render(this.scene, this.camera);
    const { clientWidth, clientHeight } = this.canvas;
    const at = Math.round(this.wipe * clientWidth);
    renderer.setScissorTest(true);
    for (const [group, left, right] of [[past, 0, at], [content, at, clientWidth]] as const) {
      past.visible = group === past;
      content.visible = group === content;
      renderer.setScissor(left, 0, right - left, clientHeight);
      if (right > left) renderer.render(this.scene, this.camera);
    }
    content.visible = true;
    renderer.setScissorTest(false);
  }

  private groupOf({ surfaces, network, joints }: SurfaceContent, { range, colors }: SurfaceScene, material: ShaderMaterial): Group {
    const group = new Group();
    for (const sampled of surfaces) group.add(meshOf(sampled, range, material), lineOf(borderOf(sampled), colors.curve));
    for (const line of network) group.add(...this.networkLine(line, colors));
    for (const joint of joints) group.add(this.jointLine(joint.points, joint.color));
    return group;
  }

  /** Thick: what one looks for among the borders. */
  private jointLine(points: readonly (readonly number[])[], color: string): Points {
    const drawn = lineOf(points, color);
    const dots = new Points(drawn.geometry, new PointsMaterial({ color: new Color(color), size: 5, sizeAttenuation: false }));
    dots.renderOrder = 1;
    return dots;
  }

  private networkLine(line: NetworkLine, colors: Palette): (Line | Points)[] {
    const color = line.chosen ? colors.handle : line.color;
    const drawn = lineOf(line.points, color);
    (drawn.material as LineBasicMaterial).depthTest = !line.chosen;
    const dots = new Points(drawn.geometry, new PointsMaterial({
      color: new Color(color), size: line.chosen ? 9 : 5, sizeAttenuation: false, depthTest: !line.chosen,
    }));
    if (line.chosen) drawn.renderOrder = dots.renderOrder = 1;
    return [drawn, dots];
  }

  /** From above at a slant, all of it in sight; once for every set of surfaces. */
  private frameOnce(surfaces: readonly Sampled[]): void {
    const key = surfaces.map((s) => `${s.points[0]},${s.points.at(-1)}`).join(";");
    if (key === this.framed || surfaces.length === 0) return;
    if (this.framed === "") this.frame(surfaces);
    this.framed = key;
  }

  frame(surfaces: readonly Sampled[]): void {
    const points = surfaces.flatMap((s) => Array.from({ length: s.points.length / 3 }, (_, i) =>
      new Vector3(s.points[3 * i], s.points[3 * i + 1], s.points[3 * i + 2])));
    const sphere = new Sphere().setFromPoints(points);
    // as far as the narrower side of the view needs
    const half = Math.atan(Math.tan((this.camera.fov * Math.PI) / 360) * Math.min(1, this.camera.aspect));
    const away = sphere.radius / Math.sin(half);
    this.camera.near = away / 100;
    this.camera.far = away * 10;
    this.camera.position.copy(sphere.center).add(new Vector3(-0.55, -0.75, 0.75).normalize().multiplyScalar(0.95 * away));
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(sphere.center);
    this.controls.update();
    this.inSight = surfaces;
    this.schedule();
  }

  /** Arrows turn, plus and minus come nearer and go away. */
  private key(e: KeyboardEvent): void {
    const turn = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
    const zoom = { "+": 0.9, "=": 0.9, "-": 1.1 }[e.key];
    if (!turn && !zoom) return;
    this.inSight = null;
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (zoom) offset.multiplyScalar(zoom);
    if (turn) {
      offset.applyAxisAngle(this.camera.up, 0.08 * (turn[0] as number));
      const aside = new Vector3().crossVectors(this.camera.up, offset).normalize();
      offset.applyAxisAngle(aside, 0.08 * (turn[1] as number));
    }
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.schedule();
    e.preventDefault();
    e.stopPropagation();
  }

  private dispose(): void {
    for (const group of [this.content, this.past]) {
      if (!group) continue;
      this.scene.remove(group);
      group.traverse((thing) => {
        if (thing instanceof Mesh || thing instanceof Line || thing instanceof Points) {
          thing.geometry.dispose();
          (thing.material as Material).dispose();
        }
      });
    }
  }
}

/** The alpha-s plane of one network curve of a patch: its place is a point one drags. */
import type { Curve, CurvePlaneResult, NetworkCurveShown, Surface } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import type { Palette } from "../canvas/palette.ts";
import { PlanePlot } from "../graphs/plane.ts";
import type { Point } from "../model/document.ts";
import { h } from "../ui/dom.ts";

const kNudge = 0.01; // of the plane, by an arrow

/** Where the curve stands in the plane; of several matrices, where the nearest of one does. */
export function placeOf(c: NetworkCurveShown | undefined): Point | null {
  if (typeof c?.alpha === "number") return [c.alpha, c.s ?? 1];
  return typeof c?.nearest?.alpha === "number" ? [c.nearest.alpha, c.nearest.s ?? 1] : null;
}

export class NetworkPlane {
  private readonly plot = new PlanePlot();
  readonly element = h("div", { class: "plane", id: "network-plane" }, this.plot.element);
  private readonly known = new WeakMap<Surface, Map<string, CurvePlaneResult | null>>();
  private plane: CurvePlaneResult | null = null;
  private wanted: Point | null = null;
  private value: NetworkCurveShown | undefined;
  private colors: (() => Palette) | null = null;
  /** Where a hand has put the curve. */
  onPlace: (alpha: number, s: number) => void = () => {};

  constructor(private readonly client: Client) {
    const { canvas } = this.plot;
    this.plot.onResize = () => this.paint();
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      this.drag(e);
    });
    canvas.addEventListener("pointermove", (e) => {
      if (e.buttons & 1) this.drag(e);
    });
    canvas.addEventListener("pointerup", () => this.wanted && this.onPlace(...this.wanted));
    canvas.addEventListener("keydown", (e) => this.key(e));
  }

  /** `value`: of the curve as it was given; `wanted`: where it has been asked to go. */
  show(surface: Surface, name: string, points: readonly (readonly number[])[], value: NetworkCurveShown | undefined,
       wanted: Point | null, colors: () => Palette): void {
    this.colors = colors;
    this.value = value;
    this.wanted = wanted;
    const all = this.known.get(surface) ?? new Map<string, CurvePlaneResult | null>();
    this.known.set(surface, all);
    const known = all.get(name);
    this.plane = known ?? null;
    this.paint();
    if (known !== undefined) return;
    all.set(name, null);
    const curve = { type: "bezier", points } as unknown as Curve;
    void this.client.call<CurvePlaneResult>("curve.plane", { curve }).then((answer) => {
      if (!answer.ok) return;
      all.set(name, answer.result);
      this.plane = answer.result;
      this.paint();
    });
  }

  private drag(event: PointerEvent): void {
    if (!this.plane) return;
    const { alpha, s } = this.plot.placeAt(event.offsetX, event.offsetY);
    this.wanted = [alpha, s];
    this.paint();
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    const { plane } = this;
    if (!plane || (!step && event.key !== "Enter")) return;
    event.preventDefault();
    event.stopPropagation();
    if (!step) return void (this.wanted && this.onPlace(...this.wanted));
    const now = this.wanted ?? placeOf(this.value) ?? [0.3, 1.2];
    const wide = event.shiftKey ? 10 : 1;
    const [low, high] = plane.s as Point;
    const widest = (plane.alpha as Point)[1];
    const clamp = (v: number, from: number, to: number) => Math.min(to, Math.max(from, v));
    this.wanted = [
      clamp(now[0] + wide * (step[0] as number) * kNudge * widest, 0, widest),
      clamp(now[1] + wide * (step[1] as number) * kNudge * (high - low), low, high),
    ];
    this.paint();
  }

  private paint(): void {
    if (!this.element.isConnected || !this.colors) return;
    const { plane } = this;
    const colors = this.colors();
    if (!plane) return this.plot.paint(null, colors);
    const { value } = plane;
    const given = placeOf(this.value);
    this.plot.paint({
      plane, given: this.wanted ? given : null, now: this.wanted ?? given, near: !this.wanted && typeof this.value?.alpha !== "number",
      minimum: value?.minimum ? [value.minimum.alpha ?? 0, value.minimum.s ?? 1] : null, path: [],
    }, colors);
  }
}

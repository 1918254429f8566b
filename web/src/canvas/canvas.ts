/** The canvas: what the pointer does goes to the gesture, what it shows comes from the scene. */
import type { Gesture, Pointer, Table } from "../gestures/gesture.ts";
import { gestureFor } from "../gestures/draw.ts";
import { type BoxPart, turnBox, turnerOf } from "../gestures/box.ts";
import { handleAt, type HandleHit, partAt } from "../gestures/pick.ts";
import { snapped } from "../gestures/snap.ts";
import type { Pixel, Point } from "../model/document.ts";
import type { ToolName } from "../model/state.ts";
import { h } from "../ui/dom.ts";
import { Latency } from "./latency.ts";
import { paintScene, type Scene } from "./scene.ts";

const kPatience = 2; // frames that wait for a curve under way

export class Canvas {
  readonly element: HTMLCanvasElement;
  readonly latency = new Latency();
  private readonly pen: CanvasRenderingContext2D;
  private gesture: Gesture;
  private tool: ToolName = "select";
  private cursor: Pointer | null = null;
  private byKeys = false;
  private spaced = false; // the space bar is down: what is dragged is the view
  private readonly touches = new Map<number, Pixel>();
  private scheduled = false;
  private readonly images = new Map<string, HTMLImageElement>();
  /** what is said below it may be another */
  onPaint: () => void = () => {};
  /** before the first size is known nothing can be fitted */
  onReady: () => void = () => {};

  constructor(private readonly table: Table, private readonly extras: Pick<Scene, "before" | "region" | "deviation">) {
    this.element = h("canvas", {
      class: "board", tabindex: 0, role: "application",
      "aria-label": "Drawing board. Arrow keys pan, with Alt they move what is chosen; plus and minus zoom, F fits; Tab from here reaches the panels.",
    });
    this.pen = this.element.getContext("2d", { alpha: false, desynchronized: true }) as CanvasRenderingContext2D;
    this.gesture = gestureFor(table, "select");
    this.listen();
    new ResizeObserver(() => this.resize()).observe(this.element);
  }

  get hint(): string {
    const { snappedTo } = this.table.store.state;
    return `${this.gesture.hint ?? ""}${snappedTo ? ` \u2013 at the ${snappedTo}` : ""}`;
  }

  /** The handle under the pointer. */
  get hot(): HandleHit | null {
    return this.cursor ? handleAt(this.table, this.cursor.at) : null;
  }

  private get hotPart(): BoxPart | null {
    return this.cursor && !this.hot ? partAt(this.table, this.cursor.at) : null;
  }

  /** Where the box about what is chosen can be taken hold of, on the canvas. */
  parts(): { corners: Pixel[]; turner: Pixel; pivot: Pixel } | null {
    const { view } = this.table;
    const box = turnBox(this.table);
    return box && { corners: box.corners.map((c) => view.toScreen(c)), turner: turnerOf(view, box.corners).at, pivot: view.toScreen(box.pivot) };
  }

  get place(): Point | null {
    return this.cursor?.place ?? null;
  }

  useTool(tool: ToolName): void {
    if (tool === this.tool) return;
    this.tool = tool;
    this.gesture = gestureFor(this.table, tool);
    if (tool !== "select") this.table.store.set({ hover: null });
    this.after();
  }

  paint(): void {
    this.scheduled = false;
    const { store, live, view } = this.table;
    const { underlay } = store.state;
    paintScene(this.pen, {
      state: store.state, live, view, ...this.extras,
      hot: this.hot,
      box: turnBox(this.table),
      hotPart: this.hotPart,
      cursor: this.cursor?.place ?? null,
      crosshair: this.byKeys && this.tool !== "select",
      started: this.gesture.started ?? [],
      underlay: underlay ? this.image(underlay.stages.find((s) => s.name === underlay.stage)?.url ?? underlay.url) : null,
    });
    this.onPaint();
  }

  /** Once a frame; while a hand drags, the curve that is on its way paints the frame itself. */
  schedule(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => this.frame(kPatience));
  }

  private frame(patience: number): void {
    if (!this.scheduled) return;
    const { store, live } = this.table;
    const awaited = store.state.draft !== null && store.state.carrying === null && live.asking;
    if (awaited && patience > 0) requestAnimationFrame(() => this.frame(patience - 1));
    else this.paint();
  }

  /** A key the gesture may know. */
  key(name: string): boolean {
    if (name === "Escape") {
      this.follow(this.gesture.cancel?.() ?? this.gesture);
      return true;
    }
    const next = this.gesture.key?.(name);
    if (!next) return false;
    this.follow(next);
    return true;
  }

  /** The pointer moved by keys, in pixels: from where it is, else from the middle. */
  step(by: Pixel): void {
    const { view } = this.table;
    const at = this.cursor?.at ?? [view.width / 2, view.height / 2];
    const within = (v: number, most: number) => Math.min(Math.max(v, 0), most);
    this.cursor = this.pointerAt([within(at[0] + by[0], view.width), within(at[1] + by[1], view.height)]);
    this.byKeys = true;
    this.follow(this.gesture.move?.(this.cursor) ?? this.gesture);
  }

  /** A click where the pointer is. */
  press(): void {
    this.cursor ??= this.pointerAt([this.table.view.width / 2, this.table.view.height / 2]);
    this.byKeys = true;
    this.follow(this.gesture.down?.(this.cursor) ?? this.gesture);
    this.follow(this.gesture.up?.(this.cursor) ?? this.gesture);
  }

  private image(url: string): HTMLImageElement {
    let image = this.images.get(url);
    if (!image) {
      image = new Image();
      image.onload = () => this.schedule();
      image.src = url;
      this.images.set(url, image);
    }
    return image;
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    const ratio = devicePixelRatio;
    this.element.width = Math.round(clientWidth * ratio);
    this.element.height = Math.round(clientHeight * ratio);
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.table.view.width = clientWidth;
    this.table.view.height = clientHeight;
    this.onReady();
    this.paint();
  }

  private pointer(event: PointerEvent | MouseEvent): Pointer {
    const box = this.element.getBoundingClientRect();
    const { shiftKey: shift, altKey: alt, button, timeStamp: time } = event;
    this.byKeys = false;
    const coarse = event instanceof PointerEvent && event.pointerType === "touch";
    return { ...this.pointerAt([event.clientX - box.left, event.clientY - box.top], event.ctrlKey), shift, alt, button, coarse, time };
  }

  /** Control does the opposite of what the snap is set to. */
  private pointerAt(at: Pixel, otherwise = false): Pointer {
    const snaps = this.table.store.state.looks.snap !== otherwise;
    const bare = { at, snaps, shift: false, alt: false, button: 0, coarse: false, time: performance.now() };
    if (this.gesture.placesItself) return { ...bare, place: this.table.view.toModel(at) };
    const { place, to } = snaps ? snapped(this.table, at) : { place: this.table.view.toModel(at), to: "" };
    if (to !== this.table.store.state.snappedTo) this.table.store.set({ snappedTo: to });
    return { ...bare, place };
  }

  private follow(next: Gesture): void {
    this.gesture = next;
    if (this.table.store.state.tool !== this.tool) this.useTool(this.table.store.state.tool);
    this.after();
  }

  private after(): void {
    const cursor = this.gesture.cursor ?? "default";
    if (cursor !== this.element.style.cursor) this.element.style.cursor = cursor;
    this.schedule();
  }

  private listen(): void {
    const on = <K extends keyof HTMLElementEventMap>(name: K, act: (e: HTMLElementEventMap[K]) => void) =>
      this.element.addEventListener(name, act, { passive: false });
    on("pointerdown", (e) => this.down(e));
    on("pointermove", (e) => this.move(e));
    // browsers keep moves back until the next frame; while a hand drags, the next question leaves at once
    this.element.addEventListener("pointerrawupdate", (e) => {
      const { store, live } = this.table;
      if (store.state.draft !== null && !live.asking && (e as PointerEvent).pointerType !== "touch") this.move(e as PointerEvent);
    });
    on("pointerup", (e) => this.up(e));
    on("pointercancel", (e) => {
      this.touches.delete(e.pointerId);
      this.follow(this.gesture.cancel?.() ?? this.gesture);
    });
    on("pointerleave", () => {
      this.cursor = null;
      this.table.store.set({ hover: null });
      this.after();
    });
    on("dblclick", (e) => this.follow(this.gesture.doubled?.(this.pointer(e)) ?? this.gesture));
    on("contextmenu", (e) => e.preventDefault());
    on("keydown", (e) => {
      if (e.key === " ") this.spaced = true;
    });
    addEventListener("keyup", (e) => {
      if (e.key === " ") this.spaced = false;
    });
    on("wheel", (e) => this.wheel(e));
  }

  private down(e: PointerEvent): void {
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(e.pointerId);
    if (e.pointerType === "touch") {
      this.touches.set(e.pointerId, [e.clientX, e.clientY]);
      if (this.touches.size === 2) return this.follow(this.gesture.cancel?.() ?? this.gesture);
    }
    this.cursor = this.pointer(e);
    if (this.spaced && this.cursor.button === 0) this.cursor.button = 1;
    this.follow(this.gesture.down?.(this.cursor) ?? this.gesture);
  }

  private move(e: PointerEvent): void {
    if (e.pointerType === "touch" && this.touches.size === 2) return this.pinch(e);
    this.cursor = this.pointer(e);
    this.latency.began(e.timeStamp);
    this.follow(this.gesture.move?.(this.cursor) ?? this.gesture);
  }

  private up(e: PointerEvent): void {
    this.touches.delete(e.pointerId);
    this.cursor = this.pointer(e);
    this.follow(this.gesture.up?.(this.cursor) ?? this.gesture);
    if (e.pointerType === "touch") this.cursor = null;
  }

  /** Two fingers move, turn nothing and zoom what lies between them. */
  private pinch(e: PointerEvent): void {
    const other = [...this.touches].find(([id]) => id !== e.pointerId)?.[1];
    const last = this.touches.get(e.pointerId);
    if (!other || !last) return;
    const now: Pixel = [e.clientX, e.clientY];
    const box = this.element.getBoundingClientRect();
    const middle: Pixel = [(now[0] + other[0]) / 2 - box.left, (now[1] + other[1]) / 2 - box.top];
    const apart = (p: Pixel) => Math.max(10, Math.hypot(p[0] - other[0], p[1] - other[1]));
    this.table.view.panBy((now[0] - last[0]) / 2, (now[1] - last[1]) / 2);
    this.table.view.zoomAt(middle, apart(now) / apart(last));
    this.touches.set(e.pointerId, now);
    this.schedule();
  }

  /** Wheel zooms to the cursor, with Shift it scales the comb, with Alt thins it out; a trackpad's two fingers pan. */
  private wheel(e: WheelEvent): void {
    e.preventDefault();
    const { store, view } = this.table;
    const pixels = e.deltaMode === WheelEvent.DOM_DELTA_PIXEL;
    const turned = (e.deltaY || e.deltaX) * (pixels ? 1 : 30);
    if (e.shiftKey) return store.scaleComb(store.state.looks.combScale * Math.exp(-turned / 500));
    if (e.altKey) {
      const density = store.state.looks.combDensity + Math.sign(turned);
      return store.look({ combDensity: Math.min(12, Math.max(1, density)) });
    }
    const trackpad = pixels && !e.ctrlKey && (e.deltaX !== 0 || Math.abs(e.deltaY) < 40);
    if (trackpad) view.panBy(-e.deltaX, -e.deltaY);
    else view.zoomAt(this.pointer(e).at, Math.exp(-turned / (e.ctrlKey ? 100 : 400)));
    this.schedule();
  }
}

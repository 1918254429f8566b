/** The page put together. */
import type { Client } from "./api/client.ts";
import { Canvas } from "./canvas/canvas.ts";
import { paletteOf } from "./canvas/scene.ts";
import type { Table } from "./gestures/gesture.ts";
import { Dock, type Subject } from "./graphs/dock.ts";
import { Fitting } from "./fitting.ts";
import { Keyboard } from "./keyboard.ts";
import { Autosave, ownDocument } from "./model/autosave.ts";
import { Before } from "./model/before.ts";
import { Deviation } from "./model/deviation.ts";
import { added, emptyDoc, entityOf, without } from "./model/document.ts";
import { Live } from "./model/live.ts";
import { exportAs, isImage, openNamed } from "./model/open.ts";
import { DrawableRegion } from "./model/region.ts";
import { kExample, startState, Store } from "./model/state.ts";
import { actionsPanel, split } from "./panels/actions.ts";
import { ClassAPanel } from "./panels/classa.ts";
import { FairPanel } from "./panels/fair.ts";
import { FileBar } from "./panels/filebar.ts";
import { listPanel, reveal } from "./panels/list.ts";
import { LooksBar } from "./panels/looks.ts";
import { measuresPanel, reading } from "./panels/measures.ts";
import { placePanel } from "./panels/place.ts";
import { Notices } from "./panels/notices.ts";
import { shapePanel } from "./panels/shape.ts";
import { layAgain, layUnder, SketchPanel } from "./panels/sketch.ts";
import { SurfacePanel } from "./panels/surface.ts";
import { TargetPanel } from "./panels/target.ts";
import { ToolRail } from "./panels/toolbar.ts";
import { SurfaceStage } from "./surfaces/stage.ts";
import { section } from "./ui/controls.ts";
import { fill, h, refill } from "./ui/dom.ts";
import { Viewport } from "./view/viewport.ts";
import { label, readable, roundStep } from "./view/ticks.ts";

const kSpaceHint = "Drag turns, wheel comes nearer, the right button moves; arrows, plus and minus do too";

/** When the first curve stood there, to be touched. */
export const kFirstCurve = "first-curve";

export class Studio {
  readonly store: Store;
  readonly live: Live;
  readonly canvas: Canvas;
  readonly before: Before;
  readonly view = new Viewport();
  private readonly dock: Dock;
  private readonly fair: FairPanel;
  private readonly classA: ClassAPanel;
  private readonly target: TargetPanel;
  private readonly sketch: SketchPanel;
  private readonly surfaces: SurfaceStage;
  private readonly surfacePanel: SurfacePanel;
  readonly region: DrawableRegion;
  private readonly deviation: Deviation;
  private readonly looks: LooksBar;
  private readonly fitting: Fitting;
  readonly autosave: Autosave;
  private readonly panel = h("aside", { class: "panel", "aria-label": "Properties" });
  private readonly status = h("div", { class: "status", role: "status" });
  private readonly bar = new FileBar(this);
  private revealed: number | null = null; // the thing that the list was scrolled to

  constructor(readonly client: Client, root: HTMLElement) {
    const wantsLight = matchMedia("(prefers-color-scheme: light)").matches;
    this.store = new Store(startState((localStorage.getItem("keyline-theme") as "dark" | "light" | null) ?? (wantsLight ? "light" : "dark")));
    this.live = new Live(client, this.store);
    this.before = new Before(client, this.store);
    const table: Table = {
      store: this.store, live: this.live, view: this.view, client, paint: () => this.canvas.schedule(),
    };
    this.region = new DrawableRegion(client, this.store, this.live);
    this.deviation = new Deviation(client, this.store);
    this.canvas = new Canvas(table, {
      before: (id) => this.before.of(id)?.comb, region: this.region, deviation: (id) => this.deviation.of(id),
    });
    this.dock = new Dock(this.store, () => this.subject(), () => paletteOf(this.store.state));
    this.fair = new FairPanel(client, this.store, this.live);
    this.classA = new ClassAPanel(client, this.store, this.live);
    this.target = new TargetPanel(client, this.store, this.live, this.dock.curvature);
    this.sketch = new SketchPanel(client, this.store);
    this.surfaces = new SurfaceStage(client, this.store);
    this.surfacePanel = new SurfacePanel(client, this.store, this.surfaces);
    const notices = new Notices(this.store);
    this.fitting = new Fitting(this.store, this.live, this.view, () => this.subject()?.shown, () => this.canvas.schedule());
    this.looks = new LooksBar(this.store, () => this.fitting.fitComb());
    this.autosave = new Autosave(client, this.store, localStorage);
    root.replaceChildren(h("div", { class: "studio" },
      h("header", {}, h("h1", {}, h("img", { src: "icon.svg", alt: "", width: 20, height: 20 }), "Keyline Studio"),
        this.bar.element, this.looks.element),
      new ToolRail(this.store).element,
      h("main", {}, h("div", { class: "stage" }, this.canvas.element, this.surfaces.element, notices.work, notices.toast), this.dock.element),
      this.panel, this.status));
    this.listen();
    const keyboard = new Keyboard(this, table);
    this.looks.onHelp = () => keyboard.help();
    this.render();
  }

  private listen(): void {
    this.live.onCurve = (id) => this.curveCame(id);
    this.before.onCurve = () => {
      this.canvas.schedule();
      this.dock.paint();
      this.renderPanel();
    };
    this.region.onChange = () => this.canvas.schedule();
    this.deviation.onCame = () => {
      this.canvas.schedule();
      this.dock.paint();
    };
    this.canvas.onPaint = () => this.renderStatus();
    this.canvas.onReady = () => this.fitting.resized(this.surfaces.subject() !== null);
    this.client.onReach = (reached) => {
      if (reached !== this.store.state.reached) this.store.set({ reached });
    };
    this.store.onChange((now, before) => {
      if (now.looks.theme !== before.looks.theme) localStorage.setItem("keyline-theme", now.looks.theme);
      if (now.tool !== before.tool) this.canvas.useTool(now.tool);
      const panel = now.history !== before.history || now.selection !== before.selection || now.underlay?.file !== before.underlay?.file
        || now.underlay?.stages !== before.underlay?.stages || now.underlay?.scale !== before.underlay?.scale || now.measured !== before.measured
        || now.targeting !== before.targeting || now.tool !== before.tool || (now.looks.wipe === null) !== (before.looks.wipe === null);
      if (panel) this.renderPanel();
      if (now.history !== before.history) this.bar.render();
      const fair = this.panel.querySelector<HTMLButtonElement>("#fair");
      if (fair && now.work !== before.work) fair.disabled = now.work !== null;
      if (now.hover !== before.hover || now.stretch !== before.stretch || now.targeting !== before.targeting || now.selection !== before.selection || now.looks !== before.looks) {
        this.dock.paint();
        this.renderStatus();
      }
      if (now.looks.theme !== before.looks.theme) {
        document.documentElement.dataset.theme = now.looks.theme;
        this.classA.follow();
      }
      this.canvas.schedule();
    });
    this.store.onChange((now, before) => {
      if (now.selection !== before.selection) this.fitting.refitComb();
    });
    this.listenToDrops();
  }

  /** A curve has come: it is painted at once, with its comb and graphs, in the same breath. */
  private curveCame(id: number): void {
    const { state } = this.store;
    if (state.looks.combScale === 0) this.fitting.fitComb();
    else if (!state.draft && state.selection.includes(id)) this.fitting.refitComb();
    this.fitting.fitOnce();
    this.fitting.completed();
    this.canvas.paint();
    void this.region.update();
    if (state.selection.includes(id)) {
      this.dock.paint();
      this.classA.follow();
      if (this.panel.querySelector("#comb-scale")) this.renderMeasures();
      else this.renderPanel();
    }
    this.canvas.latency.painted(state.draft !== null);
    if (performance.getEntriesByName(kFirstCurve).length === 0) performance.mark(kFirstCurve);
  }

  subject(): Subject | null {
    const { state } = this.store;
    for (const entity of [...state.selection].reverse()) {
      const shown = this.live.of(entity);
      if (!shown) continue;
      // what it was before; else another chosen curve, to be held beside it
      const other = state.selection.find((id) => id !== entity && this.live.of(id));
      const own = this.before.of(entity);
      return {
        entity, shown, before: own ?? (other === undefined ? undefined : this.live.of(other)), deviation: this.deviation.of(entity),
        beside: own || other === undefined ? "" : entityOf(this.store.doc, other)?.name ?? "",
      };
    }
    return null;
  }

  fit(): void {
    if (this.surfaces.subject()) this.surfaces.fit();
    else this.fitting.fit();
  }

  async openFiles(files: FileList | readonly File[]): Promise<void> {
    for (const file of files) {
      const own = await ownDocument(file);
      if (own) {
        this.store.commit(`Open ${file.name}`, own.doc, { selection: own.doc.entities.slice(-1).map((e) => e.id) });
        if (own.picture) await layAgain(this.client, this.store, own.picture);
        continue;
      }
      const kept = await this.client.upload(file.name, file);
      if (!kept.ok) this.store.say(kept.error.message, kept.error.hint ?? "", true);
      else await this.openThere(kept.result, file);
    }
    this.fit();
  }

  /** A file the other side has: a picture to draw over, whatever else it holds. */
  private async openThere(file: string, content: Blob | null): Promise<void> {
    if (isImage(file) && content) await layUnder(this.client, this.store, content, file);
    else await openNamed(this.client, this.store, file);
  }

  /** All that is shown, as a drawing other programs paste. */
  async copy(): Promise<void> {
    await exportAs(this.client, this.store, this.live, "svg", (_name, content) => {
      const text = content.text();
      void navigator.clipboard.write([new ClipboardItem({ "text/plain": text.then((t) => new Blob([t], { type: "text/plain" })) })])
        .then(() => this.store.say("Copied as SVG"), () => this.store.say("The browser does not let us copy", "export it as a file", true));
    });
  }

  /** The document itself, with everything that can still be moved. */
  async saveDocument(): Promise<void> {
    const name = (this.autosave.files[0] ?? "keyline").replace(/^.*\//, "").replace(/\..*$/, "");
    this.save(`${name}.keyline.json`, new Blob([await this.autosave.whole()], { type: "application/json" }));
  }

  private listenToDrops(): void {
    addEventListener("dragover", (e) => e.preventDefault());
    addEventListener("drop", (e) => {
      e.preventDefault();
      if (e.dataTransfer) void this.openFiles([...e.dataTransfer.files]);
    });
  }

  chooseFile(): void {
    const input = h("input", { type: "file", multiple: true });
    input.addEventListener("change", () => input.files && void this.openFiles(input.files));
    input.click();
  }

  export(format: string): void {
    void exportAs(this.client, this.store, this.live, format, (name, content) => this.save(name, content));
  }

  private save(name: string, content: Blob): void {
    const url = URL.createObjectURL(content);
    h("a", { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
  }

  splitHere(): void {
    const { hover } = this.store.state;
    if (hover) void split(this.client, this.store, this.live, hover);
  }

  removeSelected(): void {
    const { selection } = this.store.state;
    if (selection.length > 0)
      this.store.commit("Remove", without(this.store.doc, selection), { selection: [], hover: null });
  }

  // ---- what is shown beside the canvas ------------------------------------------------------

  private render(): void {
    document.documentElement.dataset.theme = this.store.state.looks.theme;
    this.bar.render();
    this.renderPanel();
    this.renderStatus();
  }

  private renderPanel(): void {
    const doc = this.store.doc;
    const e = entityOf(doc, this.store.state.selection.at(-1) ?? null);
    const subject = this.subject();
    const fairable = e && (e.kind === "scan" || e.kind === "faired" || e.kind === "fixed");
    fill(this.panel,
      listPanel(this.store),
      e && shapePanel(this.store, e),
      placePanel(this),
      ...(e?.kind === "surface" ? this.surfacePanel.element(e) : []),
      fairable && e.kind !== "fixed" && this.fair.element(e),
      h("div", { id: "measures-slot" }),
      fairable && e.kind === "fixed" && this.fair.element(e),
      actionsPanel(this.client, this.store, this.live),
      e && this.target.element(e),
      e && subject?.entity === e.id && this.client.can("curve.edit") && this.classA.element(e),
      this.sketch.element(),
      subject && h("section", {}, h("h2", {}, "Comb"), this.looks.combControls()));
    this.renderMeasures();
    if (e && e.id !== this.revealed) reveal(e.id);
    this.revealed = e?.id ?? null;
  }

  private renderMeasures(): void {
    const slot = this.panel.querySelector("#measures-slot");
    const subject = this.subject();
    const e = subject && entityOf(this.store.doc, subject.entity);
    const failure = e && this.live.failureOf(e.id);
    if (slot)
      refill(slot,
        failure && section("Cannot be drawn", h("p", { class: "bad", id: "failure" }, readable(failure.message)), h("p", { class: "quiet" }, readable(failure.hint ?? ""))),
        e && measuresPanel(e, subject.shown, subject.before, subject.beside, this.store.doc.unit));
  }

  private renderStatus(): void {
    const { hover } = this.store.state;
    const shown = hover && this.live.of(hover.entity);
    const place = this.canvas.place;
    const { latency } = this.canvas;
    refill(this.status,
      h("span", { class: "reading", id: "reading" }, shown ? reading(entityOf(this.store.doc, hover.entity), shown, hover.sample, this.store.doc.unit)
        : this.surfaces.subject() ? kSpaceHint : this.canvas.hint),
      h("span", { class: "place" }, place ? place.map((v) => label(v, roundStep(1 / this.view.scale))).join(", ") : ""),
      h("span", { class: "speed", title: "from the hand's move to the painted curve: half within, 95 % within" },
        latency.count > 10 ? `${latency.within(0.5).toFixed(1)} / ${latency.within(0.95).toFixed(1)} ms` : ""));
  }

  // ---- the start ----------------------------------------------------------------------------

  async start(): Promise<void> {
    const keeping = this.autosave.kept(); // both at once: a first curve waits for them
    const there = await this.client.session();
    if (!there.ok) {
      this.store.say(there.error.message, there.error.hint ?? "", true);
      return;
    }
    const session = there.result;
    this.autosave.files = session.files;
    document.title = session.files[0] ? `${session.files[0]} \u2013 Keyline Studio` : "Keyline Studio";
    const kept = await keeping;
    const goesOn = kept && (session.files.length === 0 || JSON.stringify(kept.files) === JSON.stringify(session.files));
    if (kept && goesOn) {
      this.store.commit("Recover", kept.doc, { selection: kept.doc.entities.slice(-1).map((e) => e.id) });
      this.store.say("Your work is back as you left it", "Undo starts afresh");
      if (kept.picture) await layAgain(this.client, this.store, kept.picture);
    } else if (session.files.length > 0) {
      for (const file of session.files) await this.openThere(file, isImage(file) ? await this.client.given(file) : null);
    } else {
      this.store.commit(kExample, example(), { selection: [1] });
    }
    this.fit();
  }
}

/** Something to touch at once. */
function example() {
  return added(emptyDoc(), {
    kind: "segment", name: "Segment 1", points: [[0, 0], [180, 0], [230, 130]], alpha: -1,
  }).doc;
}

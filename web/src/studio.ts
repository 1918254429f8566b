/** The page put together. */
import { Client, type Session } from "./api/client.ts";
import { Canvas } from "./canvas/canvas.ts";
import { paletteOf } from "./canvas/scene.ts";
import type { Table } from "./gestures/gesture.ts";
import { Dock, type Subject } from "./graphs/dock.ts";
import { Keyboard } from "./keyboard.ts";
import { Autosave } from "./model/autosave.ts";
import { Before } from "./model/before.ts";
import { added, emptyDoc, entityOf, isShown, type Point, without } from "./model/document.ts";
import { Live, type Shown } from "./model/live.ts";
import { exportAs, type Format, formats, isImage, openNamed } from "./model/open.ts";
import { startState, Store } from "./model/state.ts";
import { actionsPanel } from "./panels/actions.ts";
import { FairPanel } from "./panels/fair.ts";
import { listPanel } from "./panels/list.ts";
import { LooksBar } from "./panels/looks.ts";
import { measuresPanel, reading } from "./panels/measures.ts";
import { shapePanel } from "./panels/shape.ts";
import { ToolRail } from "./panels/toolbar.ts";
import { layUnder, underlayPanel } from "./panels/underlay.ts";
import { iconButton } from "./ui/controls.ts";
import { fill, h } from "./ui/dom.ts";
import { icons } from "./ui/icons.ts";
import { boxOf, Viewport } from "./view/viewport.ts";
import { measure } from "./view/ticks.ts";

// A comb that fits: nine teeth of ten within this share of the canvas' smaller side, so that one tight
// corner does not press the rest flat; none longer than the second.
const kMostTeeth = 0.9;
const kToothShare = 0.16;
const kLongestTooth = 0.55;

export class Studio {
  readonly store: Store;
  readonly live: Live;
  readonly canvas: Canvas;
  readonly before: Before;
  readonly view = new Viewport();
  private readonly dock: Dock;
  private readonly fair: FairPanel;
  private readonly looks: LooksBar;
  private readonly autosave: Autosave;
  private readonly panel = h("aside", { class: "panel", "aria-label": "Properties" });
  private readonly status = h("div", { class: "status", role: "status" });
  private readonly toast = h("div", { class: "toast", role: "alert" });
  private readonly work = h("div", { class: "work" });
  private readonly bar = h("div", { class: "file-bar", role: "toolbar", "aria-label": "File" });
  private fitted = false;

  constructor(readonly client: Client, root: HTMLElement) {
    const wantsLight = matchMedia("(prefers-color-scheme: light)").matches;
    this.store = new Store(startState((localStorage.getItem("keyline-theme") as "dark" | "light" | null) ?? (wantsLight ? "light" : "dark")));
    this.live = new Live(client, this.store);
    this.before = new Before(client, this.store);
    const table: Table = {
      store: this.store, live: this.live, view: this.view, client, paint: () => this.canvas.schedule(),
    };
    this.canvas = new Canvas(table, (id) => this.before.of(id)?.comb);
    this.dock = new Dock(this.store, () => this.subject(), () => paletteOf(this.store.state));
    this.fair = new FairPanel(client, this.store, this.live);
    this.looks = new LooksBar(this.store, () => this.fitComb());
    this.autosave = new Autosave(client, this.store, localStorage);
    root.append(h("div", { class: "studio" },
      h("header", {}, h("h1", {}, h("img", { src: "icon.svg", alt: "", width: 20, height: 20 }), "Keyline Studio"),
        this.bar, this.looks.element),
      new ToolRail(this.store).element,
      h("main", {}, h("div", { class: "stage" }, this.canvas.element, this.work, this.toast), this.dock.element),
      this.panel, this.status));
    this.listen();
    new Keyboard(this, table);
    this.render();
  }

  private listen(): void {
    this.live.onCurve = (id) => this.curveCame(id);
    this.before.onCurve = () => {
      this.canvas.schedule();
      this.dock.paint();
      this.renderPanel();
    };
    this.canvas.onStatus = () => this.renderStatus();
    this.canvas.onReady = () => this.fitOnce();
    this.client.onReach = (reached) => {
      if (reached !== this.store.state.reached) this.store.set({ reached });
    };
    this.store.onChange((now, before) => {
      if (now.looks.theme !== before.looks.theme) localStorage.setItem("keyline-theme", now.looks.theme);
      if (now.tool !== before.tool) this.canvas.useTool(now.tool);
      const panel = now.history !== before.history || now.selection !== before.selection || now.underlay?.file !== before.underlay?.file;
      if (panel) this.renderPanel();
      if (panel || now.history !== before.history) this.renderBar();
      if (now.work !== before.work) this.renderWork();
      if (now.message !== before.message || now.reached !== before.reached) this.renderToast();
      if (now.hover !== before.hover || now.selection !== before.selection || now.looks !== before.looks) {
        this.dock.paint();
        this.renderStatus();
      }
      if (now.looks.theme !== before.looks.theme) document.documentElement.dataset.theme = now.looks.theme;
      this.canvas.schedule();
    });
    this.listenToDrops();
  }

  /** A curve has come: it is painted at once, with its comb and graphs, in the same breath. */
  private curveCame(id: number): void {
    const { state } = this.store;
    if (state.looks.combScale === 0) this.fitComb();
    this.fitOnce();
    this.canvas.paint();
    if (state.selection.includes(id)) {
      this.dock.paint();
      if (this.panel.querySelector("#comb-scale")) this.renderMeasures();
      else this.renderPanel();
    }
    this.canvas.latency.painted(state.draft !== null);
    this.renderStatus();
  }

  subject(): Subject | null {
    const { state } = this.store;
    for (const entity of [...state.selection].reverse()) {
      const shown = this.live.of(entity);
      if (shown) return { entity, shown, before: this.before.of(entity) };
    }
    return null;
  }

  private drawn(): Point[] {
    const doc = this.store.doc;
    const under = this.store.state.underlay;
    return doc.entities.filter((e) => isShown(doc, e)).flatMap((e): Point[] => {
      if (e.kind === "scan") return e.line.points as Point[];
      const own = "points" in e ? (e.points as Point[]) : [];
      return [...own, ...((this.live.of(e.id)?.comb.points ?? []) as Point[])];
    }).concat(under ? [under.at, [under.at[0] + under.width * under.scale, under.at[1] + under.height * under.scale]] : []);
  }

  fit(): void {
    const box = boxOf(this.drawn());
    if (!box) return;
    const margin = Math.min(this.view.width, this.view.height) * 0.16;
    this.view.fit(box, { left: margin, right: margin, top: margin, bottom: margin });
    this.fitted = true;
    this.canvas.schedule();
  }

  private fitOnce(): void {
    if (!this.fitted && this.view.width > 100) this.fit();
  }

  /** The longest tooth of the chosen curve (else of any) as long as is good to look at. */
  fitComb(): void {
    const subject = this.subject();
    const shown: Shown[] = subject ? [subject.shown]
      : this.store.doc.entities.flatMap((e) => this.live.of(e.id) ?? []);
    const sizes = shown.flatMap((s) => s.comb.curvature.map(Math.abs)).sort((a, b) => a - b);
    const largest = sizes.at(-1) ?? 0;
    if (!(largest > 0)) return;
    const most = sizes[Math.floor(kMostTeeth * (sizes.length - 1))] ?? largest;
    const side = Math.min(this.view.width, this.view.height) / this.view.scale;
    this.store.look({ combScale: Math.min((kToothShare * side) / Math.max(most, 1e-12), (kLongestTooth * side) / largest) });
  }

  async openFiles(files: FileList | readonly File[]): Promise<void> {
    for (const file of files) {
      const kept = await this.client.upload(file.name, file);
      if (!kept.ok) this.store.say(kept.error.message, kept.error.hint ?? "", true);
      else if (isImage(file.name)) await layUnder(this.store, file, kept.result);
      else await openNamed(this.client, this.store, kept.result);
    }
    this.fit();
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

  export(format: Format): void {
    void exportAs(this.client, this.store, this.live, format, (name, content) => {
      const url = URL.createObjectURL(content);
      h("a", { href: url, download: name }).click();
      setTimeout(() => URL.revokeObjectURL(url), 10_000);
    });
  }

  removeSelected(): void {
    const { selection } = this.store.state;
    if (selection.length > 0)
      this.store.commit("Remove", without(this.store.doc, selection), { selection: [], hover: null });
  }

  // ---- what is shown beside the canvas ------------------------------------------------------

  private render(): void {
    document.documentElement.dataset.theme = this.store.state.looks.theme;
    this.renderBar();
    this.renderPanel();
    this.renderStatus();
  }

  private renderBar(): void {
    const { history } = this.store.state;
    const past = history.past.at(-1);
    const future = history.future[0];
    const choose = h("select", { id: "export", "aria-label": "Export" },
      h("option", { value: "" }, "Export\u2026"), ...formats.map((f) => h("option", { value: f }, f.toUpperCase())));
    choose.addEventListener("change", () => {
      if (choose.value) this.export(choose.value as Format);
      choose.value = "";
    });
    fill(this.bar,
      iconButton({ id: "open", icon: icons.open, label: "Open a file", key: "Ctrl O", onClick: () => this.chooseFile() }),
      iconButton({
        id: "undo", icon: icons.undo, label: past ? `Undo ${past.label}` : "Nothing to undo", key: "Ctrl Z", disabled: !past,
        onClick: () => this.store.undo(),
      }),
      iconButton({
        id: "redo", icon: icons.redo, label: future ? `Redo ${future.label}` : "Nothing to redo", key: "Ctrl Shift Z",
        disabled: !future, onClick: () => this.store.redo(),
      }),
      iconButton({ id: "fit", icon: icons.fit, label: "Fit all", key: "F", onClick: () => this.fit() }),
      choose);
  }

  private renderPanel(): void {
    const doc = this.store.doc;
    const e = entityOf(doc, this.store.state.selection.at(-1) ?? null);
    const subject = this.subject();
    const fairable = e && (e.kind === "scan" || e.kind === "faired" || e.kind === "fixed");
    fill(this.panel,
      listPanel(this.store),
      actionsPanel(this.store, this.live),
      e && shapePanel(this.store, e),
      h("div", { id: "measures-slot" }),
      fairable && this.fair.element(e),
      underlayPanel(this.client, this.store),
      subject && h("section", {}, h("h2", {}, "Comb"), this.looks.combControls()));
    this.renderMeasures();
  }

  private renderMeasures(): void {
    const slot = this.panel.querySelector("#measures-slot");
    const subject = this.subject();
    const e = subject && entityOf(this.store.doc, subject.entity);
    const failure = e && this.live.failureOf(e.id);
    if (slot)
      fill(slot,
        failure && h("p", { class: "verdict bad", id: "failure" }, failure.message, h("span", { class: "quiet" }, failure.hint ?? "")),
        e && measuresPanel(e, subject.shown, subject.before, this.store.doc.unit));
  }

  private renderStatus(): void {
    const { hover } = this.store.state;
    const shown = hover && this.live.of(hover.entity);
    const place = this.canvas.place;
    const { latency } = this.canvas;
    fill(this.status,
      h("span", { class: "reading", id: "reading" }, shown ? reading(shown, hover.sample, this.store.doc.unit) : this.canvas.hint),
      h("span", { class: "place" }, place ? `${measure(place[0], 5)}, ${measure(place[1], 5)}` : ""),
      h("span", { class: "speed", title: "from the hand's move to the painted curve: half within, 95 % within" },
        latency.count > 10 ? `${latency.within(0.5).toFixed(1)} / ${latency.within(0.95).toFixed(1)} ms` : ""));
  }

  private renderWork(): void {
    const { work } = this.store.state;
    const shown = this.work.firstElementChild;
    if (!work || !shown) {
      fill(this.work, work && h("div", { class: "progress" }, h("span"), h("progress", { max: 1, value: 0 }),
        h("button", { type: "button", id: "cancel", click: () => this.store.state.work?.cancel() }, "Stop")));
    }
    if (work) { // the button stays the same while a hand moves towards it
      const bar = this.work.querySelector("progress") as HTMLProgressElement;
      bar.value = work.fraction;
      bar.ariaLabel = work.doing;
      (this.work.querySelector("span") as HTMLElement).textContent = work.doing;
    }
    const fair = this.panel.querySelector<HTMLButtonElement>("#fair");
    if (fair) fair.disabled = work !== null;
  }

  private renderToast(): void {
    const { message, reached } = this.store.state;
    const lost = !reached && { text: "The server is gone", hint: "your work is kept; start keyline studio again and open the address it prints", bad: true };
    const said = lost || message;
    fill(this.toast, said && h("div", { class: said.bad ? "said bad" : "said" },
      h("strong", {}, said.text), said.hint && h("span", {}, said.hint),
      iconButton({ icon: icons.remove, label: "Dismiss", onClick: () => this.store.say("") })));
  }

  // ---- the start ----------------------------------------------------------------------------

  async start(): Promise<void> {
    const session = await this.client.get<Session>("studio/session");
    if (!session) {
      this.store.say("The server does not know this page", "open the address that keyline studio prints", true);
      return;
    }
    this.autosave.files = session.files;
    document.title = session.files[0] ? `${session.files[0]} \u2013 Keyline Studio` : "Keyline Studio";
    const kept = await this.autosave.kept();
    const goesOn = kept && (session.files.length === 0 || JSON.stringify(kept.files) === JSON.stringify(session.files));
    if (kept && goesOn) {
      this.store.commit("Recover", kept.doc, { selection: kept.doc.entities.slice(-1).map((e) => e.id) });
      this.store.say("Your work is back as you left it", "Undo starts afresh");
    } else if (session.files.length > 0) {
      for (const file of session.files) await openNamed(this.client, this.store, file);
    } else {
      this.store.commit("Example", example(), { selection: [1] });
    }
    this.fit();
  }
}

/** Something to touch at once. */
function example() {
  return added(emptyDoc(), {
    kind: "segment", name: "Segment 1", points: [[0, 0], [150, 0], [230, 130]], alpha: -1,
  }).doc;
}

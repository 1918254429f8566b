/** The surfaces of the document in space, shown over the drawing board while one of them is chosen. */
import type { Client } from "../api/client.ts";
import { paletteOf } from "../canvas/scene.ts";
import type { Palette } from "../canvas/palette.ts";
import { entityOf, isShown, type SurfaceEntity } from "../model/document.ts";
import type { Store } from "../model/state.ts";
import { h } from "../ui/dom.ts";
import { type SurfaceJoint, SurfaceJoints } from "./joints.ts";
import { type Sampled, Samples, shownRange, type SurfaceLook } from "./mesh.ts";
import type { NetworkLine, SurfaceContent, SurfaceView } from "./view.ts";
import { WipeBar } from "./wipebar.ts";

export interface SurfaceLooks {
  look: SurfaceLook;
  stripes: number;
  /** share of the values that the colours hold */
  share: number;
  /** as it was before editing */
  before: boolean;
  network: boolean;
  joints: boolean;
  /** name of a network curve: A1, A2, … */
  chosen: string | null;
}

/** As good, fair or bad as they are: G2 and better, G1, a fold. */
const jointColor = (order: SurfaceJoint["order"], colors: Palette): string =>
  order === "G0" ? colors.bad : order === "G1" ? colors.comb : colors.inflection;

/** Rows and columns of a patch's net, as the table names them. */
export function networkOf({ points: net }: SurfaceEntity["surface"]): Map<string, readonly (readonly number[])[]> {
  const columns = (net[0] ?? []).map((_, j) => net.map((row) => row[j] as number[]));
  return new Map([...net, ...columns].map((points, i) => [`A${i + 1}`, points]));
}

export class SurfaceStage {
  readonly element = h("div", { class: "surface-stage", hidden: true });
  readonly looks: SurfaceLooks = {
    look: "zebra", stripes: 12, share: 0.95, before: false, network: true, joints: true, chosen: null,
  };
  private view: SurfaceView | null = null;
  private loading = false;
  private readonly bar: WipeBar;
  private readonly samples: Samples;
  private readonly meetings: SurfaceJoints;
  /** of the surfaces in sight */
  joints: readonly SurfaceJoint[] = [];
  /** type of each network curve of the chosen surface, for its colour; before editing and now */
  typesBefore = new Map<string, number>();
  types = new Map<string, number>();
  /** of the values in sight */
  range: readonly [number, number] = [0, 1];
  onRange: () => void = () => {};

  constructor(client: Client, private readonly store: Store) {
    this.bar = new WipeBar(store);
    this.element.append(this.bar.element);
    this.samples = new Samples(client);
    this.samples.onCame = () => this.paint();
    this.meetings = new SurfaceJoints(client);
    this.meetings.onCame = () => this.paint();
    this.samples.onFailure = (message) => store.say(message, "", true);
    store.onChange((now, before) => {
      if (now.history.now !== before.history.now || now.selection !== before.selection || now.looks.theme !== before.looks.theme)
        this.paint();
      else if (now.looks.wipe !== before.looks.wipe) this.wipe(now.looks.wipe, before.looks.wipe);
    });
  }

  private wipe(now: number | null, before: number | null): void {
    this.bar.follow();
    if (now === null || before === null) this.paint();
    else this.view?.wipeAt(now);
  }

  subject(): SurfaceEntity | null {
    const e = entityOf(this.store.doc, this.store.state.selection.at(-1) ?? null);
    return e?.kind === "surface" ? e : null;
  }

  look(change: Partial<SurfaceLooks>): void {
    Object.assign(this.looks, change);
    this.paint();
  }

  private async load(): Promise<void> {
    if (this.loading) return;
    this.loading = true;
    const canvas = h("canvas", {
      class: "space", tabindex: 0, role: "application",
      "aria-label": "Surfaces in space. Arrow keys turn them, plus and minus zoom.",
    });
    this.element.append(canvas);
    try {
      const { SurfaceView: View } = await import("./view.ts");
      this.view = new View(canvas);
    } catch (error) {
      this.store.say("Surfaces cannot be shown", `the browser has no WebGL: ${String(error)}`, true);
    }
    this.paint();
  }

  private surfacesInSight(): SurfaceEntity[] {
    const { doc } = this.store;
    return doc.entities.filter((e): e is SurfaceEntity => e.kind === "surface" && isShown(doc, e));
  }

  paint(): void {
    const subject = this.subject();
    this.element.hidden = subject === null;
    if (!subject) return;
    if (!this.view) return void this.load();
    const { looks } = this;
    const seen = this.surfacesInSight();
    const { wipe } = this.store.state.looks;
    const wiped = wipe !== null && seen.some((e) => e.given);
    this.bar.show(wiped);
    const onlyPast = looks.before && !wiped;
    const given = subject.given ?? subject.surface;
    const before = seen.map((e) => e.given ?? e.surface);
    const after = onlyPast ? before : seen.map((e) => e.surface);
    const now = this.sampledOf(after);
    const then = wiped ? this.sampledOf(before) : null;
    if (now.length === 0) return;
    this.range = shownRange([...now, ...(then ?? [])].map((s) => s.values), looks.share);
    const colors = paletteOf(this.store.state);
    this.joints = looks.joints ? this.meetings.of(after) : [];
    this.view.show({
      ...this.content(now, this.joints, onlyPast ? given : subject.surface, onlyPast ? this.typesBefore : this.types, colors),
      before: then && this.content(then, looks.joints ? this.meetings.of(before) : [], given, this.typesBefore, colors),
      range: this.range, look: looks.look, stripes: looks.stripes, colors,
    });
    if (wipe !== null) this.view.wipeAt(wipe);
    this.onRange();
  }

  private sampledOf(surfaces: readonly SurfaceEntity["surface"][]): Sampled[] {
    return surfaces.map((s) => this.samples.of(s, this.looks.look)).filter((s): s is Sampled => s !== null);
  }

  private content(surfaces: readonly Sampled[], joints: readonly SurfaceJoint[], chosen: SurfaceEntity["surface"],
                  types: ReadonlyMap<string, number>, colors: Palette): SurfaceContent {
    return {
      surfaces, joints: joints.map(({ order, points }) => ({ points, color: jointColor(order, colors) })),
      network: this.looks.network ? this.network(chosen, types, colors) : [],
    };
  }

  fit(): void {
    this.view?.frame(this.sampledOf(this.surfacesInSight().map((e) => e.surface)));
  }

  private network(surface: SurfaceEntity["surface"], types: ReadonlyMap<string, number>, colors: Palette): NetworkLine[] {
    return [...networkOf(surface)].map(([name, points]) => {
      const type = types.get(name);
      const color = type === undefined ? colors.faint : type <= 2 ? colors.inflection : type === 3 ? colors.comb : colors.bad;
      return { name, points, color, chosen: name === this.looks.chosen };
    });
  }
}

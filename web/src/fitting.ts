/** The view brought to what is drawn, and the comb to the view. */
import { tip } from "./canvas/curves.ts";
import { handlesOf, isShown, type Point } from "./model/document.ts";
import type { Live, Shown } from "./model/live.ts";
import type { Store } from "./model/state.ts";
import { boxOf, type Viewport } from "./view/viewport.ts";

// A comb that fits: nine teeth of ten within this share of the canvas' smaller side, so that one tight
// corner does not press the rest flat; none longer than the second.
const kMostTeeth = 0.9;
const kToothShare = 0.16;
const kLongestTooth = 0.55;
const kAround = 0.16; // of the smaller side left free about curves,
const kAroundComb = 0.09; // and about curves with the comb
const kSameComb = Math.log(2.5); // combs whose scales differ by less stay comparable

export class Fitting {
  /** the view as it was fitted last; null: not yet */
  private fitted: { scale: number; center: Point } | null = null;
  /** whether curves were on their way then */
  private coming = false;

  constructor(private readonly store: Store, private readonly live: Live, private readonly view: Viewport,
              private readonly subject: () => Shown | undefined, private readonly paint: () => void) {}

  private drawn(): Point[] {
    const doc = this.store.doc;
    const under = this.store.state.underlay;
    return doc.entities.filter((e) => isShown(doc, e)).flatMap((e): Point[] => {
      if (e.kind === "scan") return e.line.points as Point[];
      const own = e.kind === "mirror" ? [] : handlesOf(e);
      return [...own, ...((this.live.of(e.id)?.comb.points ?? []) as Point[])];
    }).concat(under ? [under.at, [under.at[0] + under.width * under.scale, under.at[1] + under.height * under.scale]] : []);
  }

  fit(): void {
    const drawn = this.drawn();
    if (!this.show(drawn, kAround)) return;
    const { looks } = this.store.state;
    if (!looks.combOwn && looks.combScale > 0) this.fitComb();
    this.show([...drawn, ...this.tips()], kAroundComb);
    this.fitted = { scale: this.view.scale, center: this.view.center };
    this.coming = this.live.asking;
    this.paint();
  }

  /** The last curve on its way has come: what was fitted without it, and not moved by hand since, is fitted again. */
  completed(): void {
    if (!this.coming || this.live.asking) return;
    this.coming = false;
    if (this.unmoved()) this.fit();
  }

  private unmoved(): boolean {
    return this.fitted?.scale === this.view.scale && this.fitted.center === this.view.center;
  }

  private show(points: readonly Point[], around: number): boolean {
    const box = boxOf(points);
    const margin = Math.min(this.view.width, this.view.height) * around;
    if (box) this.view.fit(box, { left: margin, right: margin, top: margin, bottom: margin });
    return box !== null;
  }

  /** Of the comb that is shown, but for what stands out of it. */
  private tips(): Point[] {
    const { comb, combScale, combOwn } = this.store.state.looks;
    const shown = this.subject()?.comb;
    if (!comb || !shown) return [];
    const sizes = shown.curvature.map(Math.abs).sort((a, b) => a - b);
    const most = combOwn ? Infinity : sizes[Math.floor(kMostTeeth * (sizes.length - 1))] ?? 0;
    return shown.points.flatMap((_, i) => (Math.abs(shown.curvature[i] ?? 0) <= most ? [tip(shown, i, combScale)] : []));
  }

  fitOnce(): void {
    if (!this.fitted && this.view.width > 100) this.fit();
  }

  /** The canvas has another size: what was fitted and never moved by hand is fitted again. */
  resized(inSpace: boolean): void {
    if (!this.fitted) this.fitOnce();
    else if (this.unmoved() && !inSpace) this.fit();
  }

  /** The longest tooth of the chosen curve (else of any) as long as is good to look at. */
  fitComb(): void {
    const subject = this.subject();
    const shown: Shown[] = subject ? [subject]
      : this.store.doc.entities.flatMap((e) => this.live.of(e.id) ?? []);
    const sizes = shown.flatMap((s) => s.comb.curvature.map(Math.abs)).sort((a, b) => a - b);
    const largest = sizes.at(-1) ?? 0;
    if (!(largest > 0)) return;
    const most = sizes[Math.floor(kMostTeeth * (sizes.length - 1))] ?? largest;
    const side = Math.min(this.view.width, this.view.height) / this.view.scale;
    const fitting = Math.min((kToothShare * side) / Math.max(most, 1e-12), (kLongestTooth * side) / largest);
    this.store.look({ combScale: fitting, combOwn: false });
  }

  /** Another curve is looked at: its comb is fitted too, unless it would hardly differ or a hand has scaled it. */
  refitComb(): void {
    const { combScale, combOwn } = this.store.state.looks;
    if (combOwn || combScale === 0 || !this.subject()) return;
    this.fitComb();
    const fitting = this.store.state.looks.combScale;
    if (Math.abs(Math.log(fitting / combScale)) < kSameComb) this.store.look({ combScale });
  }
}

/** What is being worked at, and what there is to say. */
import type { Store } from "../model/state.ts";
import { iconButton } from "../ui/controls.ts";
import { fill, h } from "../ui/dom.ts";
import { icons } from "../ui/icons.ts";

const kGone = {
  text: "The server is gone", hint: "your work is kept; start keyline studio again and open the address it prints", bad: true,
};

export class Notices {
  readonly work = h("div", { class: "work" });
  private readonly trace = h("canvas", { class: "trace", width: 120, height: 40, hidden: true, role: "img", "aria-label": "What the search has come to" });
  readonly toast = h("div", { class: "toast", role: "alert" });

  constructor(private readonly store: Store) {
    store.onChange((now, before) => {
      if (now.work !== before.work) this.renderWork();
      if (now.message !== before.message || now.reached !== before.reached) this.renderToast();
    });
  }

  private renderWork(): void {
    const { work } = this.store.state;
    if (!work || !this.work.firstElementChild)
      fill(this.work, work && h("div", { class: "progress" }, h("span"), this.trace, h("progress", { max: 1, value: 0 }),
        h("button", { type: "button", id: "cancel", click: () => this.store.state.work?.cancel() }, "Stop")));
    if (!work) return;
    const bar = this.work.querySelector("progress") as HTMLProgressElement; // stays while a hand moves towards the button
    bar.value = work.fraction;
    bar.ariaLabel = work.doing;
    (this.work.querySelector("span") as HTMLElement).textContent = work.doing;
    this.renderTrace(work.trace);
  }

  /** What the search has come to, step by step: it falls fast, then slowly, then no more. */
  private renderTrace(trace: readonly number[]): void {
    this.trace.hidden = trace.length < 2;
    const g = this.trace.getContext("2d");
    if (!g || trace.length < 2) return;
    const { width, height } = this.trace;
    const low = Math.min(...trace);
    const size = Math.max(...trace) - low || 1;
    g.clearRect(0, 0, width, height);
    g.strokeStyle = getComputedStyle(this.trace).color;
    g.lineWidth = 2;
    g.beginPath();
    trace.forEach((v, i) => g.lineTo((i / (trace.length - 1)) * (width - 4) + 2, 3 + (1 - (v - low) / size) * (height - 6)));
    g.stroke();
  }

  private renderToast(): void {
    const { message, reached } = this.store.state;
    const said = reached ? message : kGone;
    fill(this.toast, said && h("div", { class: said.bad ? "said bad" : "said" },
      h("strong", {}, said.text), said.hint && h("span", {}, said.hint),
      iconButton({ icon: icons.remove, label: "Dismiss", onClick: () => this.store.say("") })));
  }
}

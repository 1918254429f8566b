import type { Store, ToolName } from "../model/state.ts";
import { iconButton } from "../ui/controls.ts";
import { fill, h } from "../ui/dom.ts";
import { icons } from "../ui/icons.ts";

type Railed = Exclude<ToolName, "measure" | "strays">;

export const tools: readonly { name: Railed; label: string; key: string }[] = [
  { name: "select", label: "Select and drag", key: "V" },
  { name: "segment", label: "Log-aesthetic segment from three handles", key: "L" },
  { name: "compound", label: "Compound rhythm: two slopes, one joint", key: "C" },
  { name: "s-shape", label: "S-shape: ends with directions", key: "S" },
  { name: "spline", label: "Spline through points", key: "P" },
  { name: "quasi", label: "Quasi log-aesthetic B\u00e9zier", key: "Q" },
];

export class ToolRail {
  readonly element = h("nav", { class: "rail", "aria-label": "Tools" });

  constructor(private readonly store: Store) {
    store.onChange((now, before) => {
      if (now.tool !== before.tool) this.render();
    });
    this.render();
  }

  private render(): void {
    fill(this.element, ...tools.map((t) => iconButton({
      id: `tool-${t.name}`, icon: icons[t.name], label: t.label, key: t.key,
      pressed: this.store.state.tool === t.name,
      onClick: () => this.store.set({ tool: t.name }),
    })));
  }
}

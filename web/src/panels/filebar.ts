/** Opening, undoing, taking home. */
import type { Studio } from "../studio.ts";
import { iconButton } from "../ui/controls.ts";
import { fill, h } from "../ui/dom.ts";
import { icons } from "../ui/icons.ts";

/** What stands in the export list beside the formats of files. */
const kClipboard = "clipboard";
const kDocument = "document";

export class FileBar {
  readonly element = h("div", { class: "file-bar", role: "toolbar", "aria-label": "File" });

  constructor(private readonly studio: Studio) {}

  render(): void {
    const { studio } = this;
    const { history } = studio.store.state;
    const past = history.past.at(-1);
    const future = history.future[0];
    fill(this.element,
      iconButton({ id: "open", icon: icons.open, label: "Open a file", key: "Ctrl O", onClick: () => studio.chooseFile() }),
      iconButton({
        id: "save", icon: icons.save, label: "Save the whole document", key: "Ctrl S", onClick: () => void studio.saveDocument(),
      }),
      iconButton({
        id: "undo", icon: icons.undo, label: past ? `Undo ${past.label}` : "Nothing to undo", key: "Ctrl Z", disabled: !past,
        onClick: () => studio.store.undo(),
      }),
      iconButton({
        id: "redo", icon: icons.redo, label: future ? `Redo ${future.label}` : "Nothing to redo", key: "Ctrl Shift Z",
        disabled: !future, onClick: () => studio.store.redo(),
      }),
      iconButton({ id: "fit", icon: icons.fit, label: "Fit all", key: "F", onClick: () => studio.fit() }),
      this.exporting());
  }

  private exporting(): HTMLElement {
    const choose = h("select", { id: "export", "aria-label": "Export" },
      h("option", { value: "" }, "Export\u2026"),
      ...this.studio.client.formats.map((f) => h("option", { value: f }, f.toUpperCase())),
      h("option", { value: kClipboard }, "Copy as SVG"),
      h("option", { value: kDocument }, "Keyline document"));
    choose.addEventListener("change", () => {
      if (choose.value === kClipboard) void this.studio.copy();
      else if (choose.value === kDocument) void this.studio.saveDocument();
      else if (choose.value) this.studio.export(choose.value);
      choose.value = "";
    });
    return choose;
  }
}

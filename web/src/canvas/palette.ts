/** Colours of what is drawn, by theme; the page's own are in style.css. */
export interface Palette {
  ground: string;
  gridFine: string;
  grid: string;
  axis: string;
  ruler: string;
  rulerText: string;
  curve: string;
  selected: string;
  comb: string;
  combFill: string;
  before: string;
  beforeFill: string;
  point: string;
  handle: string;
  handleLine: string;
  evolute: string;
  maximum: string;
  inflection: string;
  mark: string;
  region: string;
  regionEdge: string;
  bad: string;
  text: string;
  faint: string;
}

export const dark: Palette = {
  ground: "#14171b",
  gridFine: "#1b1f24",
  grid: "#23282f",
  axis: "#39414b",
  ruler: "#1a1d22",
  rulerText: "#8b95a1",
  curve: "#e9edf2",
  selected: "#ffffff",
  comb: "#ffb04a",
  combFill: "rgba(255,176,74,0.10)",
  before: "#6f8fb3",
  beforeFill: "rgba(111,143,179,0.10)",
  point: "#7f8b99",
  handle: "#4fb7ff",
  handleLine: "#35648a",
  evolute: "#b48cff",
  maximum: "#ff6fa5",
  inflection: "#45d6a5",
  mark: "#ffffff",
  region: "rgba(79,183,255,0.13)",
  regionEdge: "rgba(79,183,255,0.55)",
  bad: "#ff6b5e",
  text: "#d9dee5",
  faint: "#8b95a1",
};

export const light: Palette = {
  ground: "#fbfbf9",
  gridFine: "#f1f1ee",
  grid: "#e4e5e1",
  axis: "#c3c6c4",
  ruler: "#f3f3f0",
  rulerText: "#5e6670",
  curve: "#20262e",
  selected: "#05080c",
  comb: "#c25a00",
  combFill: "rgba(214,106,0,0.09)",
  before: "#3d6ea5",
  beforeFill: "rgba(61,110,165,0.09)",
  point: "#7b8590",
  handle: "#0077cc",
  handleLine: "#8fbfe3",
  evolute: "#7440c9",
  maximum: "#c4246b",
  inflection: "#04825a",
  mark: "#05080c",
  region: "rgba(0,119,204,0.11)",
  regionEdge: "rgba(0,119,204,0.5)",
  bad: "#c62b1e",
  text: "#2b323b",
  faint: "#5e6670",
};

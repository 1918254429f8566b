#pragma once

#include <string_view>

namespace keyline::report::detail {

/// Draws every LinkedCurve of the page as comb and curvature plot, linked and zoomed together along
/// the curve. Well-formed as XML too: hence the marked section.
inline constexpr std::string_view kScript = R"js(
//<![CDATA[
(() => {
  "use strict";
  const kInk = "#212529", kQuiet = "#5a6268", kFrame = "#adb5bd", kGrid = "#e9ecef", kCurve = "#0069aa";
  const kBefore = "#8c9399", kBand = "#f5f7f9", kMark = "#ce5400";
  const kFont = "12px system-ui, 'Liberation Sans', 'DejaVu Sans', sans-serif";
  const kLeft = 64, kRight = 14, kTop = 18, kBottom = 34, kReach = 60, kTooth = 4, kMargin = 18;

  const make = (tag, attributes, ...children) => {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...children);
    return element;
  };
  const text = (v, digits = 4) => {
    if (!Number.isFinite(v)) return "\u221e";
    const size = Math.abs(v);
    if (size === 0) return "0";
    const fixed = size >= 1e6 || size < 1e-4 ? v.toExponential(digits - 1)
      : v.toFixed(Math.max(0, digits - 1 - Math.floor(Math.log10(size))));
    return fixed.replace("-", "\u2212");
  };
  const roundStep = (least) => {
    const power = 10 ** Math.floor(Math.log10(least));
    return [1, 2, 5, 10].map((f) => f * power).find((step) => step >= least * (1 - 1e-12));
  };
  const tickText = (v, step) => {
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    return digits > 6 ? v.toExponential(1) : v.toFixed(digits).replace("-", "\u2212");
  };
  const clamp = (v, low, high) => Math.min(Math.max(v, low), high);

  function explore(place) {
    const { s, x, y, a, k, joints, before } = JSON.parse(place.querySelector("script").textContent);
    const pieces = [...place.querySelectorAll("li")].map((li) => li.textContent);
    const unit = place.dataset.unit, length = s[s.length - 1] - s[0], n = s.length;
    const behind = unit ? "\u00a0" + unit : "";
    const sizes = k.map(Math.abs).sort((p, q) => p - q);
    const usual = sizes[Math.floor(0.95 * (n - 1))] || sizes[n - 1] || 1;
    let range = [s[0], s[n - 1]], mark = -1, longer = 1, pen, width, height;

    const comb = make("canvas", { tabindex: 0, role: "img", class: "comb", "aria-label": "Curvature comb. Arrow keys walk along the curve, plus and minus zoom." });
    const plot = make("canvas", { tabindex: 0, role: "img", class: "plot", "aria-label": "Curvature against arc length. Arrow keys walk along the curve, plus and minus zoom." });
    const told = make("p", { class: "told", role: "status" });
    const button = (label, name, act) => {
      const made = make("button", { type: "button", "aria-label": name, title: name }, label);
      made.addEventListener("click", act);
      return made;
    };
    const slider = make("input", { type: "range", min: -1, max: 1.5, step: "any", value: 0 });
    slider.addEventListener("input", () => {
      longer = 10 ** slider.valueAsNumber;
      paint();
    });
    place.append(make("div", { class: "controls" },
      button("+", "Zoom in", () => zoom(1.6, middle())), button("\u2212", "Zoom out", () => zoom(1 / 1.6, middle())),
      button("All", "Show all of it", () => show(s[0], s[n - 1])), make("label", {}, "Comb ", slider)), comb, plot, told);

    const middle = () => (mark >= 0 ? s[mark] : (range[0] + range[1]) / 2);
    const show = (from, to) => {
      const size = clamp(to - from, length / 5000, length);
      const start = clamp(from, s[0], s[n - 1] - size);
      range = [start, start + size];
      paint();
    };
    const zoom = (by, at) => show(at - (at - range[0]) / by, at + (range[1] - at) / by);
    const inRange = (v) => v >= range[0] ? range[1] >= v : false;
    const pieceAt = (i) => joints.filter((joint) => i >= joint).length;

    const tipOf = ([px, py], i, tooth) => [px + tooth * k[i] * Math.sin(a[i]), py + tooth * k[i] * Math.cos(a[i])];

    /** The box, in pixels, of the part in range and its teeth, at so many pixels a length. */
    const boxAt = (scale, tooth) => {
      let box = [Infinity, Infinity, -Infinity, -Infinity];
      for (let i = 0; n > i; ++i) {
        if (!inRange(s[i])) continue;
        const foot = [x[i] * scale, -y[i] * scale];
        for (const [px, py] of [foot, tipOf(foot, i, tooth)])
          box = [Math.min(box[0], px), Math.min(box[1], py), Math.max(box[2], px), Math.max(box[3], py)];
      }
      return box;
    };

    /** Fits the part in range with its teeth, unless they leave it less than a third of its size. */
    const lay = () => {
      const tooth = longer * height * Math.min(0.2 / usual, 0.5 / (sizes[n - 1] || usual));
      const room = [width - 2 * kMargin, height - 2 * kMargin];
      const fits = (box) => room[0] >= box[2] - box[0] ? room[1] >= box[3] - box[1] : false;
      const bare = boxAt(1, 0);
      let most = Math.min(room[0] / Math.max(bare[2] - bare[0], 1e-9 * length), room[1] / Math.max(bare[3] - bare[1], 1e-9 * length));
      let scale = most / 3;
      for (let step = 0; 12 > step; ++step) {
        const middle = (scale + most) / 2;
        if (fits(boxAt(middle, tooth))) scale = middle;
        else most = middle;
      }
      const box = boxAt(scale, fits(boxAt(scale, tooth)) ? tooth : 0);
      const shift = [(width - box[0] - box[2]) / 2, (height - box[1] - box[3]) / 2];
      return { tooth, at: (i) => [x[i] * scale + shift[0], shift[1] - y[i] * scale] };
    };
    const begin = (canvas) => {
      width = canvas.clientWidth;
      height = canvas.clientHeight;
      const ratio = devicePixelRatio;
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
      pen = canvas.getContext("2d");
      pen.scale(ratio, ratio);
      pen.font = kFont;
      pen.lineJoin = "round";
    };
    const line = (points, color, thick) => {
      pen.beginPath();
      let open = false;
      for (const p of points) {
        if (!p) open = false;
        else if (open) pen.lineTo(...p);
        else pen.moveTo(...p), open = true;
      }
      pen.strokeStyle = color;
      pen.lineWidth = thick;
      pen.stroke();
    };
    const dot = ([px, py], color, r) => {
      pen.beginPath();
      pen.arc(px, py, r, 0, 2 * Math.PI);
      pen.fillStyle = color;
      pen.fill();
      pen.strokeStyle = "#fff";
      pen.lineWidth = 1.5;
      pen.stroke();
    };

    function paintComb() {
      begin(comb);
      const { tooth, at } = lay();
      const feet = s.map((_, i) => at(i));
      const tips = feet.map((foot, i) => tipOf(foot, i, tooth));
      let since = Infinity;
      const teeth = [];
      for (let i = 0; n > i; ++i) {
        if (i > 0) since += Math.max(Math.hypot(feet[i][0] - feet[i - 1][0], feet[i][1] - feet[i - 1][1]), 0.5 * Math.hypot(tips[i][0] - tips[i - 1][0], tips[i][1] - tips[i - 1][1]));
        if (since >= kTooth || joints.includes(i)) teeth.push(feet[i], tips[i], null), since = 0;
      }
      line(teeth, "#8cbadb", 0.8);
      line(tips, kCurve, 1.2);
      line(feet, kInk, 2);
      for (const i of joints) dot(feet[i], kInk, 3);
      if (mark >= 0) {
        line([feet[mark], tips[mark]], kMark, 2);
        dot(feet[mark], kMark, 5);
      }
    }

    const px = (v) => kLeft + ((v - range[0]) / (range[1] - range[0])) * (width - kLeft - kRight);
    const fromPx = (p) => range[0] + ((p - kLeft) / (plot.clientWidth - kLeft - kRight)) * (range[1] - range[0]);

    function paintPlot() {
      begin(plot);
      const seen = k.filter((_, i) => inRange(s[i]));
      let low = Math.min(...seen), high = Math.max(...seen);
      const far = low > 0 ? low > high / 2 : 0 > high ? low / 2 > high : false;
      if (!far) low = Math.min(low, 0), high = Math.max(high, 0);
      const most = Math.max(Math.abs(low), Math.abs(high));
      const slack = 0.08 * (high - low > 1e-6 * most ? high - low : most || 1); // an arc's is none
      low -= slack, high += slack;
      const py = (v) => height - kBottom - ((v - low) / (high - low)) * (height - kTop - kBottom);
      const right = width - kRight, bottom = height - kBottom;
      pen.textAlign = "center";
      pen.textBaseline = "bottom";
      [0, ...joints].forEach((start, i, all) => {
        const from = clamp(px(s[start]), kLeft, right), to = clamp(px(s[i + 1 === all.length ? n - 1 : all[i + 1]]), kLeft, right);
        if (i % 2 === 1) pen.fillStyle = kBand, pen.fillRect(from, kTop, to - from, bottom - kTop);
        pen.fillStyle = kQuiet;
        if (to - from > 14) pen.fillText(String(i), (from + to) / 2, kTop - 2);
      });
      const stepX = roundStep(((range[1] - range[0]) * 76) / (width - kLeft - kRight)), stepY = roundStep(((high - low) * 30) / (bottom - kTop));
      pen.textBaseline = "top";
      for (let i = Math.ceil(range[0] / stepX - 1e-9); range[1] + 1e-9 * stepX >= i * stepX; ++i) {
        line([[px(i * stepX), kTop], [px(i * stepX), bottom]], kGrid, 1);
        pen.fillText(tickText(i * stepX, stepX), px(i * stepX), bottom + 4);
      }
      pen.textAlign = "right";
      pen.textBaseline = "middle";
      for (let i = Math.ceil(low / stepY - 1e-9); high >= i * stepY; ++i) {
        line([[kLeft, py(i * stepY)], [right, py(i * stepY)]], i === 0 ? kFrame : kGrid, 1);
        pen.fillText(tickText(i * stepY, stepY), kLeft - 6, py(i * stepY));
      }
      pen.textBaseline = "bottom";
      pen.fillText("Arc length" + (unit ? " [" + unit + "]" : ""), right, height - 1);
      pen.textAlign = "left";
      pen.fillText("Curvature" + (unit ? " [1/" + unit + "]" : ""), 2, kTop - 2);
      pen.save();
      pen.beginPath();
      pen.rect(kLeft, kTop, right - kLeft, bottom - kTop);
      pen.clip();
      line(before.s.map((v, i) => (before.k[i] === null ? null : [px(v), py(before.k[i])])), kBefore, 1.2);
      line(s.map((v, i) => [px(v), py(k[i])]), kCurve, 2);
      if (mark >= 0) {
        line([[px(s[mark]), kTop], [px(s[mark]), bottom]], kMark, 1);
        dot([px(s[mark]), py(k[mark])], kMark, 5);
      }
      pen.restore();
      pen.strokeStyle = kFrame;
      pen.lineWidth = 1;
      pen.strokeRect(kLeft, kTop, right - kLeft, bottom - kTop);
    }

    function paint() {
      paintComb();
      paintPlot();
      place.dataset.mark = mark;
      place.dataset.range = range.join(" ");
      told.textContent = mark >= 0
        ? ["s " + text(s[mark]) + behind, "radius " + text(1 / Math.abs(k[mark])) + (k[mark] === 0 ? "" : behind),
          "curvature " + text(k[mark], 3) + (unit ? "\u00a01/" + unit : ""), pieces[pieceAt(mark)] || ""].filter(Boolean).join("  \u00b7  ")
        : "Figures " + place.dataset.figures + ", linked. Point at the comb or the plot: the place is marked in both. Drag to move along, + and \u2212, or Ctrl and the wheel, to zoom.";
    }

    const point = (i) => {
      if (i === mark) return;
      mark = i;
      paint();
    };
    const nearestLength = (v) => {
      let low = 0, high = n - 1;
      while (high - low > 1) {
        const i = (low + high) >> 1;
        if (v >= s[i]) low = i;
        else high = i;
      }
      return v - s[low] > s[high] - v ? high : low;
    };
    const nearestPlace = (at) => {
      width = comb.clientWidth;
      height = comb.clientHeight;
      const view = lay();
      let best = -1, least = kReach;
      for (let i = 0; n > i; ++i) {
        const p = view.at(i), distance = Math.hypot(p[0] - at[0], p[1] - at[1]);
        if (least > distance) best = i, least = distance;
      }
      return best;
    };

    let grip = null;
    const listen = (canvas, find, lengthPerPixel) => {
      const at = (e) => [e.offsetX, e.offsetY];
      canvas.addEventListener("pointermove", (e) => {
        if (!grip) return point(find(at(e)));
        show(grip.from - (e.offsetX - grip.x) * lengthPerPixel(), grip.from - (e.offsetX - grip.x) * lengthPerPixel() + grip.size);
      });
      canvas.addEventListener("pointerdown", (e) => {
        if (e.button === 0) grip = { x: e.offsetX, from: range[0], size: range[1] - range[0] };
        if (grip) canvas.setPointerCapture(e.pointerId);
        point(find(at(e)));
      });
      for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => { grip = null; });
      canvas.addEventListener("pointerleave", () => point(-1));
      canvas.addEventListener("dblclick", () => show(s[0], s[n - 1]));
      canvas.addEventListener("wheel", (e) => {
        if (!e.ctrlKey) return;
        e.preventDefault();
        const i = find(at(e));
        zoom(Math.exp(-e.deltaY / 300), i >= 0 ? s[i] : middle());
      }, { passive: false });
      canvas.addEventListener("keydown", (e) => {
        const step = { ArrowLeft: -1, ArrowRight: 1, PageUp: -20, PageDown: 20 }[e.key];
        if (step) point(clamp(mark + step, 0, n - 1));
        else if (e.key === "+" || e.key === "=") zoom(1.6, middle());
        else if (e.key === "-") zoom(1 / 1.6, middle());
        else if (e.key === "0") show(s[0], s[n - 1]);
        else return;
        e.preventDefault();
      });
    };
    listen(comb, nearestPlace, () => (range[1] - range[0]) / comb.clientWidth);
    listen(plot, (p) => nearestLength(clamp(fromPx(p[0]), range[0], range[1])), () => (range[1] - range[0]) / (plot.clientWidth - kLeft - kRight));
    new ResizeObserver(paint).observe(place);
  }

  document.documentElement.classList.add("live");
  for (const place of document.querySelectorAll(".explorer")) explore(place);
})();
//]]>
)js";

/// SHA-256 of it, base64: what the page's policy lets run. tests/report/linked_page_test.py
/// compares.
inline constexpr std::string_view kScriptHash = "MEckA4IUJJjH25q/wJXyFTM5N6CMB7U+pgU9Kkjc2X0=";

}  // namespace keyline::report::detail
